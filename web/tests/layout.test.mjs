// SPDX-License-Identifier: GPL-3.0-or-later
// How the pages lie in windows of several sizes and under fingers.
//   SCREENSHOTS=/tmp/pictures node --test web/tests/layout.test.mjs
import assert from 'node:assert/strict';
import { mkdtemp, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { launch, openPage, tooWide } from './browser.mjs';
import { fixture } from './fixtures.mjs';
import { openMadeUp } from './made_up_studio.mjs';
import { readPage, withData } from './page_data.mjs';

const report = fixture('variants.html');
const pictures = process.env.SCREENSHOTS;
let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

const shoot = async (page, name) => {
  if (!pictures) return;
  await page.waitForSelector('#face[data-at-rest="true"]');
  await page.screenshot({ path: join(pictures, `${name}.png`) });
};

/** In how many rows the visible children lie. */
const rows = (page, selector) => page.locator(selector).evaluate((row) => {
  const middles = [...row.children].map((child) => child.getBoundingClientRect()).filter(({ width }) => width > 0)
    .map(({ top, height }) => top + height / 2).sort((a, b) => a - b);
  return middles.filter((at, i) => i === 0 || at - middles[i - 1] > 12).length;
});

for (const width of [1280, 1440, 1920])
  test(`what moves the face lies in one row at ${width} px, and ? not alone`, async () => {
    const { page, close } = await openPage(browser, report, { viewport: { width, height: 900 } });
    await page.keyboard.press('2');
    await page.keyboard.press('s');
    assert.ok(await page.locator('#to-most').isVisible(), 'the longest row');
    assert.equal(await rows(page, '.transport'), 1);
    assert.equal(await rows(page, '.page-head'), 1, 'the keys are listed beside the title');
    await page.locator('#open-help').click();
    assert.ok(await page.getByRole('dialog', { name: 'Keys' }).isVisible());
    await page.keyboard.press('Escape');
    await shoot(page, `report_${width}`);
    await close();
  });

for (const width of [390, 1024])
  test(`faces without room are behind an arrow at ${width} px`, async () => {
    const { page, close } = await openPage(browser, report, { viewport: { width, height: 840 } });
    const row = page.locator(width < 600 ? '#faces' : '#chips');
    await page.locator('#chips').evaluate((chips) => {
      for (let i = 0; i < 9; ++i) chips.append(Object.assign(document.createElement('button'), { textContent: `another face ${i}`, className: 'chip' }));
    });
    await page.waitForFunction((id) => document.getElementById(id).dataset.more === 'right', await row.getAttribute('id'));
    assert.match(await row.evaluate((e) => getComputedStyle(e, '::after').content), /›/);
    await row.evaluate((e) => e.scrollTo(1e6, 0));
    await page.waitForFunction((id) => document.getElementById(id).dataset.more === 'left', await row.getAttribute('id'));
    assert.ok((await tooWide(page)) <= 0);
    await close();
  });

const phone = { viewport: { width: 390, height: 840 }, hasTouch: true, isMobile: true };

test('a telephone shows the whole time, and that rows go on', async () => {
  const { page, close } = await openPage(browser, report, phone);
  await page.locator('#to-peak').click();
  const time = page.locator('#frame-label');
  assert.match(await time.innerText(), /\d\.\d{3} s$/);
  const [label, row] = [await time.boundingBox(), await page.locator('.transport').boundingBox()];
  assert.ok(label.x + label.width <= row.x + row.width, 'within the row');
  assert.equal(await time.evaluate((e) => e.scrollWidth <= e.clientWidth + 1), true, 'not cut');
  for (const id of ['to-peak', 'to-most', 'speed']) {
    const box = await page.locator(`#${id}`).boundingBox();
    assert.ok(box.x >= 0 && box.x + box.width <= 390, id);
  }
  assert.match(await page.locator('#view-tools').evaluate((e) => getComputedStyle(e).backgroundAttachment), /local.*scroll/, 'a shadow where there is more');
  assert.ok((await tooWide(page)) <= 0);
  await shoot(page, 'report_phone');
  await close();
});

/** What can be pressed and is lower than a finger needs. A box counts with its label. */
const small = (page) => page.evaluate(() => [...document.querySelectorAll('button, select, summary, input, [role=button]')]
  .map((control) => (control.type === 'checkbox' || control.type === 'radio' ? control.closest('label') ?? control : control))
  .map((control) => ({ control, box: control.getBoundingClientRect() }))
  .filter(({ control, box }) => box.width > 0 && control.checkVisibility({ visibilityProperty: true }) && (box.height < 43.5 || box.width < 43.5))
  .map(({ control, box }) => `${control.tagName} ${control.id || control.className || control.textContent.slice(0, 20)} ${box.width.toFixed(0)}x${box.height.toFixed(0)}`));

test('fingers have 44 px: report', async () => {
  const { page, close } = await openPage(browser, report, phone);
  assert.deepEqual(await small(page), []);
  await close();
});

test('fingers have 44 px, and a bar of choices that has no room is scrolled: studio', async () => {
  const { page, close } = await openMadeUp(browser, () => [], { viewport: { width: 1024, height: 768 }, hasTouch: true, isMobile: true });
  for (const tab of ['muscles', 'tissue', 'paint', 'scene']) {
    await page.locator(`#tab-${tab}`).click();
    await page.locator('.panels details').evaluateAll((all) => all.forEach((one) => (one.open = true)));
    assert.deepEqual(await small(page), [], tab);
  }
  await page.locator('#tab-muscles').click();
  await shoot(page, 'studio_1024');
  // Three more colourings make the bar too wide.
  await page.locator('#colouring').evaluate((bar) => {
    for (const text of ['Difference', 'Young’s modulus', 'Viscosity']) bar.append(Object.assign(document.createElement('button'), { textContent: text }));
  });
  const tools = page.locator('#view-tools');
  const [inside, wide] = await tools.evaluate((bar) => [bar.clientWidth, bar.scrollWidth]);
  assert.ok(wide > inside, 'it has no room');
  assert.equal(await rows(page, '#colouring'), 1, 'it is scrolled, not stacked: the face stays as large');
  assert.match(await tools.evaluate((e) => getComputedStyle(e).backgroundAttachment), /local.*scroll/, 'a shadow where there is more');
  assert.ok((await tooWide(page)) <= 0);
  await shoot(page, 'studio_1024_bar');
  await close();
});

test('warnings are read above the face, not behind a link', async () => {
  const { html, data } = await readPage(report);
  data.summary.warnings = ['the skin is 12.5 mm off the scan near chin, left', 'scan.ply: two', 'three', 'four'];
  const file = join(await mkdtemp(join(tmpdir(), 'hyperex-page-')), 'warned.html');
  await writeFile(file, withData(html, data));
  const { page, close } = await openPage(browser, file, { viewport: { width: 1440, height: 900 } });
  assert.deepEqual(await page.locator('#warning-list li').allTextContents(), [
    'Warning: The skin is 12.5 mm off the scan near chin, left', 'Warning: scan.ply: two', 'Warning: Three', '1 more warning']);
  const [warning, face] = [await page.locator('#warning-list li').first().boundingBox(), await page.locator('#face').boundingBox()];
  assert.ok(warning.y + warning.height < face.y && warning.y < 100);
  await shoot(page, 'report_warned');
  await close();
  await rm(dirname(file), { recursive: true });
  const plain = await openPage(browser, report);
  assert.equal(await plain.page.locator('#warning-list').isVisible(), false);
  await plain.close();
});
