// SPDX-License-Identifier: GPL-3.0-or-later
// The page of a patient's visits with made-up figures: what it says, how it lies in windows, and that it prints as one page.
//   SCREENSHOTS=/tmp/pictures node --test web/tests/visits.test.mjs
//   VISITS=out/visits.html node --test web/tests/visits.test.mjs     one written by the program: window and paper alone
import assert from 'node:assert/strict';
import { rm, writeFile } from 'node:fs/promises';
import { dirname, join, resolve } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { launch, openPage, tooWide } from './browser.mjs';
import { madeUpVisits, visitsPage } from './made_up_visits.mjs';
import { millimetres, onPaper, pagesOf } from './paper.mjs';

const given = process.env.VISITS;
const pictures = process.env.SCREENSHOTS;
let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

/** The page of a manifest; it is removed when it is closed. */
async function openVisits(manifest, options) {
  const file = await visitsPage(manifest);
  const opened = await openPage(browser, file, options);
  return { ...opened, close: () => opened.close().then(() => rm(dirname(file), { recursive: true })) };
}

/** The rows of the table as texts of the cells that are seen, R and L with the words of their measure. */
const rowsOf = (page) => page.locator('.table-box tbody').evaluateAll((bodies) => bodies.flatMap((body) =>
  [...body.rows].map((row, i) => {
    const cells = [...row.cells].filter((cell) => cell.checkVisibility()).map((cell) => cell.textContent.trim());
    return i === 0 ? cells : [body.rows[0].cells[0].textContent.trim(), ...cells];
  })));
const headsOf = (page) => page.locator('.table-box thead th:visible').allTextContents();

async function printed(page, name) {
  const pdf = await page.pdf({ preferCSSPageSize: true });
  if (pictures) await writeFile(join(pictures, `${name}.pdf`), pdf);
  return pdf;
}

const long = '2026-03-01, before the second injection of the left side and twelve weeks of exercises at home';

test('what all intervals come from is said once', { skip: Boolean(given) }, async () => {
  const visits = madeUpVisits(2);
  for (const { changes } of visits.measures) for (const change of changes) if (change) change.largest = 'repetition';
  const { page, close } = await openVisits(visits);
  assert.equal(await page.locator('th.part, td.part').count(), 0);
  assert.equal(await page.locator('.all-from').textContent(), 'All intervals of the changes come mostly from repetition.');
  await close();
});

test('heads of columns break between words alone', { skip: Boolean(given) }, async () => {
  for (const width of [360, 768, 1100]) {
    const { page, close } = await openVisits(madeUpVisits(2), { viewport: { width, height: 900 } });
    const broken = await page.locator('.table-box thead th').evaluateAll((heads) => heads.flatMap((cell) => {
      const walker = document.createTreeWalker(cell, NodeFilter.SHOW_TEXT);
      const found = [];
      while (walker.nextNode())
        for (const { 0: word, index } of walker.currentNode.data.matchAll(/\p{L}+/gu)) {
          const range = document.createRange();
          range.setStart(walker.currentNode, index);
          range.setEnd(walker.currentNode, index + word.length);
          if (range.getClientRects().length > 1) found.push(word);
        }
      return found;
    }));
    assert.deepEqual(broken, [], `${width} px`);
    await close();
  }
});

test('a change that is doubtful is no plain yes', { skip: Boolean(given) }, async () => {
  const visits = madeUpVisits(2);
  for (const { changes } of visits.measures) for (const change of changes) if (change) change.doubtful = true;
  const { page, close } = await openVisits(visits);
  assert.deepEqual((await rowsOf(page))[0].slice(-2), ['yes, doubtful', 'tracking jitter']);
  assert.equal(await page.locator('tr.beyond').count(), 0, 'none stands out');
  assert.match(await page.locator('#explained').textContent(), /Doubtful: something/);
  await close();
});

test('the verdict is in sight where the table is scrolled', { skip: Boolean(given) }, async () => {
  const { page, close } = await openVisits(madeUpVisits(5), { viewport: { width: 768, height: 900 } });
  const [box, cell] = await Promise.all(['.table-box', 'td.verdict >> nth=0'].map((place) => page.locator(place).boundingBox()));
  assert.ok(await page.locator('.table-box').evaluate((table) => table.scrollWidth > table.clientWidth), 'it is scrolled');
  assert.ok(cell.x > box.x + 200 && cell.x + cell.width <= box.x + box.width + 1, JSON.stringify([box, cell]));
  await close();
});

describe('two visits', { skip: Boolean(given) }, () => {
  let page, complaints, close;
  before(async () => ({ page, complaints, close } = await openVisits(madeUpVisits(2))));
  after(() => close?.());

  test('the answer is read first', async () => {
    assert.equal(await page.locator('h1').textContent(), 'P-017: smile');
    assert.equal(await page.locator('#facts').textContent(), '2 visits, 2026-03-01 to 2026-04-12');
    assert.deepEqual(await page.locator('#summary p').allTextContents(), madeUpVisits(2).summary);
    const [answer, faces, curves, table] = await Promise.all(['#summary', '#faces', '#curves', '#measures'].map((id) => page.locator(id).boundingBox()));
    assert.ok(answer.y + answer.height <= Math.min(faces.y, curves.y) && faces.y < table.y);
    assert.equal(await page.locator('#compared').count(), 0, 'there is nothing to choose');
    assert.equal(await page.title(), 'P-017, smile, 2026-03-01 to 2026-04-12');
  });

  test('the picture is said to be no picture of the person', async () => {
    assert.match(await page.locator('#faces h2').textContent(), /average face.*not this person’s face/);
  });

  test('the table has values, changes and verdicts in words, right before left', async () => {
    assert.deepEqual(await headsOf(page), [
      'Measure', '2026-03-01', '2026-04-12', 'Change, 2026-04-12 against 2026-03-01', 'By measurement alone',
      'Beyond what measurement and repetition make', 'Interval mostly from']);
    const rows = await rowsOf(page);
    assert.equal(rows.length, 24);
    const excursion = 'Corner of the mouth: excursion (mm)';
    assert.deepEqual(rows[0], [excursion, 'R', '4.8 (4.2 to 5.4)', '7.2 (6.6 to 7.8)', '+2.4 (1.6 to 3.2)', '2.1 to 2.7', 'yes', 'tracking jitter']);
    assert.deepEqual(rows[1], [excursion, 'L', '8.0 (7.4 to 8.6)', '8.0 (7.4 to 8.6)', '0.0 (−0.8 to 0.8)', '−0.3 to 0.3', 'no', 'repetition']);
    assert.deepEqual(rows.slice(0, 22).map((row) => row[1]), Array.from({ length: 22 }, (_, i) => (i % 2 ? 'L' : 'R')));
    assert.deepEqual(rows[5].slice(-2), ['cannot tell', 'repetition']);
    assert.deepEqual(rows[18], ['Brow: up (mm)', 'R', '0.2 (−0.4 to 0.8)', 'not measured', 'not measured', '', '', '']);
    assert.deepEqual(rows[23], ['Weaker corner, share of the stronger (%)', '43 (40 to 46)', '64 (61 to 67)', '+21 (17 to 26)', '20 to 23', 'yes', 'axes of the face']);
  });

  test('curves lie over each other, right before left, in the colours of the sides', async () => {
    assert.deepEqual(await page.locator('.panel figcaption').allTextContents(), ['R · the subject’s own right', 'L · the subject’s own left']);
    assert.deepEqual(await page.locator('.key li').allTextContents(), ['2026-03-01', '2026-04-12']);
    const strokes = await page.locator('.panel').evaluateAll((panels) => panels.map((panel) =>
      [...panel.querySelectorAll('path')].map((path) => ({ stroke: getComputedStyle(path).stroke, title: path.textContent, parts: path.getAttribute('d').split('M').length - 1 }))));
    assert.deepEqual(strokes.map((lines) => lines.map(({ title }) => title)),
      Array(2).fill(['2026-03-01: smile_1.csv', '2026-04-12: smile_2a.csv', '2026-04-12: smile_2b.csv']));
    const [[first, right], [, left]] = strokes;
    const probe = (name) => page.evaluate((variable) => {
      const made = document.createElement('i');
      made.style.color = `color-mix(in srgb, var(${variable}) 100%, var(--card))`;
      document.body.append(made);
      const { color } = getComputedStyle(made);
      made.remove();
      return color;
    }, name);
    assert.equal(right.stroke, await probe('--right'));
    assert.equal(left.stroke, await probe('--left'));
    assert.notEqual(first.stroke, right.stroke);
    assert.equal(right.parts, 2, 'interrupted where it was not measured');
    assert.equal(left.parts, 1);
    for (const text of ['time from half way (s)', 'distance from rest (mm)'])
      assert.equal(await page.locator('.panel text').filter({ hasText: text }).count(), 2);
    // A distance of 8 mm lies where the axis says 8.
    const [peak, eight] = await page.locator('.panel').nth(1).evaluate((panel) => {
      const top = panel.querySelector('path').getBoundingClientRect().top;
      const label = [...panel.querySelectorAll('text')].find(({ textContent }) => textContent === '8').getBoundingClientRect();
      return [top, label.top + label.height / 2];
    });
    assert.ok(Math.abs(peak - eight) < 3, `${peak} and ${eight}`);
  });

  test('faces, notes, what was recorded and the caveat', async () => {
    assert.deepEqual(await page.locator('.face img').evaluateAll((all) => all.map(({ alt, naturalWidth }) => [alt, naturalWidth])), [
      ['The face at the peak of the smile, 2026-03-01', 180], ['The face at the peak of the smile, 2026-04-12', 180]]);
    assert.deepEqual(await page.locator('#notes li').allTextContents(), madeUpVisits(2).notes);
    assert.deepEqual(await page.locator('#explained .choice').allTextContents(), madeUpVisits(2).choices);
    const words = await page.locator('#explained').textContent();
    assert.ok(words.includes(madeUpVisits(2).repetition.text) && words.includes('by the corners of the mouth'), words);
    assert.match(words, /2026-04-12 smile_2a\.csv, smile_2b\.csv; peak at 1\.33 s; .*tracking jitter not known/);
    assert.match(await page.locator('#foot').textContent(), /no medical device/);
    assert.deepEqual(complaints, []);
  });

  test('the button opens the printer’s dialogue', async () => {
    await page.evaluate(() => (window.print = () => (window.printedTimes = (window.printedTimes ?? 0) + 1)));
    await page.getByRole('button', { name: 'Print or save as PDF' }).click();
    assert.equal(await page.evaluate(() => window.printedTimes), 1);
  });
});

test('what a recording lacks is said in place of the picture, and no interval where it is not known', { skip: Boolean(given) }, async () => {
  const visits = madeUpVisits(2);
  Object.assign(visits.visits[1], { picture: '', no_picture: 'the corners of the mouth are not recorded', eye_distance_mm: null });
  const right = visits.measures.find(({ side }) => side === 'R'); // The table's first row.
  Object.assign(right.changes[1], { low: null, high: null, low_measured: null, high_measured: null, beyond: 'cannot tell' });
  const { page, complaints, close } = await openVisits(visits);
  assert.deepEqual(await page.locator('.no-picture').allTextContents(), ['No picture: the corners of the mouth are not recorded']);
  assert.match(await page.locator('#explained').textContent(), /2026-04-12 .*outer eye corners not recorded;/);
  assert.deepEqual((await rowsOf(page))[0].slice(4, 7), ['+2.4 (not known)', 'not known', 'cannot tell']);
  assert.deepEqual(complaints, []);
  await close();
});

test('values of faces of different scales are not compared', { skip: Boolean(given) }, async () => {
  const manifest = madeUpVisits(2);
  for (const measure of manifest.measures) measure.changes[1] = null;
  const { page, complaints, close } = await openVisits(manifest);
  const rows = await rowsOf(page);
  assert.deepEqual(rows[0].slice(2), ['4.8 (4.2 to 5.4)', '7.2 (6.6 to 7.8)', 'not compared', '', '', '']);
  assert.deepEqual(rows[18].slice(3), ['not measured', 'not measured', '', '', '']);
  assert.equal(await page.locator('tr.beyond').count(), 0);
  assert.deepEqual(complaints, []);
  await close();
});

for (const count of [2, 5])
  test(`the change and its verdict are in sight on a telephone: ${count} visits`, { skip: Boolean(given) }, async () => {
    const { page, complaints, close } = await openVisits(madeUpVisits(count), { viewport: { width: 390, height: 844 } });
    const box = await page.locator('.table-box').boundingBox();
    for (const place of ['thead .change', 'thead .verdict', 'td.change >> nth=0', 'td.verdict >> nth=0']) {
      const cell = await page.locator(`.table-box ${place}`).boundingBox();
      assert.ok(cell.x >= box.x && cell.x + cell.width <= box.x + box.width + 1, JSON.stringify([place, box, cell]));
    }
    assert.deepEqual((await rowsOf(page))[0].slice(1, 4), ['R', '+2.4 (1.6 to 3.2)', 'yes']);
    await page.setViewportSize({ width: 1440, height: 900 });
    await page.waitForFunction(() => document.querySelector('.table-box tbody tr td:nth-last-child(2)').classList.contains('verdict'));
    assert.deepEqual(complaints, []);
    await close();
  });

test('of more visits another can be compared', { skip: Boolean(given) }, async () => {
  const { page, complaints, close } = await openVisits(madeUpVisits(5));
  assert.equal((await headsOf(page)).filter((head) => /^2026-\d\d-\d\d$/.test(head)).length, 5);
  const row = async () => (await rowsOf(page))[0];
  assert.deepEqual((await row()).slice(-3), ['+2.4 (1.6 to 3.2)', 'yes', 'tracking jitter']);
  await page.getByLabel('Compared with 2026-03-01').selectOption({ label: '2026-04-12' });
  assert.deepEqual((await row()).slice(-3), ['+0.6 (−0.2 to 1.4)', 'no', 'tracking jitter']);
  assert.ok((await headsOf(page)).includes('Change, 2026-04-12 against 2026-03-01'));
  assert.deepEqual((await rowsOf(page))[18].slice(-3), ['not measured', '', '']);
  assert.deepEqual(await page.locator('.face.chosen b').allTextContents(), ['2026-04-12']);
  await onPaper(page, true);
  assert.deepEqual((await headsOf(page)).slice(0, 4), ['Measure', '2026-03-01', '2026-04-12', 'Change, 2026-04-12 against 2026-03-01']);
  assert.deepEqual(await page.locator('.face:visible b').allTextContents(), ['2026-03-01', '2026-04-12', '2026-08-02', '2026-11-20']);
  await onPaper(page, false);
  assert.equal((await headsOf(page)).length, 9);
  assert.deepEqual(complaints, []);
  await close();
});

test('all faces are reached on a telephone, each beside the first', { skip: Boolean(given) }, async () => {
  const { page, close } = await openVisits(madeUpVisits(5), { viewport: { width: 360, height: 800 } });
  const seen = () => page.locator('.face-row').evaluate((row) => {
    const { left, right } = row.getBoundingClientRect();
    return [...row.children].filter((face) => {
      const box = face.getBoundingClientRect();
      const over = document.elementFromPoint((box.left + box.right) / 2, box.top + 20);
      return box.left >= left - 1 && box.right <= right + 1 && face.contains(over);
    }).map((face) => face.querySelector('b').textContent);
  });
  await page.locator('.face-row').scrollIntoViewIfNeeded();
  assert.deepEqual(await seen(), ['2026-03-01', '2026-11-20']);
  await page.locator('#compared').selectOption({ index: 1 });
  await page.locator('.face-row').scrollIntoViewIfNeeded();
  assert.deepEqual(await seen(), ['2026-03-01', '2026-05-30']);
  assert.equal(await page.locator('.face-row').getAttribute('tabindex'), '0', 'by the keyboard too');
  await close();
});

test('texts are shown as they are', { skip: Boolean(given) }, async () => {
  const manifest = madeUpVisits(2);
  const evil = '<b>x</b>';
  Object.assign(manifest, { patient: evil, summary: [evil], notes: [`${evil}</script><script>window.ran = 1</script>`], caveat: evil });
  Object.assign(manifest.visits[0], { label: evil, note: evil, recordings: [evil] });
  for (const measure of manifest.measures) measure.words = evil;
  const { page, complaints, close } = await openVisits(manifest);
  assert.equal(await page.locator('h1').textContent(), `${evil}: smile`);
  for (const place of ['#facts', '#summary', '#notes', '.face', '.key', '.table-box', '#explained', '#foot'])
    assert.ok((await page.locator(place).first().textContent()).includes(evil), place);
  assert.equal(await page.locator('b').filter({ hasText: /^x$/ }).count(), 0);
  assert.equal(await page.evaluate(() => window.ran), undefined);
  assert.deepEqual(complaints, []);
  await close();
});

const made = given
  ? [['given', () => ({ file: resolve(given) })]]
  : [1, 2, 4, 5].map((count) => [`${count} visits`, () => madeUpVisits(count)]).concat([['long labels', () => {
    const manifest = madeUpVisits(4);
    for (const visit of manifest.visits) visit.label = visit.label.replace(/.*/, (date) => (date === '2026-03-01' ? long : date));
    return manifest;
  }]]);

/** A made-up page, or the one that was given. */
const openMade = (data, options) => (data.file ? openPage(browser, data.file, options) : openVisits(data, options));

for (const [name, data] of made) {
  const file = name.replaceAll(' ', '_');

  for (const width of [360, 768, 1440])
    for (const colorScheme of width === 1440 ? ['light', 'dark'] : ['light'])
      test(`fits a window of ${width} px, ${colorScheme}: ${name}`, async () => {
        const { page, complaints, close } = await openMade(data(), { viewport: { width, height: 900 }, colorScheme });
        const wide = await tooWide(page);
        assert.ok(wide <= 0, `${wide} px too wide`);
        const paper = await page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor);
        assert.equal(paper, colorScheme === 'dark' ? 'rgb(18, 20, 23)' : 'rgb(245, 245, 243)');
        if (pictures) await page.screenshot({ path: join(pictures, `${file}_${width}_${colorScheme}.png`), fullPage: true });
        assert.deepEqual(complaints, []);
        await close();
      });

  test(`prints as one page A4 in light colours: ${name}`, async (t) => {
    const { page, close } = await openMade(data(), { colorScheme: 'dark' });
    const pdf = await printed(page, file);
    assert.equal(pagesOf(pdf), 1);
    assert.match(pdf.toString('latin1'), /\/MediaBox\s*\[0 0 59[45][.\d]* 84[12][.\d]*\]/, 'A4');
    assert.equal(await page.locator('html').getAttribute('class'), '', 'the screen is as before');
    await onPaper(page, true);
    t.diagnostic(`size ${await page.evaluate(() => document.documentElement.style.getPropertyValue('--fit'))}`);
    const cut = await page.evaluate(() => {
      const { right } = document.body.getBoundingClientRect();
      return [...document.querySelectorAll('body *')].filter((part) => part.checkVisibility() && part.getBoundingClientRect().right > right + 1)
        .map((part) => `${part.tagName} ${part.className} ${part.textContent.slice(0, 20)}`);
    });
    assert.deepEqual(cut, []);
    const heights = await page.locator('.face img:visible').evaluateAll((all) => all.map((image) => image.getBoundingClientRect().height));
    for (const height of heights.map(millimetres)) assert.ok(height <= 60 && height > 25, `${height} mm`);
    assert.equal(await page.locator('body').evaluate((body) => getComputedStyle(body).color), 'rgb(17, 17, 17)');
    assert.equal(await page.locator('button:visible, select:visible').count(), 0);
    await close();
  });
}

test('what does not fit one page takes a second, in letters that can be read', { skip: Boolean(given) }, async () => {
  const manifest = madeUpVisits(2);
  manifest.measures = Array.from({ length: 4 }, (_, i) => manifest.measures.map((one) => ({ ...one, key: `${one.key}_${i}` }))).flat();
  const { page, close } = await openVisits(manifest);
  assert.ok(pagesOf(await printed(page, 'two_pages')) >= 2);
  await onPaper(page, true);
  assert.equal(await page.evaluate(() => document.documentElement.style.getPropertyValue('--fit')), '1');
  await close();
});
