// SPDX-License-Identifier: GPL-3.0-or-later
// The studio's main path in Firefox: load, correct a landmark, weaken a muscle, compare, save; the saved scene gives
// the same numbers by the command.
//   HYPEREX=build/release/bin/hyperex node --test web/tests/studio_firefox.test.mjs
import assert from 'node:assert/strict';
import { mkdir, readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { test } from 'node:test';
import { launchFirefox, noFirefox } from './firefox.mjs';
import { program, run, startStudio } from './studio_server.mjs';

const skip = !program() ? 'the program is not built' : noFirefox() || false;

const settled = (page, what = '') => page.until((text) =>
  document.documentElement.dataset.current === 'true' && document.getElementById('scene-text').textContent.includes(text), what);
const cornerMm = (page, face, side) => page.evaluate((f, s) =>
  Number(document.querySelector(`.corner-table tr[data-face="${f}"] td[data-side=${s}]`).dataset.mm), face, side);

test('Firefox: a landmark corrected, a muscle weakened, compared, saved and run again', { skip }, async (t) => {
  const studio = await startStudio();
  t.after(() => studio.stop());
  const firefox = await launchFirefox();
  t.after(() => firefox.close());
  const page = await firefox.open(studio.address);
  await page.until(() => document.documentElement.dataset.ready === 'true');
  assert.equal(await page.evaluate(() => document.getElementById('no-webgl').hidden), true, 'WebGL, in software');

  await page.click('#open-files');
  await page.click('#landmarks-panel > .landmark-buttons > .quiet');
  const box = await page.evaluate(() => document.getElementById('canvas-host').getBoundingClientRect().toJSON());
  const [x, y] = [box.x + 0.5 * box.width + 0.207 * box.height, box.y + 0.554 * box.height];
  await page.press([x, y], [x + 2, y + 1], [x + 5, y + 3], [x + 8, y + 5]);
  assert.equal(await page.evaluate(() => document.querySelector('.landmark-choice select').selectedOptions[0].text), 'Cheek, left');
  await page.click('.landmark-buttons .primary');
  await settled(page, 'landmarks');

  await page.click('#what-if');
  await page.click('[data-choice=side_R]');
  await settled(page, 'side_R');
  const [base, weak] = [await cornerMm(page, 0, 'right'), await cornerMm(page, 1, 'right')];
  assert.ok(weak < base - 1 && weak > 0.4 * base, `${base} to ${weak} mm`);
  await page.click('#modes [data-mode=wipe]');
  await page.click('[data-colouring=difference]');
  assert.match(await page.text('#colour-bar'), /Distance between the faces/);
  if (process.env.SCREENSHOTS) {
    await mkdir(process.env.SCREENSHOTS, { recursive: true });
    await writeFile(join(process.env.SCREENSHOTS, 'firefox.png'), await page.screenshot());
  }

  await page.click('#save-menu');
  await page.fill('#save-name', 'weaker');
  await page.click('[data-save=scene]');
  await page.until(() => /weaker\.toml/.test(document.querySelector('.save-sheet .status')?.textContent ?? ''));
  const out = join(studio.folder, 'out');
  await run(['run', join(studio.folder, 'weaker.toml'), '--out', out], studio);
  const summary = JSON.parse(await readFile(join(out, 'summary.json'), 'utf8'));
  const excursions = (holder) => holder.excursions.find(({ point }) => point === 'cheilion' || point === 'ibug68_48/54').excursion_mm;
  for (const [face, own] of [excursions(summary.symmetry), excursions(summary.variants.table[1])].entries())
    for (const [side, name] of [['right', 'R'], ['left', 'L']]) {
      const shown = await cornerMm(page, face, side);
      assert.ok(Math.abs(shown - own[name]) <= 1e-6 * own[name], `face ${face}, ${side}: ${shown} here, ${own[name]} by hyperex run`);
    }
  assert.deepEqual(page.complaints, []);
});

test('Firefox without WebGL: the page says so, and figures and panels work', { skip }, async (t) => {
  const studio = await startStudio();
  t.after(() => studio.stop());
  const firefox = await launchFirefox({ 'webgl.disabled': true, 'webgl.force-enabled': false });
  t.after(() => firefox.close());
  const page = await firefox.open(studio.address);
  await page.until(() => document.documentElement.dataset.ready === 'true');
  assert.equal(await page.evaluate(() => document.getElementById('no-webgl').hidden), false);
  assert.match(await page.text('#no-webgl'), /WebGL/);
  await page.click('#what-if');
  await page.click('[data-choice=side_R]');
  await settled(page, 'side_R');
  assert.ok((await cornerMm(page, 1, 'right')) < (await cornerMm(page, 0, 'right')) - 1);
});
