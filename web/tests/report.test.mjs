// SPDX-License-Identifier: GPL-3.0-or-later
// Opens report.html in Chromium as a user would, from the disk, and uses it.
//   REPORT=out/a/report.html SCREENSHOTS=/tmp/pictures node --test web/tests/report.test.mjs
// Without REPORT it takes the reports of a made-up face that write_report_fixtures wrote.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { basename, join, resolve } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { launch, openPage, tooWide } from './browser.mjs';
import { fixture } from './fixtures.mjs';
import { changedShare, distinctColours, look } from './pixels.mjs';

const reports = process.env.REPORT
  ? [resolve(process.env.REPORT)]
  : ['plain.html', 'coloured.html', 'textured.html'].map(fixture);
const pictures = process.env.SCREENSHOTS;

let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

async function open(report, options = {}) {
  const view = await openPage(browser, report, { pixels: true, ...options });
  await view.page.waitForSelector('#face[data-frame]', { timeout: 60_000 });
  return view;
}

const drawnFrame = (page) => page.locator('#face').getAttribute('data-frame').then(Number);

async function goTo(page, frame) {
  await page.locator('#frame').fill(String(frame));
  await page.waitForFunction((f) => Number(document.getElementById('face').dataset.frame) === f, frame);
}

for (const report of reports) {
  describe(basename(report), () => {
    let page, complaints, close;
    // A small window: software draws every pixel of it. Full sizes are below.
    before(async () => ({ page, complaints, close } = await open(report, { viewport: { width: 960, height: 560 } })));
    after(() => close?.());

    test('carries the notices of the packages inside it', async () => {
      const html = await readFile(report, 'utf8');
      for (const owner of ['three.js authors', 'Leon Sorokin'])
        assert.match(html, new RegExp(`Copyright \\S+ [-0-9]+ ${owner}\\s+Permission is hereby granted`), owner);
    });

    test('shows a face, not a blank canvas', async () => {
      const pixels = await look(page);
      const colours = await distinctColours(pixels);
      assert.ok(colours > 40, `only ${colours} colours`);
      await page.locator('#face').evaluate((c) => (c.style.opacity = '0'));
      const share = await changedShare(pixels, await look(page));
      await page.locator('#face').evaluate((c) => (c.style.opacity = ''));
      assert.ok(share > 0.08, `the face fills ${(100 * share).toFixed(1)} % of the canvas`);
    });

    test('the slider moves face, label and cursors', async () => {
      const last = Number(await page.locator('#frame').getAttribute('max'));
      assert.ok(last > 0);
      await goTo(page, 0);
      const atRest = await look(page);
      const label = await page.locator('#frame-label').textContent();
      const cursor = () => page.locator('.now').last().evaluate((e) => e.getBoundingClientRect().x);
      const cursorAtRest = await cursor();
      const middle = Math.round(last / 2);
      await goTo(page, middle);
      assert.ok(await changedShare(atRest, await look(page)) > 0.01);
      assert.notEqual(await page.locator('#frame-label').textContent(), label);
      assert.match(await page.locator('#frame-label').textContent(), new RegExp(`frame ${middle} / ${last}`));
      assert.ok((await cursor()) > cursorAtRest + 20);
      await page.locator('#frame').press('ArrowRight');
      await page.waitForFunction((f) => Number(document.getElementById('face').dataset.frame) === f, middle + 1);
    });

    test('colouring, views and overlays change the picture', async () => {
      await page.locator('#to-peak').click();
      const skin = await look(page);
      assert.equal(await page.locator('#colour-bar').isVisible(), false);
      await page.getByRole('button', { name: 'Displacement' }).click();
      const mapped = await look(page);
      assert.equal(await page.locator('#colour-bar').isVisible(), true);
      await page.getByRole('button', { name: 'Skin' }).click();
      assert.ok(await changedShare(mapped, skin) > 0.08);
      assert.equal(await page.locator('#colour-bar').isVisible(), false);
      await page.getByRole('button', { name: 'Three-quarter' }).click();
      const turned = await look(page);
      assert.ok(await changedShare(skin, turned) > 0.05);
      await page.getByRole('button', { name: 'Front' }).click();
      const boxes = page.locator('#overlays input');
      const tick = async (i) => {
        await page.locator('#show-overlays').click();
        await boxes.nth(i).click();
        await page.keyboard.press('Escape');
      };
      for (let i = 0; i < (await boxes.count()); ++i) {
        const without = await look(page);
        await tick(i);
        assert.ok(await changedShare(without, await look(page)) > 1e-4, `overlay ${i} shows nothing`);
        await tick(i);
      }
      await page.getByRole('button', { name: 'Displacement' }).click();
      // The page may have moved the view by a pixel since.
      assert.ok(await changedShare(mapped, await look(page)) < 0.04, 'back to the first picture');
    });

    test('pressing on a plot seeks', async () => {
      await goTo(page, 0);
      const over = page.locator('.u-over').last();
      await over.scrollIntoViewIfNeeded();
      const box = await over.boundingBox();
      await page.mouse.click(box.x + 0.7 * box.width, box.y + 0.5 * box.height);
      const last = Number(await page.locator('#frame').getAttribute('max'));
      const frame = Number(await page.locator('#frame').inputValue());
      assert.ok(Math.abs(frame - 0.7 * last) <= 1.5, `frame ${frame} of ${last}`);
    });

    test('plays and pauses', async () => {
      await goTo(page, 0);
      await page.locator('#play').click();
      await page.waitForFunction(() => Number(document.getElementById('face').dataset.frame) > 0);
      await page.getByRole('button', { name: 'Pause' }).click();
      const label = await page.locator('#frame-label').textContent();
      await page.waitForTimeout(200);
      assert.equal(await page.locator('#frame-label').textContent(), label);
    });

    test('says nothing on the console and asks nothing of the network', () => {
      assert.deepEqual(complaints, []);
    });

    for (const [name, options] of [
      ['light', {}],
      ['dark', { colorScheme: 'dark' }],
      ['phone', { viewport: { width: 390, height: 840 }, hasTouch: true, isMobile: true }],
    ]) {
      test(`fits the window (${name})`, async () => {
        const view = await open(report, options);
        await view.page.locator('#to-peak').click();
        const wide = await tooWide(view.page);
        assert.ok(wide <= 0, `${wide} px too wide`);
        assert.ok((await drawnFrame(view.page)) >= 0);
        if (pictures) {
          await view.page.waitForTimeout(300);
          const file = `${basename(report, '.html')}_${name}.png`;
          await view.page.screenshot({ path: join(pictures, file), fullPage: true });
        }
        assert.deepEqual(view.complaints, []);
        await view.close();
      });
    }
  });
}
