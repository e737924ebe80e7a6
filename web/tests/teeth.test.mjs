// SPDX-License-Identifier: GPL-3.0-or-later
// Teeth show in an open mouth, in a closed one they do not, and the lower ones go along with the jaw. The lining of
// the mouth lies where the program's model has it.
import assert from 'node:assert/strict';
import { mkdtemp, readFile, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { fixture } from './fixtures.mjs';
import { imported } from './modules.mjs';
import { readPage, withData } from './page_data.mjs';
import { changedShare, decode } from './pixels.mjs';

let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

/** The face at rest and where the mouth is widest, of the page with data that `change` has changed. */
async function pictures(change) {
  const { html, data } = await readPage(fixture('coloured.html'));
  change(data);
  const file = join(await mkdtemp(join(tmpdir(), 'hyperex-teeth-')), 'page.html');
  await writeFile(file, withData(html, data));
  const { page, complaints, close } = await openPage(browser, file, { viewport: { width: 960, height: 560 }, pixels: true });
  await page.waitForSelector('#face[data-frame]');
  const shown = [];
  for (const frame of [0, data.motion.peak_frame]) {
    await page.locator('#frame').fill(String(frame));
    await page.waitForFunction((f) => Number(document.getElementById('face').dataset.frame) === f, frame);
    await page.waitForSelector('#face[data-at-rest="true"]');
    shown.push(await page.locator('#face').screenshot());
  }
  assert.deepEqual(complaints, []);
  await close();
  return shown;
}

test('teeth show where the mouth is open, and there alone', async () => {
  const all = await pictures(() => {});
  const none = await pictures((data) => delete data.teeth);
  const still = await pictures((data) => delete data.motion.jaw);
  const page = await browser.newPage();
  const differ = async (a, b) => changedShare(await decode(page, a), await decode(page, b));
  assert.equal(await differ(all[0], none[0]), 0, 'closed lips hide them');
  const open = await differ(all[1], none[1]);
  assert.ok(open > 0.001 && open < 0.1, `${(100 * open).toFixed(2)} % of the view`);
  assert.ok((await differ(all[1], still[1])) > 0.0005, 'the lower row moves');
});

const arrays = { int16: Int16Array, int32: Int32Array, float32: Float32Array, uint8: Uint8Array };
const arrayOf = (Type, bytes, offset, count) =>
  new Type(bytes.buffer.slice(bytes.byteOffset + offset, bytes.byteOffset + offset + count * Type.BYTES_PER_ELEMENT));

/** Vectors of a glTF file's accessor, which may be sparse. */
async function modelOf(file) {
  const bytes = await readFile(file);
  const length = bytes.readUInt32LE(12);
  const gltf = JSON.parse(bytes.subarray(20, 20 + length).toString());
  const block = bytes.subarray(28 + length);
  const read = (Type, { bufferView, byteOffset = 0 }, count) =>
    arrayOf(Type, block, (gltf.bufferViews[bufferView].byteOffset ?? 0) + byteOffset, count);
  const vectors = (number) => {
    const { bufferView, byteOffset, count, sparse } = gltf.accessors[number];
    const out = bufferView === undefined ? new Float32Array(3 * count) : read(Float32Array, { bufferView, byteOffset }, 3 * count);
    if (!sparse) return out;
    const Index = { 5121: Uint8Array, 5123: Uint16Array, 5125: Uint32Array }[sparse.indices.componentType];
    const values = read(Float32Array, sparse.values, 3 * sparse.count);
    read(Index, sparse.indices, sparse.count).forEach((v, i) => out.set(values.subarray(3 * i, 3 * i + 3), 3 * v));
    return out;
  };
  return { gltf, vectors };
}

/** A matrix for what the page calls with: a quaternion x y z w and a translation. */
const jawOf = ([x, y, z, w, ...shift]) => ({
  elements: [
    1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0,
    2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0,
    2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0,
    ...shift, 1,
  ],
});

test('the lining of the mouth lies in the page where the model has it', async () => {
  const { data, bytes } = await readPage(fixture('coloured.html'));
  const stretch = ({ type, offset, count }) => arrayOf(arrays[type], bytes, offset, count);
  const points = stretch(data.skin.points);
  const openings = data.openings.map(({ loop, middle, points: { step_m, values }, rings, jaw, colours }) => ({
    loop: stretch(loop),
    rest: Float32Array.from(stretch(values), (step, i) => middle[i % 3] + step_m * step),
    rings,
    jaw: stretch(jaw),
    colours: stretch(colours),
  }));
  const { Backing } = await imported('replay/face/backing.ts');
  const backing = new Backing({ openings, points, eyeballs: [] });
  const { gltf, vectors } = await modelOf(fixture('coloured.glb'));
  const [skin, cavity] = gltf.meshes[0].primitives;
  const jaw = stretch(data.motion.jaw);
  let most = 0;
  let farthest = 0;
  gltf.meshes[0].extras.targetNames.forEach((name, k) => {
    const frame = data.motion.time_s.findIndex((t) => Math.abs(t - data.motion.time_s[0] - Number(name.slice(5, -1))) < 1e-3);
    const move = vectors(skin.targets[k].POSITION);
    backing.follow(points.map((at, i) => at + move[i]), jawOf(jaw.subarray(7 * frame, 7 * frame + 7)));
    const shown = backing.object.children[0].geometry.getAttribute('position').array;
    const rest = vectors(cavity.attributes.POSITION);
    const moved = vectors(cavity.targets[k].POSITION);
    assert.equal(shown.length, rest.length);
    shown.forEach((at, i) => {
      most = Math.max(most, Math.abs(at - rest[i] - moved[i]));
      farthest = Math.max(farthest, Math.abs(moved[i]));
    });
  });
  backing.follow(points, jawOf([0, 0, 0, 1, 0, 0, 0]));
  assert.ok(Math.abs(backing.lightInMouth - 0.15) < 0.05, `closed lips let ${backing.lightInMouth} of the light in`);
  const mouth = openings.find((one) => one.jaw.some((share) => share > 0)).loop;
  // A slit of 50 by 3 mm.
  const slit = points.slice();
  mouth.forEach((v, i) => slit.set([[0, 0, 0], [0.05, 0, 0], [0.05, 0.003, 0], [0, 0.003, 0]][Math.min(i, 3)], 3 * v));
  backing.follow(slit, jawOf([0, 0, 0, 1, 0, 0, 0]));
  const mean = (2 * 0.05 * 0.003) / (2 * (0.05 + 0.003));
  assert.ok(Math.abs(backing.lightInMouth - 0.15 - 0.85 * (1 - Math.exp(-mean / 1.5e-3))) < 1e-4);
  assert.ok(farthest > 5e-3, `it moves: ${farthest}`);
  assert.ok(most < 3e-5, `${most} m apart`);
});

test('the upper teeth lie where surgery put them, in that face alone', async () => {
  const { Teeth } = await imported('replay/face/teeth.ts');
  const teeth = new Teeth({ teeth: [] });
  const [upper] = teeth.object.children;
  teeth.moveTo({ jaw: null, upperTeeth: [0, 0, 0.6, 0.8, 0.001, 0.002, 0.004] }, 0);
  assert.deepEqual(upper.position.toArray(), [0.001, 0.002, 0.004]);
  assert.deepEqual(upper.quaternion.toArray(), [0, 0, 0.6, 0.8]);
  teeth.moveTo({ jaw: null, upperTeeth: null }, 0);
  assert.deepEqual([...upper.position.toArray(), ...upper.quaternion.toArray()], [0, 0, 0, 0, 0, 0, 1]);
});
