// SPDX-License-Identifier: GPL-3.0-or-later
// Warnings of the program beside the control that causes them: its own server and page in Chromium. By id, not by sentence.
//   HYPEREX=build/release/bin/hyperex node --test web/tests/studio_remarks.test.mjs
import assert from 'node:assert/strict';
import { after, before, describe, test } from 'node:test';
import { launch } from './browser.mjs';
import { openStudio, program, startStudio } from './studio_server.mjs';

const skip = program() ? false : 'the program is not built';
const id = 'variant.muscle_hardly_used';
/** The smile needs next to nothing of it. */
const muscle = 'corrugator_R';

describe('remarks in the studio', { skip, concurrency: false }, () => {
  let browser;
  before(async () => (browser = await launch()));
  after(() => browser?.close());

  test('a strength that the recording hardly uses: the warning stands beside its slider and goes with it', async (t) => {
    const studio = await startStudio();
    t.after(() => studio.stop());
    const { page, complaints, close } = await openStudio(browser, studio.address);
    const slider = page.locator(`[data-gain=${muscle}]`);
    const settled = () => page.waitForFunction(() => document.documentElement.dataset.current === 'true');
    const beside = page.locator(`#panel-muscles [data-note-id="${id}"]`);
    await slider.evaluate((input) => (input.closest('details').open = true));
    assert.equal(await beside.count(), 0);
    await slider.focus();
    await page.keyboard.press('Home'); // one key, and therefore one step of the history
    await page.waitForFunction((name) => new RegExp(`"${name}" = 0(?![.\\d])`).test(document.getElementById('scene-text').textContent), muscle);
    await settled();
    await beside.waitFor();
    // In one step: remarks are placed anew when uncertainties arrive.
    const placed = await page.evaluate(([note, gain]) => {
      const text = document.querySelector(`#panel-muscles [data-note-id="${note}"]`);
      const input = text.parentElement.querySelector('input');
      const described = document.querySelector(`[data-gain=${gain}]`).getAttribute('aria-describedby') === text.id;
      return { gain: input.dataset.gain, described };
    }, [id, muscle]);
    assert.deepEqual(placed, { gain: muscle, described: true });
    assert.equal(await page.locator('[aria-describedby]').count(), 1, 'it describes no other control');
    assert.equal(await page.locator(`#messages-panel [data-note-id="${id}"]`).count(), 1);
    assert.ok(await page.locator('#tab-muscles.has-remark').count());

    // Base has no such warning, and neither has the variant once the strength is as it was.
    await page.click('#tabs .tab-name >> nth=0');
    await page.evaluate(() => document.querySelector('[data-mode=single]').click());
    await beside.waitFor({ state: 'detached' });
    assert.equal(await slider.getAttribute('aria-describedby'), null);
    await page.click('#tabs .tab-name >> nth=1');
    await beside.waitFor();
    await page.keyboard.press('Control+z');
    await settled();
    await beside.waitFor({ state: 'detached' });
    assert.deepEqual(complaints, []);
    await close();
  });
});
