// SPDX-License-Identifier: GPL-3.0-or-later
// The animated models pass Khronos' validator. GLB=FILE tests that file alone.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { test } from 'node:test';
import validator from 'gltf-validator';
import { fixture } from './fixtures.mjs';

const files = process.env.GLB
  ? [process.env.GLB]
  : ['plain.glb', 'coloured.glb', 'textured.glb', 'tracked.glb'].map(fixture);

for (const file of files) {
  test(`${file} is valid glTF with a moving face`, async () => {
    const report = await validator.validateBytes(new Uint8Array(await readFile(file)));
    const told = report.issues.messages.filter((m) => m.severity <= 1);
    assert.deepEqual(told, [], 'errors and warnings');
    assert.equal(report.info.animationCount, 1);
    assert.equal(report.info.hasMorphTargets, true);
    assert.ok(report.info.totalTriangleCount > 800);
  });
}
