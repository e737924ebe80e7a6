// SPDX-License-Identifier: GPL-3.0-or-later
// The studio live: a recording played at its own pace moves the face, a take of it becomes the scene's motion and runs
// by the command.
//   HYPEREX=build/release/bin/hyperex node --test web/tests/studio_live.test.mjs
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { mkdir, readFile, writeFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { launch } from './browser.mjs';
import { openStudio, program, run, startStudio } from './studio_server.mjs';
import { zipOf, zipOfFolder } from './zip.mjs';

const recording = join(dirname(fileURLToPath(import.meta.url)), '..', '..', '..', 'shared', 'data', 'rgbd', 'subject_A_mouth_open');
const skip = !program() ? 'the program is not built' : !existsSync(recording) ? 'no recordings beside the checkout' : false;
const axe = await readFile(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

describe('the studio live', { skip, concurrency: false }, () => {
  let browser;
  before(async () => (browser = await launch()));
  after(() => browser?.close());

  test('a face follows, a take is recorded, trimmed, used and saved', async (t) => {
    const studio = await startStudio(['--device', `play:${recording}`]);
    t.after(() => studio.stop());
    const { page, complaints, close } = await openStudio(browser, studio.address);
    await page.click('#open-files');
    const panel = page.locator('#live-panel');
    await panel.locator('.choices button').click();
    await panel.getByRole('button', { name: 'Record a take' }).click();
    await page.waitForSelector('#live-panel[data-live=ended]');
    const figures = await page.locator('.live-figures dd').allInnerTexts();
    const [rate, delay, most, dropped, followed] = figures;
    assert.match(`${rate} ${delay} ${most} ${dropped} ${followed}`, /^\d+ \d+ ms \d+ ms \d+ \d+ of \d+$/);
    assert.equal(await panel.locator('.problem').isVisible(), false);
    await page.waitForSelector('.trim-curve polyline[points]');
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => window.axe.run('#live-panel', { resultTypes: ['violations'] }));
    assert.deepEqual(violations.map(({ id }) => id), []);
    if (process.env.SCREENSHOTS) {
      await mkdir(process.env.SCREENSHOTS, { recursive: true });
      await panel.scrollIntoViewIfNeeded();
      await writeFile(join(process.env.SCREENSHOTS, 'live-take.png'), await page.screenshot());
    }
    // The first end by keys, a twentieth of the take.
    const from = panel.getByRole('slider', { name: 'From' });
    await from.focus();
    for (let i = 0; i < 50; ++i) await page.keyboard.press('ArrowRight');
    const cut = await from.getAttribute('aria-valuetext');
    assert.ok(parseFloat(cut) > 0, cut);

    await panel.getByRole('button', { name: 'Use the take' }).click();
    await page.waitForFunction(() => /take-1\.csv/.test(document.getElementById('scene-text').textContent));
    await page.waitForFunction(() => document.documentElement.dataset.current === 'true');
    const mm = (side) => page.locator(`.corner-table tr[data-face="0"] td[data-side=${side}]`).first().getAttribute('data-mm').then(Number);
    assert.ok((await mm('left')) > 1 && (await mm('left')) < 40, `${await mm('left')} mm`);
    await page.click('#save-menu');
    await page.fill('#save-name', 'take');
    await page.click('[data-save=scene]');
    await page.waitForSelector('.save-sheet .status:has-text("take.toml")');
    const out = join(studio.folder, 'out');
    await run(['run', join(studio.folder, 'take.toml'), '--out', out], studio);
    const summary = JSON.parse(await readFile(join(out, 'summary.json'), 'utf8'));
    const own = summary.symmetry.excursions.find(({ point }) => point === 'cheilion' || point === 'ibug68_48/54').excursion_mm;
    for (const [side, name] of [['right', 'R'], ['left', 'L']])
      assert.ok(Math.abs((await mm(side)) - own[name]) <= 1e-6 * own[name], `${side}: ${await mm(side)} here, ${own[name]} by hyperex run`);
    assert.deepEqual(complaints, []);
    await close();
  });

  test('a scan is moved by the recording in a zip, which goes along with the saved scene', async (t) => {
    const studio = await startStudio();
    t.after(() => studio.stop());
    const { page, complaints, close } = await openStudio(browser, studio.address);
    const scan = join(recording, '..', '..', 'ict', 'subject_A_neutral_scan.ply');
    const choose = async (name, zip) => page.locator('#file-picker').setInputFiles([
      { name: 'me.ply', mimeType: 'model/ply', buffer: await readFile(scan) }, { name, mimeType: 'application/zip', buffer: zip }]);
    await choose('bad.zip', zipOf([['../rgb.txt', Buffer.from('x')]]));
    await page.waitForSelector('#open-panel > .problem:has-text("leads elsewhere")');
    await choose('talk.zip', zipOfFolder(recording, 'opening'));
    await page.waitForFunction(() => /recording = ".*opening"/.test(document.getElementById('scene-text').textContent));
    await page.waitForFunction(() => document.documentElement.dataset.current === 'true');
    await page.click('#save-menu');
    await page.fill('#save-name', 'zipped');
    await page.click('[data-save=scene]');
    await page.waitForSelector('.save-sheet .status:has-text("zipped.toml")');
    assert.ok(existsSync(join(studio.folder, 'zipped_files', 'opening', 'rgb.txt')));
    assert.match(await readFile(join(studio.folder, 'zipped.toml'), 'utf8'), /recording = "zipped_files\/opening"/);
    await run(['check', join(studio.folder, 'zipped.toml')], studio);
    assert.deepEqual(complaints, []);
    await close();
  });
});
