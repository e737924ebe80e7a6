// SPDX-License-Identifier: GPL-3.0-or-later
// The curves and tables of a report with variants: what they show is compared with the page's data.
//   REPORT=out/a/report.html SCREENSHOTS=/tmp/pictures node --test web/tests/curves.test.mjs
// Without REPORT it takes the variants of a made-up face that write_report_fixtures wrote.
import assert from 'node:assert/strict';
import { readFile, rm } from 'node:fs/promises';
import { basename, dirname, join, resolve } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { launch, openPage, tooWide } from './browser.mjs';
import { fixture } from './fixtures.mjs';
import { rarePage } from './made_up_page.mjs';
import { readPage } from './page_data.mjs';

const report = process.env.REPORT ? resolve(process.env.REPORT) : fixture('variants.html');
const pictures = process.env.SCREENSHOTS;
const symmetryTitle = 'Symmetry of motion, S(t)';
const stretchTitle = 'Stretch of either side, ξ(t)';
const addedTitle = 'What each variant adds, Δ(ξL − ξR)';
const trackTitle = 'Point tracks';
const itself = 'base';

let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

const card = (page, title) => page.locator('.plot-card').filter({ has: page.getByRole('heading', { name: title, exact: true }) });
const entry = (page, title, label) => card(page, title).locator('.u-series').filter({ has: page.getByRole('button', { name: label, exact: true }) });
const numberIn = (text) => (text.trim() === '–' ? null : Number.parseFloat(text.replaceAll(',', '').replace('−', '-')));
const legend = async (page, title, label) => numberIn(await entry(page, title, label).locator('.u-value').textContent());
const rounded = (value, digits) => (value === null ? null : Number(value.toFixed(digits)));

async function saved(page, button) {
  const [download] = await Promise.all([page.waitForEvent('download'), button.click()]);
  return { name: download.suggestedFilename(), bytes: await readFile(await download.path()) };
}

/** Names and rows of texts of a CSV file. */
function csv(bytes) {
  const rows = bytes.toString('utf8').trimEnd().split('\r\n').map((line) =>
    [...line.matchAll(/(?:^|,)(?:"((?:[^"]|"")*)"|([^,]*))/g)].map(([, quoted, plain]) => quoted?.replaceAll('""', '"') ?? plain));
  return { names: rows[0], rows: rows.slice(1) };
}

/** How many pixels of a chart are of exactly this colour (#rrggbb). */
const pixelsOf = (page, title, colour) =>
  card(page, title).locator('canvas').evaluate((canvas, hex) => {
    const wanted = Number(`0xff${hex.slice(5, 7)}${hex.slice(3, 5)}${hex.slice(1, 3)}`);
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    return new Uint32Array(data.buffer).filter((pixel) => pixel === wanted).length;
  }, colour);

const faceColours = ({ light, faces }, count) => Array.from({ length: count }, (_, i) => light[faces[i % faces.length]]);

/** Inked shares of the strips just over and just under the dashed line at mid-time. */
const inkAround = (page, floor) =>
  card(page, symmetryTitle).locator('canvas').evaluate((canvas, share) => {
    const [box, over] = [canvas, canvas.parentElement.querySelector('.u-over')].map((e) => e.getBoundingClientRect());
    const scale = canvas.width / box.width;
    const x = Math.round((over.x - box.x + 0.42 * over.width) * scale);
    const y = Math.round((over.y - box.y + share * over.height) * scale);
    const inked = (top) => {
      const { data } = canvas.getContext('2d').getImageData(x, top, Math.round(30 * scale), Math.round(10 * scale));
      return data.filter((v, i) => i % 4 === 3 && v > 0).length / (data.length / 4);
    };
    return { over: inked(y - Math.round(12 * scale)), under: inked(y + Math.round(3 * scale)) };
  }, floor);

describe(`curves of ${basename(report)}`, () => {
  let page, complaints, close, data, floats, names;
  before(async () => {
    ({ page, complaints, close } = await openPage(browser, report, { acceptDownloads: true }));
    ({ data, floats } = await readPage(report));
    names = [itself, ...data.variants.map((v) => v.name)];
  });
  after(() => close?.());
  const symmetryOf = (i) => (i === 0 ? data.symmetry : data.variants[i - 1].symmetry);
  const goTo = (frame) => page.locator('#frame').fill(String(frame));
  const showFace = (i) => page.locator('.variants .face').nth(i).click();

  test('S(t) of each face is drawn in its colour, and goes where it is taken away', async () => {
    const colours = faceColours(data.palette, names.length);
    for (const [i, name] of names.entries()) {
      const button = entry(page, symmetryTitle, name).getByRole('button');
      await button.click({ modifiers: ['Control'] });
      assert.equal(await button.getAttribute('aria-pressed'), 'true');
      for (const [k, colour] of colours.entries()) {
        const pixels = await pixelsOf(page, symmetryTitle, colour);
        if (k === i) assert.ok(pixels > 150, `${name}: ${pixels} pixels of ${colour}`);
        else if (colour !== colours[i]) assert.equal(pixels, 0, `${names[k]} is not hidden`);
      }
      await button.click();
      assert.equal(await button.getAttribute('aria-pressed'), 'false');
      assert.equal(await pixelsOf(page, symmetryTitle, colours[i]), 0);
      await button.click({ modifiers: ['Control'] });
    }
    for (const button of await card(page, symmetryTitle).locator('.u-series button').all())
      assert.equal(await button.getAttribute('aria-pressed'), 'true', 'all are back');
  });

  test('the legend shows all values at the time shown, and where the pointer is', async () => {
    for (const frame of [3, Math.round(0.5 * data.symmetry.time_s.length)]) {
      await goTo(frame);
      for (const [i, name] of names.entries())
        assert.equal(await legend(page, symmetryTitle, name), rounded(symmetryOf(i).s[frame], 2), name);
    }
    const over = card(page, symmetryTitle).locator('.u-over');
    await over.scrollIntoViewIfNeeded();
    const box = await over.boundingBox();
    await page.mouse.move(box.x + 0.8 * box.width, box.y + 0.5 * box.height);
    const last = data.symmetry.time_s.length - 1;
    const near = [-1, 0, 1].map((d) => rounded(symmetryOf(1).s[Math.round(0.8 * last) + d], 2));
    assert.ok(near.includes(await legend(page, symmetryTitle, names[1])));
    await page.mouse.move(0, 0);
  });

  test('the noise floor is drawn, hatched beneath, with room for what lies over it', async (t) => {
    const { noise, floor, time_s } = data.symmetry;
    if (noise.length === 0) return t.skip('the motion is exact');
    const frame = Math.round(0.42 * (time_s.length - 1));
    await goTo(frame);
    assert.equal(await legend(page, symmetryTitle, 'noise floor'), rounded(Math.log(noise[frame]), 2));
    assert.match(await card(page, symmetryTitle).locator('p').textContent(), /undecided: under the noise floor/);
    const drawn = [...noise.map(Math.log), ...names.flatMap((_, i) => symmetryOf(i).s)].filter((v) => v > Math.log(floor) + 1e-6);
    const [low, high] = [Math.min(...drawn), Math.max(...drawn)];
    const button = entry(page, symmetryTitle, 'noise floor').getByRole('button');
    await button.click({ modifiers: ['Control'] });
    const { over, under } = await inkAround(page, (high + 0.06 * (high - low) - Math.log(noise[frame])) / (1.26 * (high - low)));
    await button.click({ modifiers: ['Control'] });
    assert.ok(under > over + 0.2, `${over} over, ${under} under`);
  });

  test('the cursor goes along with the time', async () => {
    const place = () => page.locator('.plot-card .now').evaluateAll((all) => all.map((now) => {
      const over = now.parentElement.getBoundingClientRect();
      return (now.getBoundingClientRect().x + 1 - over.x) / over.width;
    }));
    const { time_s } = data.motion;
    for (const frame of [0, Math.round(0.6 * (time_s.length - 1))]) {
      await goTo(frame);
      const wanted = (time_s[frame] - time_s[0]) / (time_s.at(-1) - time_s[0]);
      for (const share of await place()) assert.ok(Math.abs(share - wanted) < 0.012, `${share} is not ${wanted}`);
    }
  });

  test('pressing a name in the table shows that face in table and curves', async () => {
    const frame = Math.round(0.4 * data.symmetry.time_s.length);
    await goTo(frame);
    for (const i of [1, names.length - 1, 0]) {
      await showFace(i);
      const pressed = await page.locator('.variants .face').evaluateAll((all) => all.map((b) => b.getAttribute('aria-pressed')));
      assert.deepEqual(pressed, names.map((_, k) => String(k === i)));
      assert.deepEqual(await page.locator('.variants tbody tr').evaluateAll((all) => all.findIndex((r) => r.classList.contains('shown'))), i);
      assert.equal(await legend(page, stretchTitle, 'ξL'), rounded(symmetryOf(i).xi_left[frame], 4));
      assert.equal(await legend(page, stretchTitle, 'ξR'), rounded(symmetryOf(i).xi_right[frame], 4));
      assert.match(await card(page, trackTitle).locator('p').textContent(), new RegExp(`These are the tracks of ${names[i]}\\.$`));
    }
  });

  test('what each variant adds is the difference of its sides less that of base', async () => {
    const frame = Math.round(0.4 * data.symmetry.time_s.length);
    await goTo(frame);
    const apart = (i, f) => symmetryOf(i).xi_left[f] - symmetryOf(i).xi_right[f];
    for (const [i, name] of names.entries())
      assert.equal(await legend(page, addedTitle, name), rounded(apart(i, frame) - apart(0, frame), 4) + 0, name);
    assert.match(await card(page, addedTitle).locator('p').textContent(), /what tissue changes.*docs\/symmetry\.md/);
    const { names: columns, rows } = csv((await saved(page, card(page, addedTitle).getByRole('button', { name: /^CSV/ }))).bytes);
    const last = names.length - 1;
    assert.equal(columns[last + 1], `${names[last]}: Delta(xi_L - xi_R) (1)`);
    rows.forEach((row, f) => assert.ok(Math.abs(Number(row[last + 1]) - apart(last, f) + apart(0, f)) < 1e-12));
  });

  test('tracks are distances from the first frame, of two faces the second dashed', async () => {
    const frame = data.motion.peak_frame;
    await goTo(frame);
    const { names: points } = data.landmarks;
    const travel = (positions, point) => {
      const at = (f) => [0, 1, 2].map((k) => positions[(f * points.length + point) * 3 + k]);
      return 1e3 * Math.hypot(...at(frame).map((v, k) => v - at(0)[k]));
    };
    const point = points.indexOf(data.summary.variants.response_point);
    const label = data.point_words[points[point]];
    const { name, landmarks } = data.variants[0];
    await showFace(1);
    assert.equal(await legend(page, trackTitle, label), rounded(travel(floats(landmarks), point), 2));
    await showFace(0);
    await page.locator('#modes [data-mode=side-by-side]').click();
    await page.locator('#chips [data-face="1"]').click();
    assert.equal(await legend(page, trackTitle, label), rounded(travel(floats(data.landmarks.positions), point), 2));
    assert.equal(await legend(page, trackTitle, `${name}: ${label}`), rounded(travel(floats(landmarks), point), 2));
    assert.match(await card(page, trackTitle).locator('p').textContent(), new RegExp(`Solid: base; dashed: ${name}`));
    const marker = entry(page, trackTitle, `${name}: ${label}`).locator('.u-marker');
    assert.match(await marker.evaluate((m) => m.style.border), /dashed/);
    await page.locator('#modes [data-mode=single]').click();
    assert.equal(await entry(page, trackTitle, `${name}: ${label}`).count(), 0);
  });

  test('points are chosen', async () => {
    const chooser = card(page, trackTitle).locator('.chooser');
    await chooser.locator('summary').click();
    const count = () => card(page, trackTitle).locator('.u-series button').count();
    const atFirst = await count();
    const box = chooser.getByRole('checkbox', { checked: false }).first();
    await box.check();
    assert.equal(await count(), atFirst + 1);
    await chooser.getByRole('checkbox', { checked: true }).first().uncheck();
    assert.equal(await count(), atFirst);
    await chooser.locator('summary').click();
  });

  test('the table shows what the data hold', async () => {
    const keys = [
      'greatest_displacement_mm', 'greatest_distance_mm', 'rms_distance_at_peak_mm', 'mean_displacement_R_mm',
      'mean_displacement_L_mm', 'asymmetry_rms_mm', 'added_xi_difference',
      'share_within_25_mm_of_mouth', 'lag_ms', 'hysteresis', 'symmetry_integral_s',
    ];
    const table = page.getByRole('table', { name: 'Variants' });
    const heads = await table.locator('thead th').allTextContents();
    assert.deepEqual(heads.slice(1, 12).map((h) => /(mm|%|ms|1|s)(, \w+)?$/.test(h)), Array(11).fill(true), heads.join());
    const rows = await table.locator('tbody tr').evaluateAll((all) =>
      all.map((row) => ({ name: row.querySelector('.face').textContent, cells: [...row.cells].slice(1).map((c) => c.firstChild.textContent) })));
    assert.deepEqual(rows.map((row) => row.name), names);
    data.summary.variants.table.forEach((row, i) => keys.forEach((key, k) => {
      const text = rows[i].cells[k];
      if (row[key] === null) return assert.equal(text, '–', key);
      const value = row[key] * (key.startsWith('share') ? 100 : 1);
      const digits = text.split('.')[1]?.length ?? 0;
      assert.ok(digits >= 1, `${key}: ${text}`);
      assert.ok(Math.abs(numberIn(text) - value) <= 0.5001 * 10 ** -digits, `${key}: ${text} is not ${value}`);
    }));
    const text = await page.locator('.variants').textContent();
    const { driven_point, response_point } = data.summary.variants;
    for (const point of [driven_point, response_point])
      assert.ok(text.includes(data.point_words[point]), point);
    assert.match(text, /undecided/);
    assert.equal((await page.locator('body').innerText()).includes('[object'), false);
  });

  test('what is plotted is saved as CSV', async () => {
    await showFace(0);
    const gone = entry(page, symmetryTitle, names[2]).getByRole('button');
    await gone.click();
    const { name, bytes } = await saved(page, card(page, symmetryTitle).getByRole('button', { name: /^CSV/ }));
    await gone.click();
    assert.match(name, /symmetry-of-motion-s-t\.csv$/);
    const { names: columns, rows } = csv(bytes);
    assert.equal(columns[0], 'time (s)');
    const shown = names.map((_, i) => i).filter((i) => i !== 2);
    assert.deepEqual(columns.slice(2), shown.map((i) => `${i === 0 ? 'base' : names[i]}: S (ln)`));
    assert.equal(rows.length, data.symmetry.time_s.length);
    rows.forEach((row, f) => {
      assert.equal(Number(row[0]), data.symmetry.time_s[f]);
      shown.forEach((i, k) => assert.equal(row[k + 2] === '' ? null : Number(row[k + 2]), symmetryOf(i).s[f]));
    });
    const table = csv((await saved(page, page.locator('.variants').getByRole('button', { name: /^CSV/ }))).bytes);
    assert.equal(table.rows.length, names.length);
    const lag = table.names.indexOf('Lag (ms)');
    data.summary.variants.table.forEach((row, i) =>
      assert.equal(table.rows[i][lag], row.lag_ms === null ? '' : String(row.lag_ms)));
  });

  test('the plot is saved as a picture', async () => {
    const { name, bytes } = await saved(page, card(page, symmetryTitle).getByRole('button', { name: /^PNG/ }));
    assert.match(name, /\.png$/);
    const colours = faceColours(data.palette, names.length);
    const seen = await page.evaluate(async ([base64, wanted]) => {
      const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
      const image = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
      const pen = new OffscreenCanvas(image.width, image.height).getContext('2d');
      pen.drawImage(image, 0, 0);
      const pixels = new Uint32Array(pen.getImageData(0, 0, image.width, image.height).data.buffer);
      const counts = new Map();
      for (const p of pixels) counts.set(p, (counts.get(p) ?? 0) + 1);
      const found = wanted.map((h) => counts.get(Number(`0xff${h.slice(5, 7)}${h.slice(3, 5)}${h.slice(1, 3)}`)) ?? 0);
      return { width: image.width, height: image.height, found };
    }, [bytes.toString('base64'), colours]);
    assert.ok(seen.width >= 1600 && seen.height >= 800, `${seen.width} x ${seen.height}`);
    seen.found.forEach((pixels, i) => assert.ok(pixels > 100, `${names[i]}: ${pixels} pixels`));
    if (pictures) await page.locator('#plots').screenshot({ path: join(pictures, 'curves_light.png') });
  });

  test('says nothing on the console and asks nothing of the network', () => assert.deepEqual(complaints, []));
});

describe('figures that are rare', () => {
  let file, page, complaints, close, data;
  before(async () => {
    file = await rarePage();
    ({ page, complaints, close } = await openPage(browser, file, { acceptDownloads: true, colorScheme: 'dark' }));
    ({ data } = await readPage(file));
  });
  after(async () => {
    await close?.();
    await rm(dirname(file), { recursive: true });
  });

  test('an exact motion has a floor, and what lies under it is hatched and undecided', async () => {
    const caption = await card(page, symmetryTitle).locator('p').textContent();
    assert.match(caption, /undecided: S stops at the floor, ln 10⁻⁶ = −13\.82/);
    const button = entry(page, symmetryTitle, 'floor').getByRole('button');
    await button.click({ modifiers: ['Control'] });
    // Alone the floor's range is its own value and some room on either side.
    const { over, under } = await inkAround(page, 0.06 / 0.19);
    assert.ok(under > over + 0.2, `${over} over, ${under} under`);
    await button.click({ modifiers: ['Control'] });
  });

  test('what is not defined is a dash, small figures keep two digits', async () => {
    const cell = (row, column) => page.locator('.variants tbody tr').nth(row).locator('td').nth(column).textContent();
    assert.equal(await cell(0, 7), '–');
    assert.equal(await cell(1, 8), '–');
    assert.equal(await cell(0, 9), data.summary.variants.table[0].hysteresis.toFixed(4));
    const { rows, names } = csv((await saved(page, page.locator('.variants').getByRole('button', { name: /^CSV/ }))).bytes);
    assert.equal(rows[2][names.indexOf('Hysteresis (1)')], '0.0000032');
    assert.equal(rows[1][names.indexOf('Lag (ms)')], '');
  });

  test('what a variant adds to ξL − ξR stands beside its floor and its verdict', async () => {
    const cells = (row) => page.locator('.variants tbody tr').nth(row).locator('td').allTextContents();
    assert.equal((await cells(1))[6], '0.0031undecided, floor 0.0123');
    assert.equal((await cells(2))[6], '0.0456floor 0.0123');
    const text = await page.locator('.variants').textContent();
    assert.match(text, /undecided below its floor/);
    assert.doesNotMatch(text, /exact/);
  });

  test('numbers that stand for none are words in the summary', async () => {
    const shown = (key) => page.locator(`th[title="${key}"] + td`).textContent();
    assert.equal(await shown('symmetry.lowpass_hz'), 'not filtered');
    assert.equal(await shown('options.output.lowpass_hz'), '6 Hz');
    assert.equal(await shown('options.output.jitter_mm'), 'automatic');
    assert.equal(await shown('options.output.peak_time_s'), 'automatic');
    assert.equal(await shown('options.time.end_s'), 'end of the recording');
    assert.equal(await shown('options.time.step_s'), '0.005 s');
  });

  test('changes are stated in words', async () => {
    const told = await page.locator('.variants tbody tr').evaluateAll((rows) =>
      rows.map((row) => [...row.querySelectorAll('th small')].map((s) => s.textContent)));
    const place = told[1].slice(-2);
    assert.match(place[0], /^Differs most at a vertex of the skin (near|(\d+|less than 1) mm from) corner of the mouth \(cheilion\), right: by \d+\.\d mm at \d\.\d{3} s\.$/);
    assert.match(place[1], /^At the peak, \d\.\d{3} s, that vertex moves 16\.00 instead of 20\.00 mm\. The corner’s own figures are those above, under “Corners of the mouth”\.$/);
    assert.deepEqual(told.slice(0, 4).map((lines) => lines.filter((line) => !/vertex/.test(line))), [
      ['the scene without a variant'],
      ['Stiffness 1,000 instead of 192.4 kPa', 'Solver: method direct instead of reduced',
        'Muscles of the right side at 30 %', 'Left muscles of the zygomatic branch at 0 %', 'Right zyg major at 125.5 %'],
      ['Scar corner of the mouth (cheilion), right to alare R: width 8 mm, stiffness × 20', 'Lips: viscosity 900 Pa s'],
      ['Cheek L: stiffness 80 kPa', 'Motion: gain 0.5 instead of 1'],
    ]);
  });

  test('the excursions of either side, named points first', async () => {
    const rows = page.locator('.excursions tbody tr:visible');
    const texts = () => rows.evaluateAll((all) => all.map((row) => [...row.cells].map((c) => c.textContent)));
    assert.deepEqual((await texts()).map(([name]) => name), ['Corner of the mouth (cheilion)', 'Cheek', 'Wing of the nose (alare)']);
    const [cheilion, cheek] = await texts();
    assert.deepEqual(cheilion.slice(2), ['4.20', '6.78', '0.619', '8.40', '13.56', '0.619', '37.8', '61.0', '0.619', '0.987']);
    assert.equal(cheek[4], '–', 'no ratio where the left rests');
    assert.equal((await texts())[2][4], 'undecided (below 0.3 mm)');
    await page.getByRole('button', { name: 'Show 1 more points' }).click();
    assert.deepEqual((await texts()).map(([name]) => name), ['Corner of the mouth (cheilion)', 'Cheek', 'Wing of the nose (alare)', 'Outline of the jaw']);
    const widths = await page.locator('.balance').evaluateAll((all) => all.map((b) => [...b.children].map((i) => i.offsetWidth)));
    assert.ok(Math.abs(widths[0][1] / widths[3][1] - 6.78 / 12) < 0.05, String(widths));
    const { names, rows: lines } = csv((await saved(page, page.locator('.excursions').getByRole('button', { name: /^CSV/ }))).bytes);
    assert.equal(lines.length, 4);
    assert.equal(lines.find(([p]) => p === 'cheilion')[names.indexOf('Excursion right (mm)')], '4.2');
    const whose = page.locator('.excursions .whose');
    assert.equal(await whose.textContent(), 'These are the figures of base.');
    await page.keyboard.press('3');
    assert.deepEqual((await texts()).map(([name, , R, L]) => [name, R, L]), [['Wing of the nose (alare)', '0.25', '6.00'], ['Corner of the mouth (cheilion)', '3.00', '5.00']]);
    assert.notEqual(await whose.textContent(), 'These are the figures of base.');
    await page.keyboard.press('1');
    assert.equal((await texts()).length, 4);
  });

  test('the summary has a row for each figure of a list, and no second table of variants', async () => {
    const rows = await page.locator('#summary-tables th').allTextContents();
    assert.ok(rows.includes('checks · 1 first · worst'), rows.join());
    assert.ok(rows.includes('checks · 2 · worst'));
    assert.equal(rows.some((row) => /variants|excursion/i.test(row)), false);
    assert.equal((await page.locator('body').innerText()).includes('[object'), false);
  });

  test('says nothing on the console', () => assert.deepEqual(complaints, []));

  for (const [name, options] of [
    ['dark', { colorScheme: 'dark' }],
    ['phone', { viewport: { width: 390, height: 840 }, hasTouch: true, isMobile: true }],
  ])
    test(`tables fit the window (${name})`, async () => {
      const view = await openPage(browser, file, options);
      assert.ok(await tooWide(view.page) <= 0);
      if (name === 'phone') await view.page.locator('.variants summary').first().click();
      const first = view.page.locator('.variants tbody th').nth(1);
      const scroller = view.page.locator('.variants .scroller');
      const wide = await scroller.evaluate((s) => s.scrollWidth - s.clientWidth);
      if (name === 'phone') {
        assert.ok(wide > 100, 'the table scrolls in its card');
        await scroller.evaluate((s) => (s.scrollLeft = 200));
        const { x, width } = await first.boundingBox();
        assert.ok(x >= 0 && x < 30 && width < 0.5 * 390, `names stay: ${x}, ${width}`);
        await scroller.evaluate((s) => (s.scrollLeft = 0));
      } else assert.ok(wide <= 0, `${wide} px`);
      if (pictures)
        for (const part of ['plots', 'tables'])
          await view.page.locator(`#${part}`).screenshot({ path: join(pictures, `${part}_${name}.png`) });
      await view.close();
    });
});
