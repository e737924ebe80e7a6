// SPDX-License-Identifier: GPL-3.0-or-later
// The subject's own sides: marked in every view and picture, in one order in words and tables, and worded so that a
// weak side which is dragged does not make the healthy one look weak.
//   SCREENSHOTS=/tmp/pictures node --test web/tests/sides.test.mjs
import assert from 'node:assert/strict';
import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { fixture } from './fixtures.mjs';
import { openMadeUp } from './made_up_studio.mjs';
import { readPage, withData } from './page_data.mjs';
import { decode } from './pixels.mjs';

const pictures = process.env.SCREENSHOTS;
let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

/** "R left, L right": where each mark stands in the view, or in its half of it. */
const marks = async (page) => {
  await page.waitForSelector('#face[data-at-rest="true"]');
  return page.locator('.side-marks span').evaluateAll((all) => all.map((mark) => {
    const [at, host] = [mark.getBoundingClientRect(), document.getElementById('canvas-host').getBoundingClientRect()];
    const share = (at.left + at.width / 2 - host.left) / host.width;
    return `${mark.textContent} ${share.toFixed(2)}`;
  }));
};

for (const [name, open] of [
  ['report', () => openPage(browser, fixture('variants.html'))],
  ['studio', () => openMadeUp(browser, () => [])],
])
  test(`every view of the ${name} says where left and right are`, async () => {
    const { page, close } = await open();
    const near = (text, letter, share) => assert.ok(text.startsWith(letter) && Math.abs(Number(text.slice(2)) - share) < 0.05, `${text}, not ${letter} at ${share}`);
    const at = async (...wanted) => {
      const found = await marks(page);
      assert.equal(found.length, wanted.length, found.join(', '));
      wanted.forEach(([letter, share], i) => near(found[i], letter, share));
    };
    const view = (which) => page.locator(`#views [data-view="${which}"]`).click();
    assert.deepEqual(await page.locator('#views button').evaluateAll((all) => all.map((b) => b.dataset.view)), ['front', 'three-quarter', 'right', 'left']);
    await at(['R', 0.02], ['L', 0.98]);
    await view('three-quarter');
    await at(['R', 0.02], ['L', 0.98]);
    await view('left');
    await at(['L', 0.5]);
    await view('right');
    await at(['R', 0.5]);
    // On to behind the head.
    await page.locator('#face').focus();
    for (let i = 0; i < 9; ++i) await page.keyboard.press('Shift+ArrowLeft');
    await at(['R', 0.98], ['L', 0.02]);
    await view('front');
    if (name === 'report') {
      await page.keyboard.press('s');
      await at(['R', 0.02], ['L', 0.48], ['R', 0.52], ['L', 0.98]);
    }
    if (pictures) await page.screenshot({ path: join(pictures, `sides_${name}.png`) });
    await close();
  });

test('a saved picture has the marks', async () => {
  const { page, close } = await openPage(browser, fixture('plain.html'));
  await page.waitForSelector('#face[data-at-rest="true"]');
  const [width, height] = await page.locator('#canvas-host').evaluate((e) => [e.clientWidth, e.clientHeight]);
  const [saved] = await Promise.all([page.waitForEvent('download'), page.keyboard.press('e')]);
  const png = await readFile(await saved.path());
  if (pictures) await saved.saveAs(join(pictures, 'sides_saved.png'));
  const picture = await decode(page, png);
  // Twice the stage's pixels, below a title of 58.
  const ink = (x) => picture.evaluate(({ width: w, data }, [cx, cy]) => {
    let dark = 0;
    for (let y = cy - 16; y < cy + 16; ++y)
      for (let px = cx - 16; px < cx + 16; ++px) dark += data[4 * (y * w + px)] < 90;
    return dark;
  }, [2 * x, 2 * (58 + Math.round(height / 2))]);
  assert.ok(await ink(16) > 40, 'R');
  assert.ok(await ink(width - 16) > 40, 'L');
  await close();
});

/** The made-up variants, the first of which opens its mouth with a weak right side. */
async function dragged(change) {
  const { html, data } = await readPage(fixture('variants.html'));
  const [base, own] = data.summary.variants.table;
  const sides = (right, left) => ({ R: right, L: left });
  const pair = (right, left) => [{
    point: 'cheilion', excursion_mm: sides(right, left), path_mm: sides(1, 1), peak_speed_mm_s: sides(1, 1), speed_correlation: 1, undecided: Math.abs(right - left) < 0.1, floor_mm: 0.1,
  }];
  data.summary.symmetry = { ...data.summary.symmetry, excursions: pair(6.74, 6.71) };
  Object.assign(base, { commissure_R_mm: 6.74, commissure_L_mm: 6.71 });
  const { right, left = 6.76, along = right, weaker = ['R'], more = {}, budget } = change;
  if (budget) data.summary.error_budget = { corners_of_the_mouth: budget(own.name) };
  Object.assign(own, {
    excursions: pair(right, left), commissure_R_mm: right, commissure_L_mm: left, commissure_R_band_mm: 0.7, commissure_L_band_mm: 0.2,
    commissure_R_along_base_mm: along, commissure_L_along_base_mm: left, weaker_sides: weaker, ...more,
  });
  for (const key of ['R', 'L']) own[`commissure_${key}_from_base_mm`] = null;
  const file = join(await mkdtemp(join(tmpdir(), 'hyperex-page-')), 'dragged.html');
  await writeFile(file, withData(html, data));
  const { page, close } = await openPage(browser, file);
  await page.locator('#chips button').nth(1).click();
  const [headline, line] = [await page.locator('#headline').textContent(), await page.locator('.variant-lines li').first().textContent()];
  const questions = await page.locator('.answers dt').allTextContents();
  const [changed, apart] = await page.locator('.answers dd').allTextContents();
  const below = await page.locator('.corners .floor').textContent();
  const all = await page.locator('body').textContent();
  await close();
  await rm(dirname(file), { recursive: true });
  return { headline, questions, change: changed, apart, below, all, line: line.split(': ').slice(1).join(': ') };
}

test('a weak corner that goes farther is dragged; the healthy one is not called less', async () => {
  const { headline, change, line } = await dragged({ right: 8.91 });
  assert.equal(headline, 'right 8.9 mm, left 6.8 mm');
  assert.equal(change, 'right is dragged 2.2 mm farther than in base (± 0.7 mm)');
  assert.equal(line, 'right corner 8.9 mm, is dragged 2.2 mm farther than in base (± 0.7 mm)');
});

test('a change has no band and is not decided where the jitter is not known', async () => {
  const more = { jitter_known: false, commissure_R_band_mm: null, commissure_L_band_mm: null, commissure_R_decided: null, commissure_L_decided: 0 };
  const { change, line } = await dragged({ right: 8.91, more });
  assert.equal(change, 'right is dragged 2.2 mm farther than in base: cannot tell, as the jitter of the recording is not known');
  assert.equal(line, 'right corner 8.9 mm, is dragged 2.2 mm farther than in base (cannot tell, as the jitter of the recording is not known)');
  assert.match((await dragged({ right: 7.1, more: { ...more, commissure_R_decided: 0 } })).change, /: undecided$/);
  // The table below says the same of the jitter.
  const { all } = await dragged({ right: 8.91, more });
  assert.match(all, /A changed face scales it: .+ Here the jitter is not known, and the program cannot tell whether it makes such a change\./);
  assert.doesNotMatch(all, /jitter does not count/);
});

test('a weak corner moves less, one in stiff tissue follows less', async () => {
  assert.equal((await dragged({ right: 4.1 })).change, 'right moves 2.6 mm less than in base (± 0.7 mm)');
  assert.equal((await dragged({ right: 4.1, weaker: [] })).change, 'right follows 2.6 mm less than in base (± 0.7 mm)');
});

test('the change is that of the distance, with its own band; what it hides is a second figure with a name', async () => {
  const { change, line, below } = await dragged({ right: 4.1, along: 1.5 });
  assert.equal(change, 'right moves 2.6 mm less than in base (± 0.7 mm); in the unchanged direction 5.2 mm less');
  assert.equal(line, 'right corner 4.1 mm, moves 2.6 mm less than in base (± 0.7 mm); in the unchanged direction 5.2 mm less');
  assert.match(below, /The unchanged direction is where the corner goes in base; .+, not in it\./);
  assert.equal((await dragged({ right: 7.0, along: 3.5 })).change,
    'right is dragged 0.3 mm farther than in base: undecided (below 0.7 mm); in the unchanged direction 3.2 mm less');
  assert.equal((await dragged({ right: 5.9, along: -4.2 })).change, 'right moves 0.8 mm less than in base (± 0.7 mm); 4.2 mm against the unchanged direction');
  assert.equal((await dragged({ right: 6.75, along: 2.7 })).change, 'right goes as far as in base; in the unchanged direction 4.0 mm less');
  assert.doesNotMatch((await dragged({ right: 4.1 })).below, /direction/);
});

test('the figure in the unchanged direction has a band of its own', async () => {
  const more = { commissure_R_along_base_band_mm: 0.84, commissure_R_along_base_decided: 1 };
  assert.equal((await dragged({ right: 4.1, along: 1.5, more })).change,
    'right moves 2.6 mm less than in base (± 0.7 mm); in the unchanged direction 5.2 ± 0.8 mm less');
  assert.equal((await dragged({ right: 5.9, along: -4.2, more })).change,
    'right moves 0.8 mm less than in base (± 0.7 mm); 4.2 mm against the unchanged direction, 10.9 ± 0.8 mm less');
  assert.match((await dragged({ right: 4.1, along: 6.2, more })).change, /; in the unchanged direction undecided: 0\.5 ± 0\.8 mm less$/);
  const unknown = { jitter_known: false, commissure_R_band_mm: null, commissure_L_band_mm: null, commissure_R_along_base_band_mm: null };
  assert.match((await dragged({ right: 4.1, along: 1.5, more: unknown })).change, /; in the unchanged direction 5\.2 mm less, cannot tell$/);
});

/** The right corner's change and the difference of base's sides in an error budget. */
const budgetWith = (half, known, decided) => (variant) => {
  const more = { half_width_95_mm: half, known_half_width_95_mm: known, decided, largest_part: 'mesh' };
  return [{ figure: 'difference', value_mm: -0.03, ...more }, { variant, figure: 'change', side: 'R', value_mm: -2.64, ...more }];
};

test('the interval of the error budget stands in place of the band, which leaves most errors out', async () => {
  const { change, line } = await dragged({ right: 4.1, budget: budgetWith(1.94, 1.94, true) });
  assert.equal(change, 'right moves 2.6 mm less than in base (95 %: ± 1.9 mm)');
  assert.equal(line, 'right corner 4.1 mm, moves 2.6 mm less than in base (95 %: ± 1.9 mm)');
  assert.equal((await dragged({ right: 4.1, budget: budgetWith(2.94, 2.94, false) })).change, 'right moves 2.6 mm less than in base: undecided (below 2.9 mm)');
  assert.equal((await dragged({ right: 4.1, budget: budgetWith(null, 1.2, null) })).change,
    'right moves 2.6 mm less than in base (at least ± 1.2 mm): cannot tell, as the jitter of the recording is not known');
  // The budget has no interval for the second figure.
  const more = { commissure_R_along_base_band_mm: 0.84, commissure_R_along_base_decided: 1 };
  assert.equal((await dragged({ right: 4.1, along: 1.5, more, budget: budgetWith(1.94, 1.94, true) })).change,
    'right moves 2.6 mm less than in base (95 %: ± 1.9 mm); in the unchanged direction 5.2 mm less');
});

test('the interval of the error budget stands in place of the floor of base', async () => {
  const { html, data } = await readPage(fixture('variants.html'));
  data.summary.symmetry = { ...data.summary.symmetry, excursions: [{
    point: 'cheilion', excursion_mm: { R: 6, L: 7.04 }, path_mm: { R: 1, L: 1 }, peak_speed_mm_s: { R: 1, L: 1 }, speed_correlation: 1, undecided: false, floor_mm: 0.1,
  }] };
  data.summary.error_budget = { corners_of_the_mouth: budgetWith(1.84, 1.84, false)('') };
  const file = join(await mkdtemp(join(tmpdir(), 'hyperex-page-')), 'budget.html');
  await writeFile(file, withData(html, data));
  const { page, close } = await openPage(browser, file);
  assert.match(await page.locator('#headline').textContent(), /a difference of 1\.0 mm: undecided \(below 1\.8 mm\)$/);
  assert.match(await page.locator('.corners .floor').textContent(), /cannot be told from what all errors of the error budget together make \(95 %\), 1\.8 mm\./);
  await close();
  await rm(dirname(file), { recursive: true });
});

test('what still moves a side of which no muscle pulls', async () => {
  const more = { unpulled_sides: ['R'], commissure_R_with_jaw_mm: 5.04 };
  const { line } = await dragged({ right: 4.1, more });
  assert.match(line, / No muscle pulls on the right: its corner moves by no strength of its own, but by the jaw and the other side\. Fixed to the lower jaw it would go 5\.0 mm\. Skin follows the jaw in part\.$/);
  const turned = await dragged({ right: 4.1, more: { ...more, commissure_R_with_turned_jaw_mm: 3.16 } });
  assert.doesNotMatch(turned.line, /3\.2 mm/, 'one figure in a breath');
});

test('a change within its band is undecided', async () => {
  assert.match((await dragged({ right: 7.2 })).change, /undecided \(below 0\.7 mm\)$/);
});

test('what a variant changes and whether its sides differ are two answers, each with its name', async () => {
  const { questions, change, apart, below } = await dragged({ right: 4.1 });
  assert.deepEqual(questions, ['Change against base', 'Difference of the sides']);
  assert.match(change, /than in base/);
  assert.equal(apart, 'a difference of 2.7 mm');
  assert.match(below, /^These are the largest distances of both corners from rest in .+\. /, 'a sentence says what the figures are');
});

test('a figure and the limit that it is below do not print alike', async () => {
  // 0.66 mm farther with a band of 0.7 mm.
  assert.match((await dragged({ right: 7.4 })).change, /0\.66 mm farther than in base: undecided \(below 0\.70 mm\)$/);
  assert.equal((await dragged({ right: 8.91, left: 8.83 })).apart, 'a difference of 0.08 mm: undecided (below 0.10 mm)');
});
