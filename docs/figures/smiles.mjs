#!/usr/bin/env node
// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of every second frame of all faces of a report, as Chromium draws them, for smiles.py:
//   make demo && node docs/figures/smiles.mjs out/demo/report.html FOLDER
import { mkdir } from 'node:fs/promises';
import { join, resolve } from 'node:path';
import { launch, openPage } from '../../web/tests/browser.mjs';

const [report, folder] = process.argv.slice(2);
if (!folder) throw new Error('expected: smiles.mjs REPORT.html FOLDER');
await mkdir(folder, { recursive: true });
const browser = await launch();
const { page } = await openPage(browser, resolve(report), { colorScheme: 'light', viewport: { width: 1000, height: 780 } });
await page.addStyleTag({ content: '#stage > :not(#canvas-host), #canvas-host > :not(canvas) { visibility: hidden !important; }' });
const faces = await page.locator('#chips button').count();
const last = Number(await page.locator('#frame').getAttribute('max'));
for (let face = 0; face < faces; ++face) {
  await page.locator('#chips button').nth(face).click();
  for (let frame = 0; frame <= last; frame += 2) {
    await page.locator('#frame').evaluate((slider, at) => {
      slider.value = String(at);
      slider.dispatchEvent(new Event('input', { bubbles: true }));
    }, frame);
    await page.waitForSelector(`#face[data-faces="${face}"][data-at-rest="true"]`);
    await page.locator('#canvas-host').screenshot({ path: join(folder, `${face}_${String(frame).padStart(3, '0')}.png`) });
  }
}
await browser.close();
