// SPDX-License-Identifier: GPL-3.0-or-later
// Teeth show in an open mouth, in a closed one they do not, and the lower ones go along with the jaw.
import assert from 'node:assert/strict';
import { mkdtemp, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { fixture } from './fixtures.mjs';
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
  const { page, complaints, close } = await openPage(browser, file, { viewport: { width: 960, height: 560 } });
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
