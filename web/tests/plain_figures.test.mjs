// SPDX-License-Identifier: GPL-3.0-or-later
// What a reader takes away from a report: figures with what they do not include, in words that cannot be read as
// something else, on the page and in the picture that is saved of it.
//   SCREENSHOTS=/tmp/pictures node --test web/tests/plain_figures.test.mjs
import assert from 'node:assert/strict';
import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { launch, openPage, tooWide } from './browser.mjs';
import { fixture } from './fixtures.mjs';
import { rarePage } from './made_up_page.mjs';
import { imported } from './modules.mjs';
import { readPage, withData } from './page_data.mjs';

const pictures = process.env.SCREENSHOTS;
let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

/** The page of variants with other data, which `change` makes. */
async function changedPage(change, options = {}) {
  const { html, data } = await readPage(fixture('variants.html'));
  change(data);
  const file = join(await mkdtemp(join(tmpdir(), 'hyperex-page-')), 'changed.html');
  await writeFile(file, withData(html, data));
  const { page, complaints, close } = await openPage(browser, file, options);
  return { page, data, complaints, close: () => close().then(() => rm(dirname(file), { recursive: true })) };
}

const pair = (right, left, floorMm = 0.1) => [{
  point: 'cheilion', excursion_mm: { R: right, L: left }, path_mm: { R: 1, L: 1 }, peak_speed_mm_s: { R: 1, L: 1 }, speed_correlation: 1,
  undecided: Math.abs(right - left) < floorMm, floor_mm: floorMm,
}];
const uncertainHead = ({ summary }, shiftMm = 2.6) =>
  Object.assign(summary, { head_shift_uncertainty_mm: shiftMm, head_turn_uncertainty_deg: 1.8 });

/** Texts and their places in the pixels of the page, as they are written into the next picture that is saved. */
async function savedWords(page) {
  await page.evaluate(() => {
    window.written = [];
    const write = CanvasRenderingContext2D.prototype.fillText;
    CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
      window.written.push({ text, x, y });
      return write.call(this, text, x, y);
    };
  });
  const [saved] = await Promise.all([page.waitForEvent('download'), page.locator('#save-picture').click()]);
  if (pictures) await saved.saveAs(join(pictures, 'plain_saved.png'));
  await readFile(await saved.path());
  return page.evaluate(() => window.written);
}

test('the uncertainty of the head’s pose stands below the headline, where it exceeds the floor', async () => {
  const { page, close } = await changedPage((data) => {
    uncertainHead(data);
    data.summary.symmetry = { excursions: pair(6.7, 6.2) };
  });
  const head = page.locator('.corners .head-pose');
  assert.match(await head.textContent(), /pose is uncertain by up to 2\.6 mm and 1\.8° \(95 %\)/);
  assert.equal(await head.isVisible(), true);
  await close();
  const small = await changedPage((data) => {
    uncertainHead(data, 0.3);
    data.summary.symmetry = { excursions: pair(6.7, 6.2, 0.4) };
  });
  assert.equal(await small.page.locator('.corners .head-pose').isVisible(), false);
  await small.close();
});

test('a corner that is not recorded has no figure, and nothing compares the two', async () => {
  const { page, complaints, close } = await changedPage((data) => {
    const [both] = pair(6.2, 6.2);
    data.summary.symmetry = { excursions: [{ ...both, excursion_mm: { R: null, L: 6.2 }, undecided: null, recorded: { R: false, L: true } }] };
  });
  assert.match(await page.locator('#headline').textContent(), /right not recorded, left 6\.2 mm: a difference of the sides is not known/);
  assert.match(await page.locator('.corners .floor').textContent(), /The recording shows one corner alone/);
  assert.doesNotMatch(await page.locator('.corners').textContent(), /NaN/);
  assert.deepEqual(complaints, []);
  await close();
});

test('a saved picture shows figures below the faces, with their limits, and no number leaves its unit', async () => {
  const { page, close } = await changedPage((data) => {
    uncertainHead(data);
    data.summary.symmetry = { excursions: pair(6.7, 6.2) };
  }, { viewport: { width: 1180, height: 700 } });
  await page.keyboard.press('2');
  await page.keyboard.press('s');
  await page.locator('#colouring [data-colouring=asymmetry]').click();
  await page.waitForSelector('#face[data-faces="0 1"][data-at-rest="true"]');
  const stageHeight = await page.locator('#canvas-host').evaluate((host) => host.clientHeight);
  const written = await savedWords(page);
  const figures = written.filter(({ text }) => /mm\b/.test(text) && !/^Asymmetry/.test(text));
  assert.ok(figures.length > 3, written.map(({ text }) => text).join('\n'));
  for (const { text, y } of figures) assert.ok(y > 58 + stageHeight, `${text} lies over the stage, at ${y}`);
  for (const { text } of written) {
    assert.doesNotMatch(text, /^(mm|%|s)\b/, 'a unit begins a line');
    assert.doesNotMatch(text, /±$/, 'a sign ends a line');
  }
  const all = written.map(({ text }) => text).join(' ');
  assert.match(all, /Head’s pose uncertain by up to 2\.6 mm and 1\.8° \(95 %\); “undecided” includes this\./);
  assert.match(all, /The map cannot show which side is weak\./);
  await close();
});

test('the map of asymmetry says what it cannot show, and no other map does', async () => {
  const { page, close } = await openPage(browser, fixture('variants.html'));
  const caution = page.locator('#colour-caution');
  assert.equal(await caution.isVisible(), false);
  await page.locator('#colouring [data-colouring=asymmetry]').click();
  assert.equal(await caution.textContent(), 'The map cannot show which side is weak.');
  assert.equal(await caution.isVisible(), true);
  await page.locator('#colouring [data-colouring=displacement]').click();
  assert.equal(await caution.isVisible(), false);
  await close();
});

test('beside the expected error stands how much of the motion the recording shows', async () => {
  const caution = async (uncertainty) => {
    const { page, complaints, close } = await changedPage(({ summary }) => Object.assign(summary, { uncertainty }));
    await page.locator('#colouring [data-colouring=uncertainty]').click();
    const text = await page.locator('#colour-caution').textContent();
    assert.deepEqual(complaints, []);
    await close();
    return text;
  };
  assert.equal(await caution({
    cheeks: { distance_rms_mm: 3.9, determined: 0.437 }, lips: { distance_rms_mm: 2, determined: 0.92 }, chin: { determined: 0.5 },
  }), 'Of the motion the recording shows: lips 92 %, cheeks 44 %. Without errors of mesh and tissue.');
  assert.equal(await caution(undefined), 'Without errors of mesh and tissue.');
});

test('beside S(t) stand the millimetres, and where both order two faces differently', async () => {
  const caption = (page) => page.locator('.plot-card').filter({ has: page.getByRole('heading', { name: 'Symmetry of motion, S(t)' }) }).locator('p').first();
  const made = (left) => changedPage((data) => {
    const { summary, symmetry, variants } = data;
    summary.symmetry = { excursions: pair(6, 8) };
    summary.variants.table[1].excursions = pair(6, left);
    variants[0].symmetry.s = symmetry.s.map((s) => (s === null ? null : s + 0.5));
  });
  const { page, data, close } = await made(7);
  const { name } = data.variants[0];
  assert.match(await caption(page).textContent(), new RegExp(`^Corners of the mouth – base: a difference of 2\\.0 mm, a ratio right/left of 0\\.75\\. The largest S of “base” is lower than that of “${name}”`));
  await page.keyboard.press('2');
  assert.match(await caption(page).textContent(), /but its corners of the mouth differ more \(by 2\.0 mm, not 1\.0 mm\).+read the millimetres/);
  await close();
  const agreed = await made(9);
  await agreed.page.keyboard.press('2');
  assert.match(await caption(agreed.page).textContent(), /a difference of 3\.0 mm, a ratio right\/left of 0\.67\. S = ln/);
  await agreed.close();
});

test('faces whose S stays below its floor are not ordered by it', async () => {
  const caption = (page) => page.locator('.plot-card').filter({ has: page.getByRole('heading', { name: 'Symmetry of motion, S(t)' }) }).locator('p').first();
  const made = (noise) => changedPage(({ summary, symmetry, variants }) => {
    summary.symmetry = { excursions: pair(6, 8) };
    summary.variants.table[1].excursions = pair(6, 7);
    variants[0].symmetry.s = symmetry.s.map((s) => (s === null ? null : s + 0.5));
    for (const curve of [symmetry, variants[0].symmetry]) curve.noise = symmetry.s.map(() => noise);
  });
  const under = await made(Math.exp(9));
  await under.page.keyboard.press('2');
  assert.doesNotMatch(await caption(under.page).textContent(), /is lower than that of/);
  await under.close();
  const above = await made(1e-9);
  await above.page.keyboard.press('2');
  assert.match(await caption(above.page).textContent(), /is lower than that of/);
  await above.close();
});

test('S(t) says what it compares and that it is no figure in mm', async () => {
  const { page, close } = await openPage(browser, fixture('variants.html'));
  const card = page.locator('.plot-card').filter({ has: page.getByRole('heading', { name: 'Symmetry of motion, S(t)' }) });
  const caption = await card.locator('p').first().textContent();
  assert.match(caption, /S compares how much the distances .+ does not say which face moves more evenly in mm and grades no palsy/);
  assert.doesNotMatch(caption, /more symmetric/);
  await close();
});

test('the curve of the corners says that it is not filtered, where the figures above it are', async () => {
  const { page, close } = await changedPage((data) => {
    data.symmetry.jitter_mm = 0.2;
    data.summary.symmetry = { excursions: pair(6.7, 6.2), lowpass_hz: 6 };
  });
  assert.match((await page.locator('.corners .u-series button').allTextContents()).join(', '), /right corner, unfiltered, .*left corner, unfiltered/);
  assert.match(await page.locator('.corners').textContent(), /figures above are of paths without what is faster than 6 Hz; the curve is unfiltered\. Its highest point may lie above them, by jitter, or below, as the filter/);
  await close();
});

test('curves and columns are called after their face first, and then after the side', async () => {
  const { page, close } = await openPage(browser, fixture('variants.html'));
  await page.keyboard.press('2');
  await page.keyboard.press('s');
  const name = await page.locator('#chips button').nth(1).textContent();
  const legend = await page.locator('.corners .u-series button').allTextContents();
  assert.deepEqual(legend, ['base: right corner', 'base: left corner', `${name}: right corner`, `${name}: left corner`]);
  const [saved] = await Promise.all([page.waitForEvent('download'), page.locator('.corners').getByRole('button', { name: /^CSV/ }).click()]);
  const [head] = (await readFile(await saved.path(), 'utf8')).split('\r\n');
  assert.equal(head, `time (s),base: right corner (mm),base: left corner (mm),${name}: right corner (mm),${name}: left corner (mm)`);
  await close();
});

test('the plot of one corner opens on the side that the variant shown changes most', async () => {
  const { data, floats } = await readPage(fixture('variants.html'));
  const { names, time_s } = data.landmarks;
  const corner = (side) => names.findIndex((name) => name === `cheilion_${side}` || name === { L: 'ibug68_54', R: 'ibug68_48' }[side]);
  const most = (stretch, side) => {
    const [own, base] = [floats(stretch), floats(data.landmarks.positions)];
    const travel = (p, f) => Math.hypot(...[0, 1, 2].map((k) => p[3 * (f * names.length + corner(side)) + k] - p[3 * corner(side) + k]));
    return Math.max(...time_s.map((_, f) => Math.abs(travel(own, f) - travel(base, f))));
  };
  const { page, close } = await openPage(browser, fixture('variants.html'));
  const chooser = page.locator('.one-of-chooser').filter({ hasText: 'Corner' }).locator('select');
  for (const [i, { landmarks }] of data.variants.entries()) {
    await page.locator('#chips button').nth(i + 1).click();
    assert.equal(await chooser.inputValue(), most(landmarks, 'L') > most(landmarks, 'R') ? 'left' : 'right');
  }
  // What the reader chooses stays.
  const other = (await chooser.inputValue()) === 'left' ? 'right' : 'left';
  await chooser.selectOption(other);
  await page.locator('#chips button').nth(1).click();
  assert.equal(await chooser.inputValue(), other);
  await close();
});

test('tables that are wider than the window say so and scroll in a box of their own', async () => {
  const file = await rarePage();
  const { page, close } = await openPage(browser, file, { viewport: { width: 820, height: 1180 } });
  assert.ok(await tooWide(page) <= 0);
  for (const card of ['.variants', '.excursions']) {
    const scroller = page.locator(`${card} .scroller`);
    const wide = await scroller.evaluate((s) => s.scrollWidth - s.clientWidth);
    assert.equal(await page.locator(`${card} .more-columns`).isVisible(), wide > 1, `${card}: ${wide} px more`);
    if (card === '.variants') assert.ok(wide > 100);
    const [box, outer] = [await scroller.boundingBox(), await page.locator(card).boundingBox()];
    if (wide > 1) assert.ok(box.x > outer.x + 5 && box.x + box.width < outer.x + outer.width - 5, 'its box ends before the card does');
    if (pictures) await page.locator(card).screenshot({ path: join(pictures, `tables_820_${card.slice(1)}.png`) });
  }
  await close();
  const roomy = await openPage(browser, file);
  assert.equal(await roomy.page.locator('.variants .more-columns').isVisible(), false);
  await roomy.close();
  await rm(dirname(file), { recursive: true });
});

test('the wheel zooms about the pointer, and the list of keys states what the pointer does', async () => {
  const { page, close } = await openPage(browser, fixture('plain.html'));
  const box = await page.locator('#face').boundingBox();
  const [x, y] = [box.x + 0.6 * box.width, box.y + 0.6 * box.height];
  await page.mouse.click(x, y);
  const dot = page.locator('.place');
  await dot.waitFor();
  const place = async () => {
    const at = await dot.boundingBox();
    return [at.x + at.width / 2, at.y + at.height / 2];
  };
  const before = await place();
  await page.mouse.wheel(0, -600);
  await page.waitForFunction(() => document.getElementById('face').dataset.atRest === 'true');
  await page.waitForTimeout(300);
  const [dx, dy] = (await place()).map((v, i) => v - before[i]);
  assert.ok(Math.hypot(dx, dy) < 4, `the place under the pointer moved by ${dx}, ${dy} px`);
  await page.locator('#open-help').click();
  const keys = await page.locator('#help dt').allTextContents();
  for (const key of ['Drag', 'Right-drag', 'Wheel']) assert.ok(keys.includes(key), keys.join());
  await close();
});

test('surgery: a table of what it does to the face at rest, with published ratios, and its change in words', async () => {
  const { page, complaints, close } = await changedPage((data) => {
    const move = (landmark, at_rest_mm, more = {}) => ({ landmark, at_rest_mm, expression_before_mm: [0, -9, -2], expression_after_mm: [0.01, -9.5, -2], ...more });
    Object.assign(data.summary.variants.table[1], {
      surgery: { landmarks: [
        move('pogonion', [0.02, -0.42, 5.61], { soft_per_bone: 0.935, published: { usual: 1, low: 0.8, high: 1.33, source: 'twenty papers' } }), move('stomion', [0, 0, 0.01]),
      ] },
      changes: { 'surgery.bone': [{ part: 'mandible', cut: 'standard', move_mm: [0, 0, 6], turn_deg: [-2, 0, 0], cut_shift_mm: 0 }] },
    });
    data.variants[0].upper_teeth = [0, 0, 0, 1, 0, 0, 0.004];
  });
  const card = page.locator('.figures.surgery');
  const row = card.locator('tbody tr', { hasText: /pogonion/i });
  const cells = await row.locator('td').allInnerTexts();
  assert.deepEqual(cells.map((text) => text.split(/\s*\n\s*/)), [
    ['5.6', '5.6 forward, 0.4 down'], ['0.94'], ['1.00', '0.80 to 1.33'], ['9.2', '9.0 down, 2.0 back'], ['9.7', '9.5 down, 2.0 back'],
  ]);
  assert.equal(await row.locator('td').nth(2).getAttribute('title'), 'twenty papers');
  assert.match(await card.locator('tbody tr', { hasText: /stomion/i }).locator('td').nth(2).innerText(), /–/);
  assert.match(await page.locator('.figures.variants').innerText(), /Mandible 6 mm forward, front 2 deg up/);
  assert.deepEqual(complaints, []);
  await close();
});

test('added volume in words: of a change, of a face’s name, and of what shows at the skin', async () => {
  const { changeWords } = await imported('replay/change_words.ts');
  const { briefName } = await imported('studio/brief_name.ts');
  const { shownMoves, volumeSentence } = await imported('replay/surgery.ts');
  const regions = (...rows) => ({ 'tissue.region': rows });
  const added = regions({ name: 'cheek_L', volume_ml: 2 });
  const both = regions({ name: 'cheek_L', young_factor: 5, volume_ml: -1 }, { painted: 'painted-1.csv', volume_ml: 0.5 });
  assert.deepEqual(changeWords(added, {}, () => ''), ['Cheek L: 2 ml added']);
  assert.deepEqual(changeWords(both, {}, () => ''), ['Cheek L: stiffness × 5, 1 ml taken away', 'Painted patch: 0.5 ml added']);
  assert.equal(briefName(added, {}, []), 'cheek, left: 2 ml added');
  assert.equal(briefName(both, {}, []), 'cheek, left: 5 x, 1 ml taken away; painted patch: 0.5 ml');
  assert.equal(briefName(regions({ name: 'cheek_L', young_factor: 5 }), {}, []), 'cheek, left 5 x');

  const row = (added_volume_ml, skin_volume_change_ml, changes = {}) => ({
    changes, surgery: { landmarks: [{ at_rest_mm: [0, 0, 0.04] }, { at_rest_mm: [0, 0.04, 0.04] }], added_volume_ml, skin_volume_change_ml, greatest_at_rest_mm: 0.71 },
  });
  assert.equal(volumeSentence(row(2, 1.83)), '2 ml added, 1.8 ml show at the skin, which moves by up to 0.7 mm');
  assert.equal(volumeSentence(row(-1, -0.9)), '1 ml taken away, 0.9 ml show at the skin, which moves by up to 0.7 mm');
  assert.equal(volumeSentence(row(2, -1.2, { 'surgery.bone': [] })), '2 ml added; with the bones the skin loses 1.2 ml and moves by up to 0.7 mm');
  assert.equal(volumeSentence({ surgery: { landmarks: [] } }), '', 'bones alone');
  assert.equal(volumeSentence(undefined), '');
  assert.equal(shownMoves(row(2, 1.8)).length, 1, 'what stays in its place is left out');
  assert.equal(shownMoves(row(undefined, 1.8)).length, 2, 'but not of moved bones');
});

test('added volume in the table of surgery: what shows at the skin, and the landmarks that move', async () => {
  const { page, complaints, close } = await changedPage((data) => {
    const move = (landmark, at_rest_mm) => ({ landmark, at_rest_mm, expression_before_mm: [0, -9, -2], expression_after_mm: [0, -9, -2] });
    Object.assign(data.summary.variants.table[1], {
      surgery: {
        landmarks: [move('alare_L', [0.3, 0, 0.6]), move('pogonion', [0, 0.01, 0])], added_volume_ml: 2, skin_volume_change_ml: 1.8, greatest_at_rest_mm: 3.1,
      },
      changes: { 'tissue.region': [{ name: 'cheek_L', volume_ml: 2 }] },
    });
  });
  const card = page.locator('.figures.surgery');
  assert.equal(await card.locator('th[scope=rowgroup] small').textContent(), '2 ml added, 1.8 ml show at the skin, which moves by up to 3.1 mm');
  const rows = card.locator('tbody th[scope=row]');
  assert.equal(await rows.count(), 1);
  assert.match(await rows.innerText(), /alare/i);
  assert.match(await page.locator('.figures.variants').innerText(), /Cheek L: 2 ml added/);
  if (pictures) await card.screenshot({ path: join(pictures, 'volume_table.png') });
  assert.deepEqual(complaints, []);
  await close();
});

test('values under the bar of colours do not overlap', async () => {
  const { ticksOf } = await imported('replay/face/colouring.ts');
  const texts = (least, greatest) => ticksOf({ least, greatest }).map(({ text }) => text);
  assert.deepEqual(texts(192.4, 962), ['192.4', '577.2', '962']);
  assert.deepEqual(texts(0, 5), ['0', '1', '2', '3', '4', '5']);
  assert.deepEqual(texts(0, 1000), ['0', '500', '1,000']);
});
