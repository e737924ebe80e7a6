// SPDX-License-Identifier: GPL-3.0-or-later
// A report of several faces, used in Chromium as a reader would: choosing, comparing, colouring, saving.
//   REPORT=out/variants/report.html SCREENSHOTS=/tmp/pictures node --test web/tests/report_variants.test.mjs
// Without REPORT it takes the one of a made-up face with variants that write_report_fixtures wrote.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { join, resolve } from 'node:path';
import { after, before, beforeEach, describe, test } from 'node:test';
import { launch, openPage, tooWide } from './browser.mjs';
import { fixture } from './fixtures.mjs';
import { readPage } from './page_data.mjs';
import { changedShare, colourfulShare, decode, distinctColours, halvesDiffer, look } from './pixels.mjs';

const report = process.env.REPORT ? resolve(process.env.REPORT) : fixture('variants.html');
const pictures = process.env.SCREENSHOTS;

let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

const drawn = (page, faces) => page.waitForSelector(`#face[data-faces="${faces}"][data-at-rest="true"]`);
const pressed = (page, group) =>
  page.locator(`#${group} [aria-pressed="true"]`).evaluateAll((all) => all.map((e) => e.textContent));
const wipeAt = (page) => page.locator('#wipe').getAttribute('aria-valuenow').then(Number);

/** The page at the frame of most motion, with one face. */
async function open(options = {}) {
  const view = await openPage(browser, report, options);
  await view.page.keyboard.press('p');
  await drawn(view.page, '0');
  return view;
}

describe('a report with variants', () => {
  let page, complaints, close, count, data;
  before(async () => {
    ({ page, complaints, close } = await open({ viewport: { width: 1360, height: 700 } }));
    ({ data } = await readPage(report));
    count = await page.locator('#chips button').count();
    // Halves of the stage compare where what is behind the faces is the same.
    await page.addStyleTag({ content: '#canvas-host { background: #808080; }' });
  });
  after(() => close?.());
  // Base alone, from the front, where it moves most.
  beforeEach(async () => {
    await page.getByRole('button', { name: 'One face' }).click();
    await page.locator('#chips button').first().click();
    await page.getByRole('button', { name: 'Displacement', exact: true }).click();
    await page.getByRole('button', { name: 'Front', exact: true }).click();
    await page.locator('#to-peak').click();
    await drawn(page, '0');
  });

  // How long is printed, not judged: another program may have the processors.
  test('a page of five variants gets ready', async () => {
    assert.ok(count >= 5, `${count} faces`);
    const view = await openPage(browser, report);
    console.log(`ready after ${view.readyMs.toFixed(0)} ms`);
    await view.close();
  });

  test('shows the face that is chosen, by button, by key and at its name', async () => {
    assert.deepEqual(await pressed(page, 'chips'), ['base']);
    const itself = await look(page);
    await page.locator('#chips button').nth(1).click();
    await drawn(page, '1');
    const [name] = await pressed(page, 'chips');
    assert.equal(await page.getByLabel('Face', { exact: true }).locator('option:checked').textContent(), name);
    assert.ok(await changedShare(itself, await look(page), { top: 0.2 }) > 1e-3, 'the variant looks like the scene');
    await page.keyboard.press('3');
    await drawn(page, '2');
    await page.locator('#first-label select').selectOption('0');
    await drawn(page, '0');
    assert.ok(await changedShare(itself, await look(page)) < 1e-3, 'back to the first picture');
  });

  test('compares a variant with base, and two faces side by side', async () => {
    await page.keyboard.press('2');
    await page.keyboard.press('s');
    await drawn(page, '0 1');
    assert.deepEqual(await pressed(page, 'modes'), ['Side by side']);
    assert.ok((await halvesDiffer(await look(page))) > 3e-3, 'both halves look alike');
    await page.keyboard.press('1');
    await drawn(page, '0 0');
    const apart = await halvesDiffer(await look(page));
    assert.ok(apart < 2e-3, `the same face in both halves differs in ${apart}`);
    await page.keyboard.press('3');
    await page.keyboard.press('Shift+Digit2');
    await drawn(page, '1 2');
    await page.getByRole('button', { name: 'Swap' }).click();
    await drawn(page, '2 1');
    await page.getByRole('button', { name: 'One face' }).click();
    await drawn(page, '1');
  });

  test('both faces turn together', async () => {
    await page.keyboard.press('s');
    await page.keyboard.press('1');
    await drawn(page, '0 0');
    const front = await look(page);
    await page.getByRole('button', { name: 'Three-quarter' }).click();
    const turned = await look(page);
    assert.ok(await changedShare(front, turned) > 0.03);
    assert.ok((await halvesDiffer(turned)) < 2e-3, 'the halves look from different sides');
    await page.keyboard.press('f');
    await page.keyboard.press('Shift+ArrowLeft');
    const box = await page.locator('#face').boundingBox();
    const keyed = await look(page);
    assert.ok(await changedShare(front, keyed) > 0.02, 'the keys do not turn the face');
    await page.keyboard.press('f');
    await page.mouse.move(box.x + 0.75 * box.width, box.y + 0.6 * box.height);
    await page.mouse.down();
    await page.mouse.move(box.x + 0.85 * box.width, box.y + 0.6 * box.height, { steps: 4 });
    await page.mouse.up();
    const dragged = await look(page);
    assert.ok(await changedShare(front, dragged) > 0.02, 'dragging does not turn the face');
    assert.ok((await halvesDiffer(dragged)) < 2e-3);
    await page.keyboard.press('f');
    await page.keyboard.press('s');
  });

  test('the line divides two faces where it is put', async () => {
    const under = { top: 0.2 }; // the labels
    await page.keyboard.press('1');
    await drawn(page, '0');
    const left = await look(page);
    await page.keyboard.press('2');
    await drawn(page, '1');
    const right = await look(page);
    await page.keyboard.press('w');
    await drawn(page, '0 1');
    const handle = page.locator('#wipe');
    const stage = await page.locator('#canvas-host').boundingBox();
    for (const share of [0.3, 0.55, 0.8]) {
      const grip = await handle.boundingBox();
      await page.mouse.move(grip.x + grip.width / 2, grip.y + grip.height / 2);
      await page.mouse.down();
      await page.mouse.move(stage.x + share * stage.width, stage.y + 0.5 * stage.height, { steps: 3 });
      await page.mouse.up();
      assert.ok(Math.abs((await wipeAt(page)) - 100 * share) <= 1);
      const both = await look(page);
      const [l, r] = [{ ...under, right: share - 0.05 }, { ...under, left: share + 0.05 }];
      assert.ok(await changedShare(left, both, l) < 1e-3, `${share}: the left is not the first face`);
      assert.ok(await changedShare(right, both, r) < 1e-3, `${share}: the right is not the second face`);
    }
    assert.ok(await changedShare(left, right, under) > 1e-3, 'two faces that look alike prove nothing');
    await handle.focus();
    const frame = await page.locator('#frame').inputValue();
    await page.keyboard.press('ArrowLeft');
    assert.equal(await wipeAt(page), 78);
    await page.keyboard.press('Shift+ArrowLeft');
    assert.equal(await wipeAt(page), 68);
    await page.keyboard.press('Home');
    assert.equal(await wipeAt(page), 0);
    assert.ok(await changedShare(right, await look(page), { ...under, left: 0.05 }) < 1e-3);
    await page.keyboard.press('End');
    assert.ok(await changedShare(left, await look(page), { ...under, right: 0.95 }) < 1e-3);
    assert.match(await handle.getAttribute('aria-valuetext'), /100 % base/);
    assert.equal(await page.locator('#frame').inputValue(), frame, 'keys of the line moved the frame');
    await page.keyboard.press('w');
    await drawn(page, '1');
    assert.equal(await handle.isVisible(), false);
  });

  test('two faces run from one clock', async () => {
    await page.keyboard.press('w');
    await page.locator('#frame').fill('0');
    const rest = await look(page);
    assert.equal(Number(await page.locator('#face').getAttribute('data-frame')), 0);
    await page.locator('#to-peak').click();
    const moved = await look(page);
    for (const half of [{ right: 0.45 }, { left: 0.55 }])
      assert.ok(await changedShare(rest, moved, { top: 0.2, ...half }) > 0.01, 'a half stands still');
    const peak = Number(await page.locator('#frame').inputValue());
    await page.locator('#canvas-host').click({ position: { x: 5, y: 300 } });
    await page.keyboard.press('ArrowRight');
    assert.equal(Number(await page.locator('#frame').inputValue()), peak + 1);
    await page.keyboard.press('ArrowLeft');
    await page.keyboard.press(' ');
    await page.waitForFunction((f) => Number(document.getElementById('face').dataset.frame) !== f, peak);
    await page.keyboard.press(' ');
    assert.equal(await page.locator('#play').getAttribute('aria-label'), 'Play');
    await page.keyboard.press('p');
    await page.keyboard.press('w');
  });

  test('colours show displacement, difference, asymmetry and tissue, each with its bar', async () => {
    await page.keyboard.press('1');
    await drawn(page, '0');
    const buttons = page.locator('#colouring button');
    const titles = [];
    let last = null;
    for (const button of await buttons.all()) {
      await button.click();
      assert.deepEqual(await pressed(page, 'colouring'), [await button.textContent()]);
      const picture = await look(page);
      if (last) assert.ok(await changedShare(last, picture) > 0.05, 'two colourings look alike');
      last = picture;
      const skin = (await button.textContent()) === 'Skin';
      assert.equal(await page.locator('#colour-bar').isVisible(), !skin);
      if (!skin) titles.push(await page.locator('#colour-bar figcaption').textContent());
    }
    assert.equal(titles[0], 'Displacement from rest mm');
    assert.equal(titles[1], 'Distance from the unchanged face mm');
    assert.equal(titles[2], 'Asymmetry of the motion mm');
    assert.equal(titles[3], 'Expected error of the skin mm');
    assert.equal(titles[4], 'Stiffness kPa');
    const chosen = [];
    for (let i = 0; i < (await buttons.count()); ++i) {
      await page.keyboard.press('m');
      chosen.push(...(await pressed(page, 'colouring')));
    }
    assert.deepEqual(chosen, await buttons.allTextContents());
  });

  test('base differs nowhere from itself; a variant does, on the scale of those shown', async () => {
    const greatest = () => page.locator('#colour-bar .ticks span').last().textContent().then(Number);
    const reaches = async (...shown) => {
      const most = Math.max(...shown.map((i) => data.variants[i - 1].max_difference_mm));
      const end = await greatest();
      assert.ok(end >= most - 1e-6 && end <= 1.6 * most, `the scale ends at ${end}, the differences at ${most}`);
      const remark = await page.locator('#colour-bar p').textContent();
      for (const i of shown) assert.ok(remark.includes(data.variants[i - 1].name), remark);
    };
    await page.getByRole('button', { name: 'Difference', exact: true }).click();
    await page.keyboard.press('1');
    await drawn(page, '0');
    assert.match(await page.locator('#first-label').textContent(), /0 mm everywhere/);
    // The inside of the mouth has its own colour.
    const plain = await colourfulShare(await look(page));
    assert.ok(plain < 0.01, `${plain} of the picture is coloured`);
    await page.keyboard.press('2');
    await drawn(page, '1');
    await reaches(1);
    const coloured = await colourfulShare(await look(page));
    assert.ok(coloured > plain + 0.01, `only ${coloured} of the picture is coloured, ${plain} in base`);
    await page.locator('#frame').fill('0');
    assert.ok(await colourfulShare(await look(page)) < plain + 1e-3, 'faces at rest differ');
    await page.keyboard.press('p');
    await page.keyboard.press('s');
    await page.keyboard.press('Shift+Digit3');
    await drawn(page, '2 1');
    await reaches(1, 2);
  });

  test('beside base both faces are coloured by the distance between them', async () => {
    await page.getByRole('button', { name: 'Difference', exact: true }).click();
    await page.keyboard.press('2');
    await page.keyboard.press('s');
    await drawn(page, '0 1');
    assert.equal(await page.locator('#colour-bar figcaption').textContent(), 'Distance between the faces mm');
    assert.equal((await page.locator('#first-label').textContent()).includes('0 mm'), false);
    const [left, right] = [await colourfulShare(await look(page), { right: 0.5 }), await colourfulShare(await look(page), { left: 0.5 })];
    assert.ok(left > 0.01 && Math.abs(left - right) < 0.5 * right, `${left} left, ${right} right`);
  });

  test('asymmetry has a scale of its own for all faces, and says what is grey', async () => {
    await page.getByRole('button', { name: 'Asymmetry', exact: true }).click();
    const ticks = await page.locator('#colour-bar .ticks').textContent();
    assert.match(await page.locator('#colour-bar p').textContent(), /range of all faces; grey: unpaired/);
    const moved = await look(page);
    await page.keyboard.press('2');
    await drawn(page, '1');
    assert.equal(await page.locator('#colour-bar .ticks').textContent(), ticks);
    assert.ok(await changedShare(moved, await look(page), { top: 0.2 }) > 1e-3, 'the variant is coloured as the scene');
    assert.ok(await colourfulShare(await look(page)) > 0.01, 'the variant moves evenly');
    await page.locator('#frame').fill('0');
    assert.ok(await colourfulShare(await look(page)) < 1e-3, 'a face at rest is uneven');
    await page.keyboard.press('p');
  });

  test('pressing the face shows figures at a place, resting on it too, and Escape clears them', async () => {
    const readout = page.locator('.readout');
    const figures = () => readout.locator('tbody tr').evaluateAll((rows) =>
      rows.map((row) => [...row.querySelectorAll('td')].map((cell) => Number.parseFloat(cell.textContent))));
    await page.getByRole('button', { name: 'Difference', exact: true }).click();
    await page.keyboard.press('2');
    await page.keyboard.press('s');
    await drawn(page, '0 1');
    const box = await page.locator('#face').boundingBox();
    const cheek = [box.x + 0.83 * box.width, box.y + 0.7 * box.height]; // of the right face
    await page.mouse.click(...cheek);
    await readout.waitFor();
    assert.match(await readout.locator('p').textContent(), /^\d+ mm from \w/);
    const [[own, apart], [other, same]] = await figures();
    assert.equal(apart, same, 'the distance between two faces is one');
    assert.ok(own > 1 && apart > 0.05 && apart <= data.variants[0].max_difference_mm, `${own} mm, ${apart} mm apart`);
    assert.ok(apart >= Math.abs(own - other) - 0.02 && apart <= own + other + 0.02, `${apart} between ${own} and ${other}`);
    assert.match(await page.locator('#announcement').textContent(), new RegExp(`base: displacement ${own.toFixed(2)} mm, Difference`));
    if (pictures) await page.screenshot({ path: join(pictures, 'readout.png') });
    await page.keyboard.press('Home');
    await drawn(page, '0 1');
    assert.deepEqual(await figures(), [[0, 0], [0, 0]], 'the figures go along with the time');
    await page.keyboard.press('Escape');
    assert.equal(await readout.isVisible(), false);
    await page.mouse.move(cheek[0] + 3, cheek[1]);
    await readout.waitFor();
    await page.mouse.down();
    await page.mouse.move(cheek[0] - 30, cheek[1], { steps: 3 });
    await page.mouse.up();
    assert.equal(await readout.isVisible(), false, 'turning the face shows no figures');
    await page.mouse.click(box.x + 20, box.y + 0.5 * box.height);
    assert.equal(await readout.isVisible(), false, 'beside the face there is none');
    await page.mouse.move(0, 0);
    await page.keyboard.press('f');
  });

  test('saves the picture, with twice the pixels, named after what it shows', async () => {
    await page.keyboard.press('2');
    await page.keyboard.press('w');
    await drawn(page, '0 1');
    const shown = await look(page);
    const [saved] = await Promise.all([
      page.waitForEvent('download'), page.getByRole('button', { name: 'Save picture' }).click(),
    ]);
    const name = (await page.locator('#chips button').nth(1).textContent()).replaceAll(' ', '-');
    assert.match(saved.suggestedFilename(), new RegExp(`-base-${name}-[0-9]+-[0-9]{3}-s\\.png$`));
    const png = await readFile(await saved.path());
    if (pictures) await saved.saveAs(join(pictures, 'saved.png'));
    assert.equal(png.subarray(1, 4).toString(), 'PNG');
    const stage = await page.locator('#canvas-host').evaluate((e) => [e.clientWidth, e.clientHeight]);
    assert.equal(png.readUInt32BE(16), 2 * stage[0]);
    assert.ok(png.readUInt32BE(20) >= 2 * (stage[1] + 100), 'no room for title and bar');
    const picture = await decode(page, png);
    assert.ok((await distinctColours(picture)) > 60);
    assert.ok((await colourfulShare(picture)) > 0.01, 'neither face nor bar');
    assert.ok(await changedShare(shown, await look(page), { top: 0.2, bottom: 0.85 }) < 1e-3, 'saving changed what is shown');
    await page.keyboard.press('w');
  });

  test('keys are listed, can be turned off, and leave form fields alone', async () => {
    const mode = () => pressed(page, 'modes').then(([name]) => name);
    await page.locator('#speed').focus();
    await page.keyboard.press('w');
    assert.equal(await mode(), 'One');
    await page.locator('#first-label select').focus();
    await page.keyboard.press('s');
    assert.equal(await mode(), 'One');
    await page.locator('#open-help').click();
    assert.equal(await page.getByRole('dialog', { name: 'Keys' }).isVisible(), true);
    if (pictures) await page.screenshot({ path: join(pictures, 'keys.png') });
    await page.keyboard.press('s');
    assert.equal(await mode(), 'One', 'keys fire behind the list');
    await page.getByLabel('Use these keys').uncheck();
    await page.keyboard.press('Escape');
    await page.locator('#face').focus();
    await page.keyboard.press('s');
    assert.equal(await mode(), 'One');
    await page.locator('#open-help').click();
    await page.getByLabel('Use these keys').check();
    await page.getByRole('button', { name: 'Close' }).click();
    await page.locator('#face').focus();
    await page.keyboard.press('?');
    assert.equal(await page.getByRole('dialog').isVisible(), true);
    await page.keyboard.press('Escape');
    await page.keyboard.press('s');
    assert.equal(await mode(), 'Side by side');
    await page.keyboard.press('Control+s');
    assert.equal(await mode(), 'Side by side');
    await page.keyboard.press('s');
  });

  test('says that it is no medical device', async () => {
    assert.equal(await page.getByText('Hyperex is a research tool and no medical device.').isVisible(), true);
  });

  test('says nothing on the console and asks nothing of the network', () => assert.deepEqual(complaints, []));
});

test('a page without variants has no controls for them', { skip: Boolean(process.env.REPORT) }, async () => {
  const { page, complaints, close } = await openPage(browser, fixture('plain.html'));
  await page.waitForSelector('#face[data-at-rest="true"]');
  for (const id of ['faces', 'wipe', 'swap', 'first-label', 'second-label'])
    assert.equal(await page.locator(`#${id}`).isVisible(), false, id);
  assert.deepEqual(await page.locator('#colouring button').allTextContents(), ['Skin', 'Displacement']);
  for (const key of ['s', 'w', '2', 'x']) await page.keyboard.press(key);
  assert.equal(await page.locator('#face').getAttribute('data-faces'), '0');
  const [saved] = await Promise.all([page.waitForEvent('download'), page.keyboard.press('e')]);
  assert.match(saved.suggestedFilename(), /\.png$/);
  assert.deepEqual(complaints, []);
  await close();
});

test('without WebGL it says so, and the curves still work', async () => {
  const init = () => {
    const get = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
      return kind.startsWith('webgl') ? null : get.call(this, kind, ...rest);
    };
  };
  const { page, complaints, close } = await openPage(browser, report, { init });
  assert.equal(await page.locator('#no-webgl').isVisible(), true);
  assert.equal(await page.locator('#save-picture').isVisible(), false);
  const over = page.locator('.u-over').first();
  const box = await over.boundingBox();
  await page.mouse.click(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
  assert.ok(Number(await page.locator('#frame').inputValue()) > 0);
  await page.keyboard.press('Home');
  assert.equal(await page.locator('#frame').inputValue(), '0');
  assert.deepEqual(complaints.filter((text) => !/WebGL/.test(text)), []);
  await close();
});

for (const [name, options] of [
  ['light', {}],
  ['dark', { colorScheme: 'dark' }],
  ['phone', { viewport: { width: 390, height: 840 }, hasTouch: true, isMobile: true }],
]) {
  test(`fits the window (${name})`, async () => {
    const { page, complaints, close } = await open(options);
    const shoot = async (what) => {
      assert.ok((await tooWide(page)) <= 0, `${what}: too wide`);
      if (!pictures) return;
      await page.waitForSelector('#face[data-at-rest="true"]');
      await page.screenshot({ path: join(pictures, `${name}_${what}.png`), fullPage: what === 'one' });
    };
    const colour = (key) => page.locator(`#colouring [data-colouring="${key}"]`).click();
    await shoot('one');
    await page.keyboard.press('2');
    await page.keyboard.press('s');
    await colour('difference');
    await shoot('side_by_side');
    await page.keyboard.press('w');
    await colour('displacement');
    await shoot('wipe');
    await colour('asymmetry');
    await shoot('asymmetry');
    await colour('tissue:young_kpa');
    await page.keyboard.press('w');
    await shoot('tissue');
    await colour('skin');
    await shoot('skin');
    assert.deepEqual(complaints, []);
    await close();
  });
}
