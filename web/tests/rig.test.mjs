// SPDX-License-Identifier: GPL-3.0-or-later
// A rig of blend shapes in Khronos' validator and in three.js, as docs/rig.md says to play it.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';
import validator from 'gltf-validator';
import { launch } from './browser.mjs';
import { changedShare, decode } from './pixels.mjs';

const web = join(dirname(fileURLToPath(import.meta.url)), '..');
const skip = process.env.HYPEREX ? false : 'the program is not built';
const coarse = ['--set', 'mesh.element_size_mm=9', '--set', 'mesh.layers=1'];

/** A rig of the embedded face, on a coarse mesh. */
function rigOf(...more) {
  const file = join(mkdtempSync(join(tmpdir(), 'hyperex-rig-')), 'rig.glb');
  execFileSync(process.env.HYPEREX, ['rig', 'embedded', '--out', file, ...coarse, ...more], { stdio: 'pipe' });
  return readFileSync(file);
}
const namesIn = (bytes) =>
  JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString())
    .meshes.find(({ name }) => name === 'skin').extras.targetNames;

let browser;
let rig;
before(async () => {
  if (skip) return;
  browser = await launch();
  rig = rigOf();
});
after(() => browser?.close());

test('the rig is valid glTF with ARKit’s names', { skip }, async () => {
  const names = namesIn(rig);
  assert.equal(names.length, 52);
  for (const name of ['eyeBlinkLeft', 'jawOpen', 'mouthSmileRight', 'tongueOut']) assert.ok(names.includes(name), name);
  const report = await validator.validateBytes(new Uint8Array(rig));
  assert.deepEqual(report.issues.messages.filter((m) => m.severity <= 1), [], 'errors and warnings');
});

test('--names unreal writes them as Live Link has them, and --correctives adds valid ones behind', { skip }, async () => {
  const bytes = rigOf('--names', 'unreal', '--correctives');
  const names = namesIn(bytes);
  assert.deepEqual(names.slice(0, 52), namesIn(rig).map((name) => name[0].toUpperCase() + name.slice(1)));
  assert.equal(names.length, 59);
  assert.ok(names.slice(52).every((name) => name.split('_').every((part) => names.slice(0, 52).includes(part))));
  const report = await validator.validateBytes(new Uint8Array(bytes));
  assert.deepEqual(report.issues.messages.filter((m) => m.severity <= 1), [], 'errors and warnings');
});

/** The lines of docs/rig.md that play a rig in three.js. */
const documented = () => {
  const page = readFileSync(join(web, '..', 'docs', 'rig.md'), 'utf8');
  return page.match(/```js\n([\s\S]*?)```/)[1];
};

test('three.js plays the rig by the lines of the page', { skip }, async () => {
  const entry = `
    import { AmbientLight, Box3, DirectionalLight, PerspectiveCamera, Scene, Vector3, WebGLRenderer } from 'three';
    ${documented()}
    window.ready = (async () => {
      const face = await load('data:model/gltf-binary;base64,' + window.rigBytes);
      const scene = new Scene();
      const light = new DirectionalLight('white', 2);
      light.position.set(0.2, 0.4, 1);
      scene.add(face, light, new AmbientLight('white', 1));
      const middle = new Box3().setFromObject(face).getCenter(new Vector3());
      const camera = new PerspectiveCamera(30, 1, 0.01, 10);
      camera.position.copy(middle).add(new Vector3(0, 0, 0.5));
      camera.lookAt(middle);
      const renderer = new WebGLRenderer({ preserveDrawingBuffer: true });
      renderer.setSize(480, 480);
      document.body.append(renderer.domElement);
      window.show = (weights) => { play(face, weights); renderer.render(scene, camera); };
      window.pace = (frames) => {
        const began = performance.now();
        for (let k = 0; k < frames; ++k) {
          window.show({ jawOpen: (k % 10) / 10, mouthSmileLeft: 0.5, eyeBlinkRight: (k % 5) / 5 });
          const pixel = new Uint8Array(4);
          renderer.getContext().readPixels(0, 0, 1, 1, 6408, 5121, pixel);
        }
        return (1000 * frames) / (performance.now() - began);
      };
    })();`;
  const { outputFiles } = await build({
    stdin: { contents: entry, resolveDir: web }, bundle: true, write: false, format: 'iife', target: 'es2022',
  });
  const page = await browser.newPage({ viewport: { width: 480, height: 480 } });
  const complaints = [];
  page.on('pageerror', (error) => complaints.push(String(error)));
  await page.setContent('<body style="margin:0"></body>');
  await page.evaluate((bytes) => (window.rigBytes = bytes), rig.toString('base64'));
  await page.addScriptTag({ content: outputFiles[0].text });
  await page.evaluate(() => window.ready);
  const shot = async (weights) => {
    await page.evaluate((w) => window.show(w), weights);
    return decode(page, await page.locator('canvas').screenshot());
  };
  const rest = await shot({});
  const open = await shot({ jawOpen: 1 });
  const wink = await shot({ eyeBlinkRight: 1 });
  const again = await shot({});
  assert.equal(await changedShare(rest, again), 0, 'weights that are not named are 0');
  const opened = await changedShare(rest, open);
  assert.ok(opened > 0.03, `jawOpen changes ${opened}`);
  const winked = await changedShare(rest, wink);
  assert.ok(winked > 0.0005 && winked < opened / 2, `eyeBlinkRight changes ${winked}`);
  assert.deepEqual(complaints, []);
  console.log(`# ${(await page.evaluate(() => window.pace(40))).toFixed(0)} frames a second at 480 x 480, drawn in software`);
});
