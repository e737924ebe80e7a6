// SPDX-License-Identifier: GPL-3.0-or-later
// What a reader meets first: a face and not a mask, what moves it, and millimetres, without scrolling.
//   REPORT=out/variants/report.html node --test web/tests/first_screen.test.mjs
// Without REPORT it takes the variants of a made-up face that write_report_fixtures wrote.
import assert from 'node:assert/strict';
import { mkdtemp, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { launch, openPage, tooWide } from './browser.mjs';
import { fixture } from './fixtures.mjs';
import { readPage, withData } from './page_data.mjs';
import { look } from './pixels.mjs';

const report = process.env.REPORT ? resolve(process.env.REPORT) : fixture('variants.html');

let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

for (const [name, options] of [
  ['desktop', { viewport: { width: 1440, height: 900 } }],
  ['phone', { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true }],
])
  test(`face, play button, slider and first figures are in the first window (${name})`, async () => {
    const { page, complaints, close } = await openPage(browser, report, options);
    for (const id of ['face', 'play', 'frame', 'headline']) {
      const box = await page.locator(`#${id}`).boundingBox();
      assert.ok(box && box.width > 20 && box.height > 5, `${id} has a size`);
      assert.ok(box.y >= 0 && box.y + box.height <= options.viewport.height, `${id} ends at ${box.y + box.height} px`);
      assert.ok(box.x >= 0 && box.x + box.width <= options.viewport.width, `${id} is cut at the side`);
    }
    assert.ok((await page.locator('#face').boundingBox()).height >= 250, 'the face is large enough');
    assert.ok(await tooWide(page) <= 0);
    if (name === 'phone') {
      const height = await page.evaluate(() => document.documentElement.scrollHeight);
      assert.ok(height < 6000, `the page is ${height} px long`);
      for (const text of await page.locator('.figures details').all()) assert.equal(await text.getAttribute('open'), null);
    }
    assert.deepEqual(complaints, []);
    await close();
  });

describe('the first figures', () => {
  let page, close, data, floats;
  before(async () => {
    ({ page, close } = await openPage(browser, report));
    ({ data, floats } = await readPage(report));
  });
  after(() => close?.());

  /** Largest distance of a landmark from its first place, mm. */
  const excursion = (stretch, point) => {
    const { names, time_s } = data.landmarks;
    const at = (f) => [0, 1, 2].map((k) => positions[(f * names.length + names.indexOf(point)) * 3 + k]);
    const positions = floats(stretch);
    return Math.max(...time_s.map((_, f) => 1e3 * Math.hypot(...at(f).map((v, k) => v - at(0)[k]))));
  };
  const corner = (side) => (data.landmarks.names.includes('cheilion_L') ? `cheilion_${side}` : { L: 'ibug68_54', R: 'ibug68_48' }[side]);

  test('are how far both corners of the mouth go, in words, of the face that is shown', async () => {
    for (const [i, { landmarks }] of [{ landmarks: data.landmarks.positions }, ...data.variants].entries()) {
      await page.locator('#chips button').nth(i).click();
      const [left, right] = ['L', 'R'].map((side) => excursion(landmarks, corner(side)));
      const text = await page.locator('#headline').textContent();
      assert.ok(text.startsWith(`right ${right.toFixed(1)} mm, left ${left.toFixed(1)} mm`), `${text}, not ${left} and ${right}`);
      const verdict = text.split(': ')[1];
      // A variant's change against base is shown beside the difference of the sides: sides.test.mjs.
      if (i > 0) assert.match(await page.locator('.answers dd').first().textContent(), /^(both corners go|(right|left) .*) (as|than) in base/);
      else if (/undecided/.test(text) || /cannot tell/.test(text)) assert.match(verdict, /^a difference of \d+\.\d+ mm/);
      else if (Math.abs(left - right) >= 0.05)
        assert.ok(text.endsWith(`: a difference of ${Math.abs(Number(left.toFixed(1)) - Number(right.toFixed(1))).toFixed(1)} mm`), text);
    }
  });

  test('have a line for each variant, against base', async () => {
    const lines = await page.locator('.variant-lines li').allTextContents();
    assert.deepEqual(lines.map((line) => line.split(': ')[0]), data.variants.map(({ name }) => name));
    data.variants.forEach(({ landmarks }, i) => {
      const changes = ['L', 'R'].map((side) => excursion(landmarks, corner(side)) - excursion(data.landmarks.positions, corner(side)));
      const most = Math.abs(changes[0]) > Math.abs(changes[1]) ? 0 : 1;
      if (Math.abs(changes[most]) < 0.05) return assert.match(lines[i], /as base/);
      const side = ['left', 'right'][most];
      const goes = excursion(landmarks, corner(side === 'left' ? 'L' : 'R')).toFixed(1);
      const by = Math.abs(goes - excursion(data.landmarks.positions, corner(side === 'left' ? 'L' : 'R')).toFixed(1)).toFixed(1);
      assert.ok(lines[i].includes(`${side} corner ${goes} mm, ${changes[most] < 0 ? `follows ${by} mm less` : `moves ${by} mm farther`} than in base`), lines[i]);
    });
  });

  test('left has one colour and right another, in words and curves, readable on either paper', async () => {
    const { palette } = data;
    const of = (side) => page.locator(`#headline .${side} i`).evaluate((e) => getComputedStyle(e).backgroundColor);
    const rgb = (hex) => `rgb(${[1, 3, 5].map((k) => Number.parseInt(hex.slice(k, k + 2), 16)).join(', ')})`;
    assert.equal(await of('left'), rgb(palette.light[palette.left]));
    assert.equal(await of('right'), rgb(palette.light[palette.right]));
    assert.equal(palette.faces.slice(0, 6).some((hue) => [palette.left, palette.right].includes(hue)), false);
    const luminance = (hex) => [0.2126, 0.7152, 0.0722].reduce((sum, w, k) => {
      const s = Number.parseInt(hex.slice(1 + 2 * k, 3 + 2 * k), 16) / 255;
      return sum + w * (s <= 0.04045 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4);
    }, 0.05);
    for (const [colours, paper] of [[palette.light, '#ffffff'], [palette.dark, '#1c1f24']])
      for (const colour of colours) {
        const [low, high] = [luminance(colour), luminance(paper)].sort((a, b) => a - b);
        assert.ok(high / low >= 3, `${colour} on ${paper}: ${(high / low).toFixed(2)}`);
      }
  });

  test('points are called what people call them', async () => {
    const text = await page.locator('body').innerText();
    assert.doesNotMatch(text, /ibug|iBUG|_[LR]\b/);
    assert.match(text, /the scene without a variant|corner of the mouth/i);
    assert.doesNotMatch(text, /the scene itself/);
  });
});

test('what is below its floor is undecided, and warnings come first', { skip: Boolean(process.env.REPORT) }, async () => {
  const { html, data } = await readPage(report);
  const sides = { L: 8.2, R: 7.9 };
  data.summary.symmetry = { excursions: [{
    point: 'cheilion', excursion_mm: sides, path_mm: sides, peak_speed_mm_s: sides, excursion_ratio_R_L: 0.96, path_ratio_R_L: 0.96,
    peak_speed_ratio_R_L: 0.96, speed_correlation: 0.99, undecided: true, floor_mm: 0.9, peak_speed_undecided: true, peak_speed_floor_mm_s: 5.5,
  }] };
  Object.assign(data.point_words, { cheilion: 'corner of the mouth (cheilion)' });
  data.notes = ['the scan has a hole', 'a landmark is off'];
  Object.assign(data.summary, { warnings: ['a landmark is off'], max_displacement_mm: 25.5, lip_opening_mm: null, nothing: '' });
  const file = join(await mkdtemp(join(tmpdir(), 'hyperex-page-')), 'undecided.html');
  await writeFile(file, withData(html, data));
  const { page, close } = await openPage(browser, file);
  assert.equal(await page.locator('#headline').textContent(), 'right 7.9 mm, left 8.2 mm: a difference of 0.3 mm: undecided (below 0.9 mm)');
  const cells = await page.locator('.excursions tbody td .undecided').allTextContents();
  assert.deepEqual(cells, ['undecided (below 0.9 mm)', 'undecided (below 5.5 mm/s)']);
  assert.deepEqual(await page.locator('#note-list li').allTextContents(), ['Warning: A landmark is off', 'The scan has a hole']);
  // The top of the page counts them, too.
  assert.equal(await page.locator('#facts a[href="#note-list"]').textContent(), '1 warning');
  const rows = await page.locator('#summary-tables > .table-cards tr').allTextContents();
  assert.deepEqual(rows, ['Largest displacement of the skin25.5 mm'], 'grouped, with units, and nothing that is empty');
  await close();
  await rm(dirname(file), { recursive: true });
});

test('without known jitter a difference above its floor is not decided', { skip: Boolean(process.env.REPORT) }, async () => {
  const { html, data } = await readPage(report);
  const sides = { L: 8.2, R: 6.1 };
  data.summary.symmetry = { excursions: [{
    point: 'cheilion', excursion_mm: sides, path_mm: sides, peak_speed_mm_s: sides, excursion_ratio_R_L: 0.74, path_ratio_R_L: 0.74,
    peak_speed_ratio_R_L: 0.74, speed_correlation: 0.99, undecided: null, floor_mm: 0.9, path_undecided: null, path_floor_mm: null,
    peak_speed_undecided: null, peak_speed_floor_mm_s: null, speed_correlation_undecided: null,
  }] };
  const file = join(await mkdtemp(join(tmpdir(), 'hyperex-page-')), 'unknown.html');
  await writeFile(file, withData(html, data));
  const { page, close } = await openPage(browser, file);
  assert.equal(await page.locator('#headline').textContent(), 'right 6.1 mm, left 8.2 mm: a difference of 2.1 mm: cannot tell (jitter not known)');
  assert.deepEqual(await page.locator('.excursions tbody td .undecided').allTextContents(), Array(4).fill('cannot tell'));
  await close();
  await rm(dirname(file), { recursive: true });
});

test('begins with the skin, and nothing of what is behind shows through its holes', async () => {
  const { page, close } = await openPage(browser, report);
  assert.deepEqual(await page.locator('#colouring [aria-pressed=true]').allTextContents(), ['Skin']);
  await page.addStyleTag({ content: '#canvas-host { background: #ff00ff; } .face-label, .save { display: none; }' });
  await page.locator('#to-peak').click();
  const through = async () => (await look(page)).evaluate(({ width, height, data }) => {
    const behind = (x, y) => {
      const i = 4 * (y * width + x);
      return data[i] > 230 && data[i + 1] < 60 && data[i + 2] > 230;
    };
    let seen = 0;
    for (let x = Math.round(0.4 * width); x < 0.6 * width; ++x) {
      // Less the stage's own edge.
      const rows = Array.from({ length: height - 8 }, (_, y) => y + 4).filter((y) => !behind(x, y));
      for (let y = rows[0]; y < rows.at(-1); ++y) seen += behind(x, y);
    }
    return seen;
  });
  assert.equal(await through(), 0);
  await close();
});

test('the page may load nothing from anywhere', async () => {
  const { html } = await readPage(report);
  const policy = /<meta http-equiv="Content-Security-Policy" content="([^"]*)"/.exec(html)?.[1];
  assert.equal(policy, "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:");
  const { page, close } = await openPage(browser, report);
  const refused = await page.evaluate(() => fetch('data:text/plain,x').then(() => 'loaded', (error) => error.name));
  assert.equal(refused, 'TypeError');
  await close();
});
