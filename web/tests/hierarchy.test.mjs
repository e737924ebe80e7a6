// SPDX-License-Identifier: GPL-3.0-or-later
// The page around the face: the face first, then the question and its answer, all else one step away; by keys, under
// a finger, and with no more than is needed.
//   SCREENSHOTS=/tmp/pictures node --test web/tests/hierarchy.test.mjs
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { launch, openPage, tooWide } from './browser.mjs';
import { fixture } from './fixtures.mjs';
import { openMadeUp } from './made_up_studio.mjs';
import { imported } from './modules.mjs';
import { askWhatIf } from './studio_server.mjs';

const report = () => fixture('variants.html');
const laptop = { viewport: { width: 1280, height: 720 } };
const desk = { viewport: { width: 1440, height: 900 } };
const phone = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };
const tablet = { viewport: { width: 1024, height: 768 }, hasTouch: true, isMobile: true };

let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

/** What is not wholly in the window, and not wholly there without scrolling anything. */
const outside = (page, selectors) => page.evaluate((all) => all.flatMap((selector) => {
  const found = document.querySelector(selector);
  const box = found?.getBoundingClientRect();
  if (!box || box.width === 0 || box.height === 0) return [`${selector} is not there`];
  let [top, bottom] = [0, innerHeight];
  for (let holder = found.parentElement; holder; holder = holder.parentElement) {
    if (getComputedStyle(holder).overflowY === 'visible' || holder === document.documentElement || holder === document.body) continue;
    const around = holder.getBoundingClientRect();
    [top, bottom] = [Math.max(top, around.top), Math.min(bottom, around.bottom)];
  }
  const inside = box.top >= top - 0.5 && box.bottom <= bottom + 0.5 && box.left >= 0 && box.right <= innerWidth + 0.5;
  return inside ? [] : [`${selector}: ${box.top.toFixed(0)} to ${box.bottom.toFixed(0)} of ${top.toFixed(0)} to ${bottom.toFixed(0)}`];
}), selectors);

const faceShare = (page) => page.locator('#canvas-host').evaluate((host) => (host.clientWidth * host.clientHeight) / (innerWidth * innerHeight));

/** The made-up studio with one what-if variant. */
async function asked(options = {}) {
  const studio = await openMadeUp(browser, () => [], options);
  await askWhatIf(studio.page, 'right side 30');
  await studio.page.waitForFunction(() => document.querySelector('.answer-side[data-side=right] .change'));
  return studio;
}

describe('the studio', { concurrency: false }, () => {
  const first = ['#face', '#question-title', '[data-question=side_R] .change-chip', '[data-question=side_R] input[type=number]',
    '[data-question=side_R] input[type=range]', '.answer-side[data-side=right] .answer-mm', '.answer-side[data-side=left] .answer-mm',
    '.answer-side[data-side=right] .change', '.answer-apart', '#play', '#frame', '#what-if'];
  for (const [name, options] of [['1280 x 720', laptop], ['a tablet', tablet], ['a telephone', phone]])
    test(`shows face, question and answer without scrolling: ${name}`, async () => {
      const { page, complaints, close } = await asked(options);
      assert.deepEqual(await outside(page, first), []);
      assert.match(await page.locator('.answer-side[data-side=right] .answer-mm').textContent(), /^\d+\.\d mm$/);
      assert.match(await page.locator('.answer-apart').textContent(), /^Sides /);
      assert.ok((await tooWide(page)) <= 0);
      assert.deepEqual(complaints, []);
      await close();
    });

  test('gives the face at least 45 % of the window', async () => {
    const { page, close } = await asked(desk);
    assert.ok((await faceShare(page)) >= 0.45, `${await faceShare(page)}`);
    await page.click('#fold-side');
    await page.waitForFunction(() => document.getElementById('canvas-host').clientWidth === innerWidth);
    assert.equal(await page.locator('#fold-side').getAttribute('aria-expanded'), 'false');
    await page.reload();
    await page.waitForSelector('html[data-ready]');
    assert.equal(await page.locator('#side').isVisible(), false, 'as it was left');
    await close();
  });

  test('asks by keys alone: found, its strength typed, changed, added to and taken back', async () => {
    const { page, session, complaints, close } = await openMadeUp(browser, () => [], laptop);
    await page.keyboard.press('n');
    const find = page.getByRole('combobox', { name: /Find a side/ });
    await find.waitFor();
    assert.ok(await find.evaluate((field) => field === document.activeElement), 'the field has the focus');
    const active = () => find.evaluate((field) => document.getElementById(field.getAttribute('aria-activedescendant')).dataset.choice);
    assert.equal(await active(), 'side_R');
    await page.keyboard.press('ArrowDown');
    assert.equal(await active(), 'side_L');
    await page.keyboard.type('zygomatic branch right 30');
    assert.deepEqual(await page.locator('.sheet:popover-open [role=option]').allInnerTexts().then((all) => all.map((text) => text.replace(/\s+/g, ' '))), ['Zygomatic branch, right at 30 %']);
    await page.keyboard.press('Enter');
    const chip = page.locator('[data-question=zygomatic_R] .change-chip');
    await chip.waitFor();
    assert.equal(await chip.innerText(), 'right zygomatic branch');
    const gains = () => session().faces[1].values['muscles.gain'];
    const until = async (wanted) => {
      for (let tries = 0; tries < 100 && JSON.stringify(gains()) !== JSON.stringify(wanted); ++tries) await page.waitForTimeout(50);
      assert.deepEqual(gains(), wanted);
    };
    await until({ zygomatic_R: 0.3 });
    await chip.focus();
    await page.keyboard.press('Enter');
    await page.keyboard.type('temporal left');
    await page.keyboard.press('Enter');
    await until({ temporal_L: 0.3 });
    await page.locator('.add-change').focus();
    await page.keyboard.press('Enter');
    await page.keyboard.type('left side 80');
    await page.keyboard.press('Enter');
    await until({ temporal_L: 0.3, side_L: 0.8 });
    const strength = page.getByRole('spinbutton', { name: 'Strength of left side, %' });
    await strength.fill('60');
    await page.keyboard.press('Enter');
    await until({ temporal_L: 0.3, side_L: 0.6 });
    await page.getByRole('button', { name: 'Reset Strength of left side' }).focus();
    await page.keyboard.press('Enter');
    await until({ temporal_L: 0.3 });
    await page.keyboard.press('n');
    await find.waitFor();
    await page.keyboard.type('nothing of the kind');
    assert.equal(await page.locator('.sheet:popover-open [role=option]').count(), 0);
    await page.keyboard.press('Escape');
    assert.equal(await find.isVisible(), false, 'Escape closes it at once');
    assert.deepEqual(complaints, []);
    await close();
  });

  test('messages take no room where there are none; a warning is counted and shown', async () => {
    const quiet = await openMadeUp(browser, () => [], laptop);
    const height = (page) => page.evaluate(() => ['messages-panel', 'open-messages'].map((id) => document.getElementById(id).getBoundingClientRect().height));
    assert.deepEqual(await height(quiet.page), [0, 0]);
    await quiet.close();
    const { page, close } = await openMadeUp(browser, () => [{ id: 'lips.pass_through', severity: 'warning', text: 'lips pass', key: '', variant: '' }], laptop);
    const opener = page.getByRole('button', { name: '1 message, with warnings' });
    assert.equal(await opener.innerText(), '1');
    assert.match(await page.locator('#message-news').textContent(), /lips pass/);
    assert.equal(await page.locator('#message-news').getAttribute('role'), 'status', 'announced politely');
    assert.equal(await page.locator('#messages-panel').isVisible(), false);
    await opener.click();
    assert.deepEqual(await page.locator('#messages-panel li').allInnerTexts(), ['lips pass']);
    await page.keyboard.press('Escape');
    assert.equal(await page.locator('#messages-panel').isVisible(), false);
    await close();
  });

  test('a file over the window: where it goes is said until it leaves, is dropped, or Escape', async () => {
    const { page, close } = await openMadeUp(browser, () => [], laptop);
    const over = page.locator('#drop-over');
    const drag = (type, kind = 'Files') => page.evaluate(([what, types]) => {
      const event = new DragEvent(what, { bubbles: true, cancelable: true });
      Object.defineProperty(event, 'dataTransfer', { value: { types: [types], files: [] } });
      document.getElementById('face').dispatchEvent(event);
    }, [type, kind]);
    await drag('dragover', 'text/plain');
    assert.equal(await over.isVisible(), false, 'text is no file');
    for (const end of [() => drag('dragleave'), () => drag('drop'), () => page.keyboard.press('Escape')]) {
      await drag('dragover');
      assert.ok(await over.isVisible());
      assert.match(await over.textContent(), /scan.*scene.*recording.*ZIP/);
      const [box, window] = [await over.boundingBox(), page.viewportSize()];
      assert.ok(box.width > 0.9 * window.width && box.height > 0.9 * window.height);
      await end();
      assert.equal(await over.isVisible(), false);
    }
    await close();
  });

  test('undo and redo are pictures with names; files, panel and folds are as they were left', async () => {
    const { page, close } = await openMadeUp(browser, () => [], laptop);
    for (const name of ['Undo', 'Redo']) {
      const made = page.getByRole('button', { name, exact: true });
      assert.match(await made.getAttribute('title'), /Ctrl (Shift )?Z/);
      const { picture, width, height } = await made.evaluate((one) => {
        const style = getComputedStyle(one, '::before');
        const box = one.getBoundingClientRect();
        return { picture: style.maskImage || style.webkitMaskImage, width: box.width, height: box.height };
      });
      assert.match(picture, /svg/);
      assert.ok(width === height && width <= 32, `${width} x ${height}: no word`);
    }
    assert.equal(await page.locator('#files').isVisible(), false);
    await page.click('#open-files');
    await page.click('#tab-tissue');
    await page.locator('#files').waitFor();
    await page.reload();
    await page.waitForSelector('html[data-ready]');
    assert.ok(await page.locator('#files').isVisible());
    assert.equal(await page.locator('#tab-tissue').getAttribute('aria-selected'), 'true');
    await page.locator('#files button').first().focus();
    await page.keyboard.press('Escape');
    assert.equal(await page.locator('#files').isVisible(), false);
    assert.ok(await page.locator('#open-files').evaluate((one) => one === document.activeElement));
    await close();
  });

  test('a finger on the face turns it, and the page does not scroll', async () => {
    const { page, close } = await asked(phone);
    const { x, y, width, height } = await page.locator('#face').boundingBox();
    await page.waitForSelector('#face[data-at-rest="true"]');
    const before = await page.locator('#face').screenshot();
    const touch = await page.context().newCDPSession(page);
    const finger = (type, i) => touch.send('Input.dispatchTouchEvent', {
      type, touchPoints: type === 'touchEnd' ? [] : [{ x: x + 0.25 * width + 8 * i, y: y + 0.5 * height - 10 * i }],
    });
    await finger('touchStart', 0);
    for (let i = 1; i <= 5; ++i) await finger('touchMove', i);
    await finger('touchEnd');
    await page.waitForSelector('#face[data-at-rest="true"]');
    assert.equal(await page.evaluate(() => scrollY), 0);
    assert.ok(!before.equals(await page.locator('#face').screenshot()), 'turned');
    // What is scrolled passes below the face.
    await page.evaluate(() => scrollTo(0, 600));
    const face = await page.locator('#face').boundingBox();
    assert.ok(face.y >= 0 && face.y + face.height < 844, `the face stays at ${face.y}`);
    // Landmarks are corrected on the face: the files do not cover it.
    await page.locator('#open-files').click();
    const [files, stage] = [await page.locator('#files').boundingBox(), await page.locator('.stage').boundingBox()];
    assert.ok(files.y >= stage.y + stage.height - 1 && files.y < 844, `files at ${files.y}, the face above ${stage.y + stage.height}`);
    await close();
  });

  test('hints that rest on a pointer stand below where none can rest', async () => {
    for (const [options, seen] of [[laptop, false], [tablet, true]]) {
      const { page, close } = await openMadeUp(browser, () => [], options);
      await page.click('#tab-tissue');
      assert.equal(await page.locator('[data-key="tissue.young_kpa"] .hint').isVisible(), seen);
      await close();
    }
  });
});

describe('the report', { concurrency: false }, () => {
  for (const [name, options] of [['1280 x 720', laptop], ['1440 x 900', desk]])
    test(`shows face, variant, answer and what moves it: ${name}`, async () => {
      const { page, close } = await openPage(browser, report(), options);
      await page.keyboard.press('2');
      assert.deepEqual(await outside(page, ['#face', '#chips [aria-pressed=true]', '.corners .asked', '#headline', '.answers', '#play', '#frame', '#to-peak', '#colouring', '#views']), []);
      assert.match(await page.locator('.corners .asked').textContent(), /^What if: .+\?$/);
      assert.ok((await faceShare(page)) >= 0.45, `${await faceShare(page)}`);
      assert.ok((await tooWide(page)) <= 0);
      await close();
    });

  test('stands at its peak where the processor draws, and plays when it is asked to', async () => {
    const { page, close } = await openPage(browser, report(), { ...laptop, reducedMotion: 'no-preference' });
    await page.waitForSelector('#face[data-at-rest="true"]');
    const label = await page.locator('#frame-label').textContent();
    assert.notEqual(await page.locator('#frame').inputValue(), '0');
    await page.waitForTimeout(400);
    assert.equal(await page.locator('#frame-label').textContent(), label);
    assert.equal(await page.locator('#play').getAttribute('aria-label'), 'Play');
    await page.locator('#play').click();
    await page.waitForFunction((before) => document.getElementById('frame-label').textContent !== before, label);
    await close();
  });
});

test('one scale of letters: no style sheet has another size', () => {
  const source = fileURLToPath(new URL('../src', import.meta.url));
  const sheets = readdirSync(source, { recursive: true }).filter((name) => name.endsWith('.css'));
  assert.ok(sheets.length >= 7, sheets.join(', '));
  for (const name of sheets)
    for (const [, size] of readFileSync(join(source, name), 'utf8').matchAll(/[{;]\s*font-size:\s*([^;}!]+)/g))
      if (!/^(var\(--t-(xs|s|m|l|xl)\)|inherit|18px|22px)\s*$/.test(size)) assert.fail(`${name}: font-size: ${size}`);
});

test('one word for stiffness', async () => {
  const { words } = await imported('studio/words.ts');
  const all = JSON.stringify(words, (_key, value) => (typeof value === 'function' ? String(value) : value));
  assert.doesNotMatch(all.replace(/Multiplies Young’s modulus/g, ''), /Young|modulus/);
  for (const key of ['regionStiffness', 'paintStiffness']) assert.match(words[key], /^Stiffness/);
  assert.equal(words.keyNames['tissue.young_kpa'], 'Stiffness');
});

test('a number at the end of what is typed is an amount, in a preset’s name it is not', async () => {
  const { matching, readQuery } = await imported('studio/chooser.ts');
  const choice = (text, amount) => ({ group: 'g', value: text, text, detail: '', amount, take: () => {} });
  const amount = (unit, most) => ({ unit, usual: 1, bounds: { low: unit === '%' ? 0 : -most, high: most, above: false } });
  const all = [
    choice('Right side', amount('%', 200)), choice('Source model 2'), choice('Lower jaw', amount('mm', 30)),
    choice('Cheek, left', amount('ml', 30)),
  ];
  const found = (typed) => matching(all, typed).map(({ text }) => text);
  assert.deepEqual(found('model 2'), ['Source model 2']);
  assert.deepEqual(found('side right 30 %'), ['Right side']);
  assert.deepEqual(found('lower jaw 6 mm'), ['Lower jaw']);
  assert.deepEqual(found('left cheek 2,5 ml'), ['Cheek, left']);
  assert.deepEqual(found('Cheek, left 2 ml'), ['Cheek, left'], 'as the list writes it');
  assert.deepEqual(found('left cheek 40 ml'), [], 'more than may be');
  assert.deepEqual(found('left cheek 0 ml'), [], 'no change');
  assert.deepEqual(found('lower jaw -4 mm'), ['Lower jaw']);
  assert.equal(readQuery('lower jaw -4 mm').amount, -4);
  assert.deepEqual(found('right side -4'), []);
  assert.deepEqual(found('left cheek 2 mm'), [], 'another unit');
  assert.deepEqual(found('20'), ['Right side', 'Lower jaw', 'Cheek, left']);
  assert.deepEqual(found('100%'), ['Right side']);
  assert.equal(readQuery('side right 30').amount, 30);
  assert.equal(readQuery('cheek 1.5 ml').amount, 1.5);
  assert.equal(readQuery('side right 3000').amount, null);
  assert.equal(readQuery('side').amount, null);
});
