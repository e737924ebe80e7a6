// SPDX-License-Identifier: GPL-3.0-or-later
// Opens the page of a tracking in Chromium as a user would, from the disk, and uses it.
//   TRACKING=out/tracking.html SCREENSHOTS=/tmp/pictures node --test web/tests/tracking.test.mjs
// Without TRACKING it takes those of a made-up face that write_report_fixtures wrote.
import assert from 'node:assert/strict';
import { basename, join, resolve } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { launch, openPage, tooWide } from './browser.mjs';
import { a4 } from './paper.mjs';
import { fixture } from './fixtures.mjs';

const files = process.env.TRACKING
  ? [resolve(process.env.TRACKING)]
  : ['tracking.html', 'tracking_colour_only.html'].map(fixture);
const pictures = process.env.SCREENSHOTS;

let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

/** The data as they stand in the page, read here by other code than the page's. */
async function dataOf(page) {
  const [manifest, base64] = await page.evaluate(() =>
    ['hyperex-manifest', 'hyperex-binary'].map((id) => document.getElementById(id).textContent));
  const data = JSON.parse(manifest);
  const bytes = Buffer.from(base64, 'base64');
  const value = (group, name, frame) => {
    const channel = data.channels.find((c) => c.group === group && c.name === name);
    const step = bytes.readInt16LE(channel.values.offset + 2 * frame);
    return step === -32768 ? null : step * channel.step;
  };
  return { ...data, value };
}

const card = (page, title) => page.locator('.plot-card').filter({ has: page.getByRole('heading', { name: title, exact: true }) });
const shownFrame = (page) => page.locator('#frame').inputValue().then(Number);

/** What a chart's legend says of a curve, as a number; null for a dash. */
async function legend(page, title, label) {
  const row = card(page, title).locator('.u-series').filter({ hasText: label });
  const text = await row.locator('.u-value').textContent();
  return text === '–' ? null : Number.parseFloat(text.replace('−', '-'));
}

for (const file of files) {
  describe(basename(file), () => {
    let page, complaints, close, data;
    before(async () => {
      ({ page, complaints, close } = await openPage(browser, file));
      data = await dataOf(page);
    });
    after(() => close?.());

    test('says what was tracked, how, and what it is not', async () => {
      assert.equal(await page.locator('h1').textContent(), `Tracking of ${data.recording}`);
      const facts = await page.locator('#facts').textContent();
      assert.ok(facts.startsWith(`${data.frames.toLocaleString('en')} frames over `), facts);
      assert.ok(facts.includes(data.valid === data.frames ? 'all valid' : `${data.valid.toLocaleString('en')} valid`), facts);
      assert.match(facts, /frames a second/);
      assert.ok(facts.includes(`the ${data.model.name} face model`), facts);
      if (data.metric) assert.match(facts, /metric/);
      else assert.ok(facts.includes(`stated distance of ${data.eye_distance_mm} mm`), facts);
      assert.match(await page.locator('#caveat').textContent(), /no medical device/);
    });

    test('every chart has its unit, and a picture that is not blank', async () => {
      const pictures = page.locator('.plot-card canvas');
      assert.ok((await pictures.count()) >= 8);
      for (const picture of await pictures.all()) {
        assert.match(await picture.getAttribute('aria-label'), /\((mm|°|px|%|1 = full)\)/);
        const colours = await picture.evaluate((c) => {
          const { data } = c.getContext('2d').getImageData(0, 0, c.width, c.height);
          return new Set(new Uint32Array(data.buffer)).size;
        });
        assert.ok(colours > 5, `${colours} colours`);
      }
      assert.equal(await card(page, 'Depth').count(), data.metric ? 1 : 0);
    });

    test('the first frame is shown from the start', async () => {
      assert.equal(await legend(page, 'Turn', 'yaw'), data.value('turn', 'yaw', 0));
      assert.equal(await legend(page, 'Mouth width', 'width'), Number(data.value('distance', 'mouth width', 0).toFixed(2)));
    });

    test('arrow keys step the frame; all cursors and figures follow', async () => {
      await page.locator('h1').click();
      await page.locator('#frame').fill('29');
      await page.locator('#frame').blur();
      await page.keyboard.press('ArrowRight');
      assert.equal(await shownFrame(page), 30);
      assert.match(await page.locator('#frame-label').textContent(), /^frame 30\b/);
      assert.equal(await legend(page, 'Turn', 'yaw'), Number(data.value('turn', 'yaw', 30).toFixed(2)));
      assert.equal(await legend(page, 'Mouth opening', 'opening'), Number(data.value('distance', 'mouth opening', 30).toFixed(2)));
      const share = data.time_s[30] / data.time_s.at(-1);
      const places = await page.locator('.now').evaluateAll((all) => all.map((now) => {
        const over = now.parentElement.getBoundingClientRect();
        return (now.getBoundingClientRect().x + 1 - over.x) / over.width;
      }));
      for (const place of places) assert.ok(Math.abs(place - share) < 0.01, `${place} is not ${share}`);
      await page.keyboard.press('Shift+ArrowRight');
      await page.keyboard.press('ArrowLeft');
      assert.equal(await shownFrame(page), 39);
      await page.locator('#frame').press('ArrowRight');
      assert.equal(await shownFrame(page), 40, 'one frame, also where the slider has the focus');
    });

    test('pressing on a plot seeks', async () => {
      const over = card(page, 'Turn').locator('.u-over');
      await over.scrollIntoViewIfNeeded();
      const box = await over.boundingBox();
      await page.mouse.click(box.x + 0.7 * box.width, box.y + 0.5 * box.height);
      const wanted = 0.7 * (data.time_s.length - 1);
      assert.ok(Math.abs((await shownFrame(page)) - wanted) <= 0.005 * data.time_s.length + 1);
    });

    test('a frame that is not valid is shaded and stated', async (t) => {
      if (data.faults.length === 0) return t.skip('all frames are valid');
      const [{ first, fault }] = data.faults;
      await page.getByRole('button', { name: fault }).first().click();
      assert.equal(await shownFrame(page), first);
      assert.ok((await page.locator('#frame-label').textContent()).includes(fault));
      assert.equal(await legend(page, 'Turn', 'yaw'), null);
      // Share of the row just under the plot's top that is not blank, between two times.
      const filled = (from, to) => card(page, 'Turn').evaluate((host, [a, b]) => {
        const canvas = host.querySelector('canvas');
        const [box, over] = [canvas, host.querySelector('.u-over')].map((e) => e.getBoundingClientRect());
        const scale = canvas.width / box.width;
        const x = Math.ceil((over.x - box.x + a * over.width) * scale);
        const width = Math.max(Math.floor((over.x - box.x + b * over.width) * scale) - x, 1);
        const row = canvas.getContext('2d').getImageData(x, Math.round((over.y - box.y + 3) * scale), width, 1).data;
        return row.filter((v, i) => i % 4 === 3 && v > 0).length / width;
      }, [from / data.time_s.at(-1), to / data.time_s.at(-1)]);
      const { last } = data.faults[0];
      assert.ok(await filled(data.time_s[first], data.time_s[last]) > 0.9, 'shaded there');
      assert.ok(await filled(0, data.time_s[first - 1]) < 0.5, 'not before');
    });

    test('units come and go', async () => {
      const chooser = page.locator('.chooser');
      await chooser.locator('summary').click();
      const count = () => card(page, /·/).count();
      const atFirst = await count();
      assert.ok(atFirst >= 3);
      await chooser.getByRole('searchbox').fill('puff');
      const box = chooser.getByRole('checkbox');
      assert.equal(await box.and(page.locator(':visible')).count(), 1);
      assert.equal(await box.and(page.locator(':visible')).isChecked(), false);
      await box.and(page.locator(':visible')).check();
      assert.equal(await count(), atFirst + 1);
      assert.equal(await card(page, 'Cheek puff · AU34 puff').count(), 1);
      await page.locator('#frame').fill('33');
      assert.equal(await legend(page, 'Cheek puff · AU34 puff', 'left'), Number(data.value('unit', 'cheekPuff_L', 33).toFixed(3)));
      await chooser.getByRole('button', { name: 'None' }).click();
      assert.equal(await count(), 0);
      await chooser.getByRole('button', { name: 'All', exact: true }).click();
      assert.match(await chooser.locator('summary').textContent(), /38 of 38/);
      await chooser.getByRole('button', { name: 'Those that move' }).click();
      assert.equal(await count(), atFirst);
      await chooser.getByRole('searchbox').fill('');
      await chooser.locator('summary').click();
    });

    test('a shorter stretch of time is shown around the frame', async () => {
      await page.locator('#frame').fill('30');
      await page.locator('#frame').blur();
      const cursor = () => card(page, 'Turn').locator('.now').evaluate((now) => {
        const over = now.parentElement.getBoundingClientRect();
        return (now.getBoundingClientRect().x + 1 - over.x) / over.width;
      });
      const before = await cursor();
      for (let i = 0; i < 2; ++i) await page.keyboard.press('+');
      const inside = await cursor();
      assert.ok(inside > before + 0.02, `${before} to ${inside}`);
      await page.locator('#frame').fill(String(data.time_s.length - 1));
      assert.ok(await cursor() > 0.9, 'the stretch goes along with the frame');
      await page.keyboard.press('0');
      await page.locator('#frame').fill('30');
      assert.ok(Math.abs((await cursor()) - before) < 0.01);
    });

    test('is ready soon', async (t) => {
      const ms = Number(await page.locator('html').getAttribute('data-ready-ms'));
      t.diagnostic(`${data.time_s.length} frames are drawn after ${ms} ms`);
      assert.ok(ms < 3000, `${ms} ms; a quiet machine takes a tenth`);
    });

    test('says nothing on the console and asks nothing of the network', () => {
      assert.deepEqual(complaints, []);
    });

    for (const [name, options] of [
      ['light', {}],
      ['dark', { colorScheme: 'dark' }],
      ['narrow', { viewport: { width: 400, height: 840 }, hasTouch: true, isMobile: true }],
    ]) {
      test(`fits the window (${name})`, async () => {
        const view = await openPage(browser, file, options);
        const wide = await tooWide(view.page);
        assert.ok(wide <= 0, `${wide} px too wide`);
        if (pictures)
          await view.page.screenshot({ path: join(pictures, `${basename(file, '.html')}_${name}.png`), fullPage: true });
        assert.deepEqual(view.complaints, []);
        await view.close();
      });
    }

    test('is printed in light colours, as wide as the paper', async () => {
      const view = await openPage(browser, file, { colorScheme: 'dark' });
      await view.page.evaluate(() => window.dispatchEvent(new Event('beforeprint')));
      await view.page.waitForTimeout(100);
      const widths = await view.page.locator('.plot-card canvas').evaluateAll((all) => all.map((c) => c.getBoundingClientRect().width));
      assert.ok(Math.max(...widths) <= a4.width && Math.min(...widths) > 0.95 * a4.width, String(widths));
      const paper = await view.page.evaluate(() => getComputedStyle(document.documentElement).getPropertyValue('--card').trim());
      assert.equal(paper, '#fff');
      await view.page.evaluate(() => window.dispatchEvent(new Event('afterprint')));
      assert.equal(await view.page.locator('html').getAttribute('class'), '');
      await view.close();
    });
  });
}
