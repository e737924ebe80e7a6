// SPDX-License-Identifier: GPL-3.0-or-later
// Reports and tracking pages on paper: how many sheets, that nothing is cut, and that the 3D view is a picture there.
//   REPORT=out/demo/report.html SCREENSHOTS=/tmp/pictures node --test web/tests/print.test.mjs     one written by the program: at most 4 sheets
import assert from 'node:assert/strict';
import { writeFile } from 'node:fs/promises';
import { join, resolve } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { fixture } from './fixtures.mjs';
import { rarePage } from './made_up_page.mjs';
import { a4, millimetres, onPaper, pagesOf } from './paper.mjs';
import { distinctColours, decode } from './pixels.mjs';

const pictures = process.env.SCREENSHOTS;
let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

const reports = process.env.REPORT ? [{ name: 'given', file: () => resolve(process.env.REPORT), sheets: 4 }] : [
  { name: 'base alone', file: () => fixture('coloured.html'), sheets: 1 },
  { name: 'five variants', file: () => fixture('variants.html'), sheets: 3 },
  { name: 'rare figures', file: rarePage, sheets: 4 },
];

/** Opened at the size of a sheet's inside, or of a desk's window. */
const sheet = { viewport: { width: Math.ceil(a4.width), height: Math.floor(a4.height) } };

async function printed(page, name, options = { preferCSSPageSize: true }) {
  const pdf = await page.pdf(options);
  if (pictures) await writeFile(join(pictures, `${name.replaceAll(' ', '_')}.pdf`), pdf);
  return pdf;
}

/** What a sheet would cut: whatever is wider than it, and text wider than its cell or box. */
const cutParts = (page, width) => page.evaluate((most) => {
  const named = (part) => `${part.tagName} ${part.className} ${part.textContent.trim().slice(0, 30)}`;
  const seen = [...document.querySelectorAll('body *')].filter((part) => part.checkVisibility({ visibilityProperty: true }) &&
    !part.closest('.unseen, .only-heard, .u-over'));
  const outside = seen.filter((part) => {
    const { left, right, width } = part.getBoundingClientRect();
    return width > 0 && (left < -1 || right > most + 1);
  });
  const narrow = seen.filter((part) => part.matches('td, th, p, li, h1, h2, h3, dd, dt, .scroller') && part.clientWidth > 0 &&
    part.scrollWidth > part.clientWidth + 1);
  return [...outside, ...narrow].map(named);
}, width);

/** The smallest letters of the page, in points. */
const leastLetters = (page) => page.evaluate(() => {
  const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  let least = Infinity;
  while (texts.nextNode()) {
    const { parentElement: holder, data } = texts.currentNode;
    if (!data.trim() || !holder.checkVisibility() || holder.closest('.unseen, script, style')) continue;
    least = Math.min(least, parseFloat(getComputedStyle(holder).fontSize) * (holder.closest('.u-legend') ? 1 : holder.currentCSSZoom) * 0.75);
  }
  return least;
});

const controls = 'button.quiet:visible, input:visible, .transport:visible, .toolbar:visible, .chooser:visible, #canvas-host:visible, dialog:visible';

for (const { name, file, sheets } of reports)
  describe(`a report on paper, ${name}`, () => {
    for (const colorScheme of ['light', 'dark']) {
      test(`takes few sheets, and the screen is as before (${colorScheme})`, async () => {
        const { page, complaints, close } = await openPage(browser, await file(), { colorScheme });
        const state = () => page.evaluate(() => [
          document.documentElement.className, document.querySelectorAll('details[open]').length,
          document.body.innerText, getComputedStyle(document.body).color,
        ]);
        const before = await state();
        for (const format of ['A4', 'Letter']) {
          const pdf = await printed(page, `${name} ${format} ${colorScheme}`, format === 'A4' ? undefined : { format });
          const [pages, most] = [pagesOf(pdf), format === 'A4' ? sheets : sheets + 1];
          console.log(`${name}, ${format}: ${pages} sheets`);
          assert.ok(pages >= 1 && pages <= most, `${pages} sheets`);
        }
        assert.deepEqual(await state(), before);
        assert.ok(await page.locator('#face').isVisible());
        assert.deepEqual(complaints, []);
        await close();
      });

      test(`has nothing cut, no small letters and no controls (${colorScheme})`, async () => {
        const { page, close } = await openPage(browser, await file(), { ...sheet, colorScheme });
        await onPaper(page, true);
        assert.deepEqual(await cutParts(page, a4.width), []);
        const least = await leastLetters(page);
        assert.ok(least >= 6.5, `${least} points`);
        assert.equal(await page.locator(controls).count(), 0);
        assert.equal(await page.locator('details:not([open]):visible').count(), 0, 'nothing is folded');
        assert.equal(await page.locator('body').evaluate((body) => getComputedStyle(body).color), 'rgb(17, 17, 17)');
        const breaks = await page.locator('tr:visible').evaluateAll((rows) => rows.map((row) => getComputedStyle(row).breakInside));
        assert.ok(breaks.every((inside) => inside === 'avoid'), 'rows stay whole');
        const heads = await page.locator('thead:visible').evaluateAll((all) => all.map((head) => getComputedStyle(head)).map((style) => [style.display, style.breakInside]));
        for (const head of heads) assert.deepEqual(head, ['table-header-group', 'avoid'], 'repeated on each sheet');
        await close();
      });

      test(`shows the face and the curves (${colorScheme})`, async () => {
        const { page, close } = await openPage(browser, await file(), { colorScheme });
        await page.locator('#to-peak').click();
        await onPaper(page, true);
        const face = page.locator('.printed-stage > canvas');
        const { height } = await face.boundingBox();
        assert.ok(millimetres(height) <= 110 && millimetres(height) > 40, `${millimetres(height)} mm`);
        const seen = await decode(page, await face.screenshot());
        const colours = await distinctColours(seen);
        assert.ok(colours > 100, `${colours} colours`);
        const corner = await seen.evaluate(({ data }) => Math.min(data[0], data[1], data[2]));
        assert.ok(corner > 190, `on a light ground: ${corner}`);
        assert.match(await page.locator('.printed-stage figcaption').first().innerText(), /\d\.\d{3} s[\s\S]*R and L: the person’s own right and left/);
        for (const chart of await page.locator('.plot-card canvas').all()) {
          const drawn = await decode(page, await chart.screenshot());
          assert.ok(await distinctColours(drawn) > 4, await chart.getAttribute('aria-label'));
          const paper = await drawn.evaluate(({ data, width }) => Math.min(...data.slice(4 * (2 * width + 2), 4 * (2 * width + 2) + 3)));
          assert.ok(paper > 240, 'on white');
        }
        await close();
      });
    }
  });

test('two faces are printed as they stand beside each other', { skip: Boolean(process.env.REPORT) }, async () => {
  const { page, close } = await openPage(browser, fixture('variants.html'));
  await page.getByRole('button', { name: 'Side by side' }).click();
  await page.getByRole('button', { name: 'Displacement', exact: true }).click();
  await onPaper(page, true);
  const words = await page.locator('.printed-stage').innerText();
  assert.match(words, /left picture: base[\s\S]*right picture: stiff right cheek[\s\S]*Displacement from rest/);
  await onPaper(page, false);
  assert.equal(await page.locator('.printed-stage').count(), 0);
  await close();
});

test('points that the reader has shown are printed, others are counted', { skip: Boolean(process.env.REPORT) }, async () => {
  const { page, close } = await openPage(browser, await rarePage());
  const points = () => page.locator('.excursions tbody tr:visible').count();
  await onPaper(page, true);
  assert.match(await page.locator('.left-out').innerText(), /^1 more point /);
  const first = await points();
  await onPaper(page, false);
  await page.getByRole('button', { name: 'Show 1 more points' }).click();
  await onPaper(page, true);
  assert.equal(await points(), first + 1);
  assert.equal(await page.locator('.left-out').innerText(), '');
  await close();
});
