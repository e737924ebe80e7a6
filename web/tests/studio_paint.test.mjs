// SPDX-License-Identifier: GPL-3.0-or-later
// Tissue painted on the face: walks on the skin by themselves, then the brush in the studio's page.
//   HYPEREX=build/release/bin/hyperex node --test web/tests/studio_paint.test.mjs
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { build } from 'vite';
import { launch, tooWide } from './browser.mjs';
import { openStudio, placeOnFace, program, run, startStudio } from './studio_server.mjs';

/** Modules of the page, without a page. */
async function moduleOf(name) {
  const built = await build({
    configFile: false, logLevel: 'silent',
    build: { write: false, minify: false, lib: { entry: new URL(`../src/studio/${name}.ts`, import.meta.url).pathname, formats: ['es'] } },
  });
  const [{ output: [{ code }] }] = built;
  return import(`data:text/javascript,${encodeURIComponent(code)}`);
}

/** A square of 2 n x 2 n squares of 1 m, around 0 0, each of two triangles; `at` puts it into space. */
function grid(n, at = (x, y) => [x, y, 0]) {
  const points = [];
  const triangles = [];
  const wide = 2 * n + 1;
  for (let y = -n; y <= n; ++y) for (let x = -n; x <= n; ++x) points.push(...at(x, y));
  for (let i = 0; i < 2 * n; ++i)
    for (let j = 0; j < 2 * n; ++j) {
      const a = i * wide + j;
      triangles.push(a, a + 1, a + wide + 1, a, a + wide + 1, a + wide);
    }
  return { points: Float32Array.from(points), triangles: Int32Array.from(triangles), middle: n * wide + n };
}

test('distances along the skin: round on a plane, around a bend, not across a cut', async () => {
  const { SkinWalk } = await moduleOf('skin_walk');
  const { points, triangles, middle } = grid(12);
  const from = { vertices: [middle, middle + 1, middle + 26], weights: [1, 0, 0] };
  const flat = new SkinWalk(points, triangles, points.length / 3, []).reach(from, 10);
  let worst = 0;
  flat.vertices.forEach((v, i) => {
    const far = Math.hypot(points[3 * v], points[3 * v + 1]);
    worst = Math.max(worst, Math.abs(flat.far[i] - far) / Math.max(far, 1));
  });
  assert.ok(worst < 0.03, `${worst} of the distance`);
  const within = Array.from({ length: points.length / 3 }, (_, v) => Math.hypot(points[3 * v], points[3 * v + 1])).filter((d) => d <= 9.7).length;
  assert.ok(flat.vertices.length >= within, 'nothing within is left out');

  // Folded along x = 0: through the air (5, y) is near (-5, y), on foot it is 10 away.
  const folded = grid(12, (x, y) => [Math.abs(x), y, x < 0 ? 1e-3 : 0]);
  const reach = new SkinWalk(folded.points, folded.triangles, folded.points.length / 3, [])
    .reach({ vertices: [middle + 5, middle + 6, middle + 31], weights: [1, 0, 0] }, 11);
  const other = reach.far[reach.vertices.indexOf(middle - 5)];
  assert.ok(Math.abs(other - 10) < 0.1, `${other} of 10`);

  // Two sheets that touch along a line. Where a cut parted them they stay apart, else they are one.
  const sheets = { points: Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -1, 0), triangles: Int32Array.of(0, 1, 2, 3, 5, 4) };
  const start = { vertices: [0, 1, 2], weights: [0, 0, 1] };
  const reached = (scanVertices, cut) => new SkinWalk(sheets.points, sheets.triangles, scanVertices, cut).reach(start, 5).vertices.includes(5);
  assert.equal(reached(6, []), true);
  assert.equal(reached(6, [[0, 0, 0], [1, 0, 0]]), false);
  assert.equal(reached(3, []), false);
});

test('a stroke counts once wherever it comes, fades to its rim, erases, and is mirrored', async () => {
  const [{ SkinWalk }, { Stroke, falloff }] = [await moduleOf('skin_walk'), await moduleOf('stroke')];
  assert.deepEqual([falloff(0, 0), falloff(0.3, 0.3), falloff(1, 0.3), falloff(0.5, 0)], [1, 1, 0, 0.5]);
  const { points, triangles, middle } = grid(8);
  const walk = new SkinWalk(points, triangles, points.length / 3, []);
  const shares = new Float32Array(points.length / 3);
  const at = (v) => ({ vertices: [v, v + 1, v + 18], weights: [1, 0, 0] });
  const brush = { radiusM: 3, hardness: 0, strength: 0.5, erases: false, mirrored: false };
  const stroke = new Stroke(walk, shares, brush, null);
  for (let i = 0; i < 5; ++i) stroke.dab(at(middle));
  assert.equal(shares[middle], 0.5);
  assert.ok(shares[middle + 1] < 0.5 && shares[middle + 1] > 0.2 && shares[middle + 4] === 0);
  const again = new Stroke(walk, shares, brush, null);
  again.dab(at(middle));
  assert.equal(shares[middle], 0.75, 'a second stroke adds');
  again.undo();
  assert.equal(shares[middle], 0.5);
  new Stroke(walk, shares, { ...brush, strength: 1, erases: true }, null).dab(at(middle));
  assert.equal(shares[middle], 0);
  // The mirror image of (x, y) is (-x, y).
  const vertices = Int32Array.from({ length: points.length }, (_, i) => {
    const v = Math.floor(i / 3);
    return i % 3 === 0 ? v - 2 * points[3 * v] : -1;
  });
  const mirror = { normal: [1, 0, 0], vertices, weights: Uint8Array.from({ length: points.length }, (_, i) => (i % 3 ? 0 : 255)) };
  shares.fill(0);
  new Stroke(walk, shares, { ...brush, strength: 1, mirrored: true }, mirror).dab(at(middle + 5));
  assert.equal(shares[middle - 5], 1);
  assert.equal(shares[middle + 5], 1);
  assert.equal(shares[middle - 4], shares[middle + 4]);
});

const axe = await readFile(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const sceneText = (page) => page.locator('#scene-text').textContent();
const settled = (page) => page.waitForFunction(() => document.documentElement.dataset.current === 'true');
const patches = async (page) => [...(await sceneText(page)).matchAll(/"painted" = "[^"]*(painted-\w+\.csv)", "young_factor" = ([\d.]+)/g)].map(([, file, factor]) => ({ file, factor: Number(factor) }));
const untilPatches = (page, count) =>
  page.waitForFunction((n) => document.getElementById('scene-text').textContent.split('"painted"').length - 1 === n, count);
/** Until the paint is another than `files`. */
const untilOther = (page, file) => page.waitForFunction((name) => {
  const text = document.getElementById('scene-text').textContent;
  return text.includes('"painted"') && !text.includes(name);
}, file);

/** A drag over a face from one place to another, shares of the picture. */
async function stroke(page, from, to, steps = 8) {
  const { x, y, width, height } = await page.locator('#canvas-host').boundingBox();
  const at = (share) => [x + (from[0] + share * (to[0] - from[0])) * width, y + (from[1] + share * (to[1] - from[1])) * height];
  await page.mouse.move(...at(0));
  await page.mouse.down();
  for (let i = 1; i <= steps; ++i) await page.mouse.move(...at(i / steps));
  await page.mouse.up();
}

const untilText = (page, text) => page.waitForFunction((wanted) => document.getElementById('scene-text').textContent.includes(wanted), text);

describe('painting in the studio', { skip: program() ? false : 'the program is not built', concurrency: false }, () => {
  let browser;
  before(async () => (browser = await launch()));
  after(() => browser?.close());

  test('a stiff patch, a scar and a region: beside base, undone stroke by stroke, run again from the saved scene', async (t) => {
    const studio = await startStudio();
    t.after(() => studio.stop());
    const { page, complaints, close } = await openStudio(browser, studio.address);
    await page.click('#tab-paint');
    assert.match(await page.locator('#colour-bar').innerText(), /Stiffness kPa/);
    const camera = () => page.evaluate(() => document.getElementById('face').dataset.frame);
    await stroke(page, [0.6, 0.55], [0.63, 0.62]);
    await untilPatches(page, 1);
    await settled(page);
    assert.ok(await page.evaluate(() => Number(document.documentElement.dataset.shapes)) > 0, 'the frame shown follows before the motion');
    assert.deepEqual(await page.locator('.tab-name').allInnerTexts(), ['Base', 'painted patch 3 x'], 'base stays what it is');
    assert.ok(await camera(), 'drawn');
    const [first] = await patches(page);
    assert.equal(first.factor, 3);
    assert.equal(await page.locator('.readout').isVisible(), false, 'a stroke is no question for figures');

    // More of the same patch, on both sides.
    await page.check('#paint-both');
    await stroke(page, [0.8, 0.45], [0.82, 0.5]);
    await untilOther(page, first.file);
    await settled(page);
    const [more] = await patches(page);
    await page.keyboard.press('Control+z');
    await page.waitForFunction((file) => document.getElementById('scene-text').textContent.includes(file), first.file);
    assert.equal((await patches(page)).length, 1);
    await page.keyboard.press('Control+Shift+z');
    await page.waitForFunction((file) => document.getElementById('scene-text').textContent.includes(file), more.file);
    await settled(page);
    await page.uncheck('#paint-both');

    // A scar: a patch of its own, with the factor of the preset and its source.
    await page.click('[data-tool=scar]');
    assert.match(await page.locator('.paint-panel').innerText(), /Clark et al/);
    await stroke(page, [0.79, 0.5], [0.77, 0.63], 12);
    await untilPatches(page, 2);
    await settled(page);
    const two = await patches(page);
    assert.deepEqual(two.map(({ factor }) => factor), [3, 5]);

    // By its number, as a slider.
    const factor = page.locator('[data-paint=young] input[type=number]');
    await factor.fill('8');
    await factor.press('Enter');
    await page.waitForFunction(() => /"young_factor" = 8/.test(document.getElementById('scene-text').textContent));
    await settled(page);

    // A named region fills; erasing takes a little away; the whole patch goes and comes back.
    await page.selectOption('#paint-patch', '2');
    await page.selectOption('#paint-region', 'forehead_R').catch(() => page.selectOption('#paint-region', { index: 0 }));
    await page.click('.paint-fill .quiet');
    await untilPatches(page, 3);
    await settled(page);
    await page.click('[data-tool=erase]');
    await page.selectOption('#paint-patch', '0');
    const [before] = await patches(page);
    await stroke(page, [0.83, 0.6], [0.83, 0.62]);
    await untilOther(page, before.file);
    await page.getByRole('button', { name: 'Delete patch' }).click();
    await untilPatches(page, 2);
    await page.keyboard.press('Control+z');
    await untilPatches(page, 3);
    await settled(page);

    const shown = await page.locator('.corner-table tr[data-face="1"] td').evaluateAll((cells) => cells.slice(0, 2).map((cell) => [cell.dataset.side, Number(cell.dataset.mm)]));
    await page.click('#save-menu');
    await page.fill('#save-name', 'painted');
    await page.click('[data-save=scene]');
    await page.waitForSelector('.save-sheet .status:has-text("painted.toml")');
    await page.keyboard.press('Escape');
    const out = join(studio.folder, 'out');
    await run(['run', join(studio.folder, 'painted.toml'), '--out', out], studio);
    const summary = JSON.parse(await readFile(join(out, 'summary.json'), 'utf8'));
    const own = summary.symmetry && summary.variants.table[1].excursions.find(({ point }) => point === 'cheilion' || point === 'ibug68_48/54').excursion_mm;
    for (const [side, mm] of shown) {
      const run = own[side === 'right' ? 'R' : 'L'];
      assert.ok(Math.abs(mm - run) <= 1e-6 * run, `${side}: ${mm} here, ${run} by hyperex run`);
    }
    assert.deepEqual(complaints, []);
    await close();
  });

  test('thickness: a map in mm, painted, filled, mirrored, erased and undone on base; run again from the saved scene', async (t) => {
    const studio = await startStudio();
    t.after(() => studio.stop());
    const { page, complaints, close } = await openStudio(browser, studio.address);
    const thick = async () => [...(await sceneText(page)).matchAll(/"painted" = "[^"]*(painted-\w+\.csv)", "thickness_mm" = ([\d.]+)/g)].map(([, file, mm]) => ({ file, mm: Number(mm) }));
    const corner = () => page.locator('.corner-table tr[data-face="0"] td').evaluateAll((cells) => cells.slice(0, 2).map((cell) => Number(cell.dataset.mm)));
    await page.click('#tab-paint');
    await page.selectOption('#paint-what', 'thickness');
    assert.match(await page.locator('#colour-bar').innerText(), /Thickness of the soft tissue mm/);
    assert.ok(await page.locator('[data-tool=scar]').isHidden());
    assert.ok(await page.locator('[data-paint=young]').isHidden());
    assert.equal(await page.locator('[data-paint=thickness] input[type=number]').inputValue(), '10');
    const depth = page.locator('[data-paint=thickness] input[type=number]');
    await depth.fill('16');
    await depth.press('Enter');
    const before = await corner();
    await stroke(page, [0.4, 0.55], [0.43, 0.66]);
    await untilPatches(page, 1);
    await settled(page);
    const [first] = await thick();
    assert.equal(first.mm, 16);
    assert.match(await sceneText(page), /\[mesh\]/);
    assert.deepEqual(await page.locator('.tab-name').allInnerTexts(), ['Base'], 'all faces have one mesh');
    const after = await corner();
    // Base's forces are found anew, so that the corners come to where they were recorded, all but exactly.
    assert.notDeepEqual(after, before, 'the face follows');
    assert.ok(Math.abs(after[0] - before[0]) < 0.1 && Math.abs(after[1] - before[1]) < 0.1, `${before} and ${after}`);

    await page.getByRole('button', { name: 'Mirror', exact: true }).click();
    await untilOther(page, first.file);
    await settled(page);
    const [both] = await thick();
    await page.click('[data-tool=erase]');
    await stroke(page, [0.4, 0.55], [0.41, 0.58]);
    await untilOther(page, both.file);
    await page.keyboard.press('Control+z');
    await page.waitForFunction((file) => document.getElementById('scene-text').textContent.includes(file), both.file);
    await settled(page);
    await page.click('[data-tool=paint]');
    await page.selectOption('#paint-patch', '1');
    await depth.fill('4');
    await depth.press('Enter');
    await page.selectOption('#paint-region', { index: 1 });
    await page.click('.paint-fill .quiet');
    await untilPatches(page, 2);
    await settled(page);
    assert.deepEqual((await thick()).map(({ mm }) => mm), [16, 4]);
    await depth.fill('5.5');
    await depth.press('Enter');
    await untilText(page, '"thickness_mm" = 5.5');
    await settled(page);

    // Stiffness is as it was; the muscles of a variant move the same mesh.
    await page.selectOption('#paint-what', 'tissue');
    assert.match(await page.locator('#colour-bar').innerText(), /Stiffness kPa/);
    assert.deepEqual(await page.locator('#paint-patch option').count(), 1);
    const shown = await page.locator('.corner-table tr[data-face="0"] td').evaluateAll((cells) => cells.slice(0, 2).map((cell) => [cell.dataset.side, Number(cell.dataset.mm)]));
    await page.click('#save-menu');
    await page.fill('#save-name', 'thick');
    await page.click('[data-save=scene]');
    await page.waitForSelector('.save-sheet .status:has-text("thick.toml")');
    await page.keyboard.press('Escape');
    const out = join(studio.folder, 'out');
    await run(['run', join(studio.folder, 'thick.toml'), '--out', out], studio);
    const summary = JSON.parse(await readFile(join(out, 'summary.json'), 'utf8'));
    const own = summary.symmetry.commissure.excursion_mm;
    for (const [side, mm] of shown) {
      const there = own[side === 'right' ? 'R' : 'L'];
      assert.ok(Math.abs(mm - there) <= 1e-6 * there, `${side}: ${mm} here, ${there} by hyperex run`);
    }
    assert.deepEqual(complaints, []);
    await close();
  });

  test('the brush by keys and by touch; turned with its own tool; a page loaded again paints on', async (t) => {
    const studio = await startStudio();
    t.after(() => studio.stop());
    const { page, complaints, close } = await openStudio(browser, studio.address, { hasTouch: true, viewport: { width: 820, height: 1180 }, colorScheme: 'dark' });
    await page.click('#tab-paint');
    await page.locator('#face').focus();
    await page.keyboard.press('Enter');
    assert.equal(await page.locator('#announcement').textContent(), 'Brush down');
    for (let i = 0; i < 6; ++i) await page.keyboard.press('ArrowLeft');
    assert.equal((await patches(page)).length, 0, 'not before it is lifted');
    await page.keyboard.press('Escape');
    await page.keyboard.press(']');
    await page.keyboard.press('Enter');
    for (let i = 0; i < 6; ++i) await page.keyboard.press('ArrowLeft');
    await page.keyboard.press('Enter');
    await untilPatches(page, 1);
    await settled(page);
    const [first] = await patches(page);
    assert.equal(await page.locator('[data-paint=width] input[type=number]').inputValue(), '23');

    const { x, y, width, height } = await page.locator('#canvas-host').boundingBox();
    const touch = await page.context().newCDPSession(page);
    const finger = (type, dx = 0) => touch.send('Input.dispatchTouchEvent', {
      type, touchPoints: type === 'touchEnd' ? [] : [{ x: x + 0.7 * width + dx, y: y + 0.4 * height }],
    });
    await page.locator('#canvas-host').scrollIntoViewIfNeeded();
    await page.evaluate(() => (document.getElementById('announcement').textContent = 'kept'));
    await finger('touchStart');
    for (let i = 1; i <= 5; ++i) await finger('touchMove', 4 * i);
    await finger('touchEnd');
    await untilOther(page, first.file);
    await settled(page);
    assert.equal(await page.locator('#announcement').textContent(), 'kept', 'the same faces move otherwise: no news');
    const [second] = await patches(page);

    await page.reload();
    await page.waitForSelector('html[data-ready]');
    await page.click('#tab-paint');
    await page.locator('.tab-name >> nth=1').click();
    await page.waitForFunction(() => document.querySelectorAll('#paint-patch option').length === 2);
    await page.click('[data-tool=erase]');
    assert.ok((await tooWide(page)) <= 0);
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
    assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.slice(0, 3).map((n) => n.target.join(' ')).join(', ')}`), []);
    await page.getByRole('button', { name: 'Mirror', exact: true }).click();
    await untilOther(page, second.file);
    assert.deepEqual(complaints, []);
    await close();
  });

  test('landmarks: under a glass, step by step back, mirrored, as found; saved as JSON and loaded again', async (t) => {
    const studio = await startStudio();
    t.after(() => studio.stop());
    const { page, complaints, close } = await openStudio(browser, studio.address);
    await page.click('#open-files');
    await page.getByRole('button', { name: 'Correct them' }).click();
    const tools = page.locator('.landmark-tools');
    const press = (name) => tools.getByRole('button', { name, exact: true });
    const [cheekX, cheekY] = await placeOnFace(page, 0.207, 0.554);
    assert.ok(await press('Undo').isDisabled());
    await page.mouse.move(cheekX, cheekY);
    await page.mouse.down();
    for (let i = 1; i <= 6; ++i) await page.mouse.move(cheekX + 6 * i, cheekY + 5 * i);
    // The glass shows the point that is dragged, larger: its yellow in the middle, the cross aside.
    const yellow = await page.locator('.magnifier').evaluate((glass) => {
      const { width: size } = glass;
      const { data } = glass.getContext('2d').getImageData(0, 0, size, size);
      let count = 0;
      for (let i = 0; i < data.length; i += 4) if (data[i] > 220 && data[i + 1] > 180 && data[i + 2] < 60) ++count;
      return count / (size * size);
    });
    assert.ok(yellow > 0.005 && yellow < 0.1, `${yellow} of the glass`);
    await page.mouse.up();
    assert.ok(await page.locator('.magnifier').isHidden());
    await page.waitForFunction(() => document.querySelectorAll('#landmarks-panel .doubts li').length > 0);
    const doubts = () => page.locator('#landmarks-panel .doubts').innerText();
    const moved = await doubts();
    assert.match(moved, /cheek_L/);
    await page.keyboard.press('Control+z');
    await page.waitForFunction((text) => document.querySelector('#landmarks-panel .doubts').innerText !== text, moved);
    assert.ok(await press('As found').isDisabled(), 'it lies where it was found');
    assert.ok(!(await page.locator('#undo').isEnabled()), 'no step of the scene');
    await page.keyboard.press('Control+Shift+z');
    await page.waitForFunction((text) => document.querySelector('#landmarks-panel .doubts').innerText === text, moved);
    await press('Mirror').click();
    await page.waitForFunction((text) => document.querySelector('#landmarks-panel .doubts').innerText !== text, moved);
    await press('Undo').click();
    await page.waitForFunction((text) => document.querySelector('#landmarks-panel .doubts').innerText === text, moved);
    assert.equal(await page.locator('.landmark-choice select').evaluate((select) => select.selectedOptions[0].text), 'Cheek, right');
    await press('Redo').click();
    await page.waitForFunction((text) => document.querySelector('#landmarks-panel .doubts').innerText !== text, moved);
    await page.selectOption('.landmark-choice select', { label: 'Tip of the nose (pronasale)' });
    assert.ok(await press('Mirror').isDisabled(), 'the middle has no other side');
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
    assert.deepEqual(violations.map(({ id }) => id), []);
    await press('Use them').click();
    await untilText(page, 'landmarks-1.mrk.json');
    await settled(page);

    await page.click('#save-menu');
    await page.fill('#save-name', 'points');
    await page.click('[data-save=landmarks_json]');
    await page.waitForSelector('.save-sheet .status:has-text("points.json")');
    await page.click('[data-save=landmarks]');
    await page.waitForSelector('.save-sheet .status:has-text("points.mrk.json")');
    await page.keyboard.press('Escape');
    const saved = JSON.parse(await readFile(join(studio.folder, 'points.json'), 'utf8'));
    const [right, left] = [saved.points.cheek_R, saved.points.cheek_L];
    assert.ok(Math.hypot(right[0] + left[0], right[1] - left[1], right[2] - left[2]) < 0.02 * Math.hypot(...left), `${right} mirrors ${left}`);
    await page.keyboard.press('Control+z');
    await page.waitForFunction(() => !document.getElementById('scene-text').textContent.includes('landmarks'));
    for (const name of ['points.json', 'points.mrk.json']) {
      await page.locator('#landmarks-picker').setInputFiles(join(studio.folder, name));
      await untilText(page, name);
      await settled(page);
    }
    await page.locator('#landmarks-picker').setInputFiles({ name: 'torn.json', mimeType: 'application/json', buffer: Buffer.from('{"points": ') });
    await page.waitForSelector('#landmarks-panel .problem:not([hidden])');
    assert.match(await page.locator('#landmarks-panel .problem').innerText(), /torn\.json/);
    assert.deepEqual(complaints, []);
    await close();
  });

  test('each muscle of either side has its curve, which follows its strength; base stays to compare', async (t) => {
    const studio = await startStudio();
    t.after(() => studio.stop());
    const { page, complaints, close } = await openStudio(browser, studio.address);
    const group = page.locator('.muscle-group', { has: page.locator('[data-gain=zyg_major_R]') });
    await group.locator('summary').first().click();
    const row = group.locator('.strength', { hasText: 'Zygomaticus major' });
    const most = async (i) => Number(/at most (-?[\d.]+)/.exec(await row.locator('.activation svg').nth(i).getAttribute('aria-label'))[1]);
    const [right, left] = [await most(0), await most(1)];
    assert.ok(right > 0.05 && left > 0.05, `${right} and ${left}`);
    assert.equal(await row.locator('.base').first().getAttribute('points'), '');
    const half = row.locator('[data-gain$=_R]').first();
    await half.focus();
    for (let i = 0; i < 5; ++i) await page.keyboard.press('PageDown');
    await page.waitForFunction(() => /gain = \{/.test(document.getElementById('scene-text').textContent));
    await page.waitForFunction(() => document.querySelector('.tab-name[data-face="1"]'));
    await settled(page);
    const gain = Number(/"\w+_R" = ([\d.]+)/.exec(await sceneText(page))?.[1] ?? 0);
    assert.ok(Math.abs((await most(0)) - gain * right) < 0.011, `${await most(0)} of ${right} at ${gain}`);
    assert.ok(Math.abs((await most(1)) - left) < 0.011);
    assert.notEqual(await row.locator('.base').first().getAttribute('points'), '');
    assert.deepEqual(complaints, []);
    await close();
  });
});
