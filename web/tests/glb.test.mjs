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
    const bytes = await readFile(file);
    const length = bytes.readUInt32LE(12);
    const gltf = JSON.parse(bytes.subarray(20, 20 + length).toString());
    const names = gltf.meshes[0].extras.targetNames;
    assert.ok(names.length > 0);
    for (const name of names) assert.match(name, /^pose_[0-9]+\.[0-9]+s$/);
    const report = await validator.validateBytes(new Uint8Array(bytes));
    const told = report.issues.messages.filter((m) => m.severity <= 1);
    assert.deepEqual(told, [], 'errors and warnings');
    assert.equal(report.info.animationCount, 1);
    assert.equal(report.info.hasMorphTargets, true);
    assert.ok(report.info.totalTriangleCount > 800);
  });
}
