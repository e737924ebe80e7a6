// SPDX-License-Identifier: GPL-3.0-or-later
// What muscles do in a report: curves a side, by group, and their lines over the face.
//   REPORT=out/demo/report.html SCREENSHOTS=/tmp/pictures node --test web/tests/muscles.test.mjs
// Without REPORT it takes the variants of a made-up face that write_report_fixtures wrote, and gives it muscles.
import assert from 'node:assert/strict';
import { mkdtemp, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { launch, openPage, tooWide } from './browser.mjs';
import { fixture } from './fixtures.mjs';
import { imported } from './modules.mjs';
import { readPage, withData } from './page_data.mjs';
import { changedShare, look } from './pixels.mjs';

const given = process.env.REPORT && resolve(process.env.REPORT);
const pictures = process.env.SCREENSHOTS;

/** The group that pulls most stands second in the file; what relaxes more than that is no pull. `change`: of the data. */
async function madeUp(change = () => {}) {
  const { html, data, floats } = await readPage(fixture('variants.html'));
  const time_s = data.motion.time_s;
  const course = (most) => time_s.map((_, f) => most * Math.sin((Math.PI * f) / (time_s.length - 1)));
  const group = (name, left, right) => ({ name, left: course(left), right: course(right), sigma_left: 0.05, sigma_right: 0.07, note_left: '', note_right: '' });
  const points = floats(data.skin.points);
  const line = (side) => Array.from({ length: 9 }, (_, i) => [side * (0.02 + 0.002 * i), 0.03 - 0.006 * i, Math.max(...points)]);
  data.muscles = {
    time_s, few_points: true,
    groups: [group('brow raisers', 0.1, 0.2), group('lip corner elevators', -0.9, 0.3),
      group('orbicularis oris', -0.95, -0.95)],
    lines: [{ name: 'zyg_major_L', latin: 'zygomaticus major', points: line(1) }, { name: 'zyg_major_R', latin: 'zygomaticus major', points: line(-1) }],
  };
  for (const variant of data.variants)
    variant.muscles = data.muscles.groups.map(({ left, right }) => ({ left, right: right.map((v) => 0.3 * v) }));
  data.summary.variants.table[1].changes = { 'muscles.gain': { zyg_major_L: 0.3 } };
  change(data);
  const file = join(await mkdtemp(join(tmpdir(), 'hyperex-page-')), 'muscles.html');
  await writeFile(file, withData(html, data));
  return file;
}

let browser, report;
before(async () => {
  browser = await launch();
  report = given ?? (await madeUp());
});
after(() => browser?.close());

const card = (page) => page.locator('.plot-card').filter({ has: page.getByRole('heading', { name: 'Muscles', exact: true }) });
const most = (values) => Math.max(...values.map(Math.abs));
const extreme = (values) => (values.find((v) => Math.abs(v) === most(values)) ?? 0).toFixed(2).replace('-', '\u2212');

describe('a report of a face that muscles drive', () => {
  test('a change names the muscle in Latin', { skip: given }, async () => {
    const { page, close } = await openPage(browser, report);
    const told = await page.locator('.variants tbody tr').nth(1).locator('th small').allTextContents();
    assert.ok(told.includes('Left zygomaticus major at 30 %'), told.join('; '));
    await close();
  });

  test('a group whose activation is mostly the prior’s choice says so, and on which side', { skip: Boolean(given) }, async () => {
    const note = "mostly the prior's choice";
    const said = async (right, left) => {
      const file = await madeUp(({ muscles }) => {
        for (const group of muscles.groups) [group.note_right, group.note_left] = [right, left];
      });
      const { page, close } = await openPage(browser, file);
      const text = await card(page).textContent();
      await close();
      return text;
    };
    assert.ok((await said(note, note)).includes(`On both sides it is ${note}.`));
    assert.ok((await said(note, '')).includes(`On the right it is ${note}.`));
    assert.ok((await said('', note)).includes(`On the left it is ${note}.`));
    assert.ok(!(await said('', '')).includes('choice'));
  });

  for (const colorScheme of ['light', 'dark'])
    test(`curves a side and lines over the face, ${colorScheme}`, async () => {
      const { page, complaints, close } = await openPage(browser, report, { colorScheme, pixels: true });
      const { groups, few_points: few } = (await readPage(report)).data.muscles;
      const pull = ({ left, right }) => Math.max(...left, ...right);
      const order = [...groups].sort((a, b) => pull(b) - pull(a));
      const options = await card(page).locator('option').allTextContents();
      assert.equal(options.length, groups.length);
      order.forEach(({ name, left, right }, i) =>
        assert.equal(options[i].toLowerCase(), `${name} (right ${extreme(right)}, left ${extreme(left)})`.toLowerCase()));
      const shows = async ({ left, right }) => {
        const { time_s: timeS } = (await readPage(report)).data.muscles;
        const frame = Number(await page.locator('#frame').inputValue());
        const at = (await readPage(report)).data.motion.time_s[frame];
        const nearest = timeS.reduce((best, t, k) => (Math.abs(t - at) < Math.abs(timeS[best] - at) ? k : best), 0);
        const texts = await card(page).locator('.u-series .u-value').allTextContents();
        assert.deepEqual(
          texts.slice(-2).map((t) => Number(t.replace('\u2212', '-'))),
          [right, left].map((values) => Number(values[nearest].toFixed(2))));
      };
      await shows(order[0]);
      assert.deepEqual(await card(page).locator('.u-series button').allTextContents(), ['right', 'left']);
      assert.equal((await card(page).textContent()).includes('not a measurement'), few);
      assert.ok((await card(page).textContent()).includes('Of base'));
      await card(page).locator('select').selectOption('1');
      await shows(order[1]);
      const without = await look(page);
      const tick = async () => {
        await page.locator('#show-overlays').click();
        await page.locator('[data-overlay="muscles"]').click();
        await page.keyboard.press('Escape');
      };
      await tick();
      await page.waitForSelector('#face[data-at-rest="true"]');
      const shown = await look(page);
      assert.ok((await changedShare(without, shown)) > 0.0005, 'the lines show');
      if (pictures) {
        await page.screenshot({ path: join(pictures, `muscles_${colorScheme}.png`) });
        await card(page).locator('select').selectOption('0');
        await card(page).screenshot({ path: join(pictures, `muscle_card_${colorScheme}.png`) });
      }
      await tick();
      assert.equal(await tooWide(page), 0);
      assert.deepEqual(complaints, []);
      await close();
    });

  test('a line is pale where the activation may be 0, in the nearest sample of the face shown', async () => {
    const { activeLines } = await imported('replay/face/active_muscles.ts');
    const line = (name) => ({ name, latin: name, points: [] });
    const muscles = { timeS: [0, 1, 2], fewPoints: true, groups: [], lines: [line('a_L'), line('a_R'), line('graft_L')] };
    const face = { activeMuscles: ['010', '001', ''] };
    const frames = [0, 0.5, 1, 1.5, 2];
    assert.deepEqual(activeLines(muscles, face, frames, 0), [false, false, true], 'what is not known is not pale');
    assert.deepEqual(activeLines(muscles, face, frames, 2), [true, false, true]);
    assert.deepEqual(activeLines(muscles, face, frames, 2.8), [true, false, true], 'at 1.4 s');
    assert.deepEqual(activeLines(muscles, face, frames, 3.2), [false, true, true], 'at 1.6 s');
    assert.deepEqual(activeLines(muscles, { activeMuscles: [] }, frames, 2), [true, true, true]);
  });

  test('pale and full lines look different, and the layer says what they mean', { skip: Boolean(given) }, async () => {
    /** How many pixels are near magenta, with much more red and blue than green. */
    const magenta = async (active) => {
      const file = await madeUp(({ muscles, variants }) => {
        muscles.active = muscles.lines.map(() => active.repeat(muscles.time_s.length));
        for (const variant of variants) variant.active_muscles = muscles.active;
      });
      const { page, complaints, close } = await openPage(browser, file, { pixels: true });
      await page.locator('#show-overlays').click();
      const box = page.locator('[data-overlay="muscles"]');
      await box.click();
      assert.match(await page.locator('label', { has: box }).textContent(), /Pale: may be at rest\. Full colour: .*95 %/);
      await page.keyboard.press('Escape');
      const count = await (await look(page)).evaluate(({ data }) => {
        let found = 0;
        for (let i = 0; i < data.length; i += 4) if (Math.min(data[i], data[i + 2]) - data[i + 1] > 80) ++found;
        return found;
      });
      assert.deepEqual(complaints, []);
      await close();
      return count;
    };
    const [full, pale] = [await magenta('1'), await magenta('0')];
    assert.ok(full > 100 && pale < 0.1 * full, `${full} and ${pale}`);
  });

  test('a muscle that ends along the fold has a sheet, too', { skip: Boolean(given) }, async () => {
    /** Share of the picture that the layer changes. */
    const covered = async (spread) => {
      const file = await madeUp(({ muscles: { lines } }) => {
        const [tip, z] = [lines[0].points[0], lines[0].points[0][2]];
        if (spread) lines[0].sheet = [tip, [0.005, -0.01, z], [0.02, -0.02, z], [0.03, -0.03, z]];
      });
      const { page, complaints, close } = await openPage(browser, file, { pixels: true });
      const without = await look(page);
      await page.locator('#show-overlays').click();
      await page.locator('[data-overlay="muscles"]').click();
      await page.keyboard.press('Escape');
      const share = await changedShare(without, await look(page));
      assert.deepEqual(complaints, []);
      await close();
      return share;
    };
    const [lines, both] = [await covered(false), await covered(true)];
    assert.ok(both > 1.5 * lines, `${lines} and ${both}`);
  });

  test('curves of a variant, and of two faces', async () => {
    const { page, complaints, close } = await openPage(browser, report);
    const { data } = await readPage(report);
    const { groups } = data.muscles;
    const pull = ({ left, right }) => Math.max(...left, ...right);
    const first = groups.indexOf([...groups].sort((a, b) => pull(b) - pull(a))[0]);
    await page.keyboard.press('p');
    const shownValues = async () => (await card(page).locator('.u-series .u-value').allTextContents())
      .slice(1).map((t) => Number(t.replace('\u2212', '-')));
    const frame = Number(await page.locator('#frame').inputValue());
    const at = data.motion.time_s[frame];
    const k = data.muscles.time_s.reduce((best, t, i) => (Math.abs(t - at) < Math.abs(data.muscles.time_s[best] - at) ? i : best), 0);
    const valuesOf = ({ left, right }) => [right[k], left[k]].map((v) => Number(v.toFixed(2)));
    assert.deepEqual(await shownValues(), valuesOf(groups[first]));
    await page.locator('.variant-lines .face-name').first().click();
    assert.deepEqual(await shownValues(), valuesOf(data.variants[0].muscles[first]));
    assert.ok((await card(page).textContent()).includes(data.variants[0].name));
    assert.deepEqual(complaints, []);
    await close();
  });

  test('one corner of the mouth in all variants', async () => {
    const { page, complaints, close } = await openPage(browser, report);
    const { data } = await readPage(report);
    const corner = page.locator('.plot-card').filter({ has: page.getByRole('heading', { name: 'A corner of the mouth in all variants', exact: true }) });
    assert.equal(await corner.locator('.u-series button').count(), 1 + data.variants.length);
    const side = await corner.locator('select').inputValue();
    const other = side === 'left' ? 'right' : 'left';
    const values = () => corner.locator('.u-series .u-value').allTextContents();
    await page.keyboard.press('p');
    assert.ok((await corner.textContent()).includes(`the ${side} corner`));
    const before = await values();
    await corner.locator('select').selectOption(other);
    assert.ok((await corner.textContent()).includes(`the ${other} corner`));
    assert.notDeepEqual(await values(), before);
    if (pictures) await corner.screenshot({ path: join(pictures, 'corner_card.png') });
    assert.deepEqual(complaints, []);
    await close();
  });

  test('a narrow window is not made wider', async () => {
    const { page, close } = await openPage(browser, report, { viewport: { width: 360, height: 800 } });
    assert.equal(await tooWide(page), 0);
    await close();
  });

  test('without muscles there is neither card nor layer', { skip: Boolean(given) }, async () => {
    const { page, close } = await openPage(browser, fixture('variants.html'));
    assert.equal(await card(page).count(), 0);
    assert.equal(await page.locator('[data-overlay="muscles"]').count(), 0);
    await close();
  });
});
