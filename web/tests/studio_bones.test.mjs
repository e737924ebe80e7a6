// SPDX-License-Identifier: GPL-3.0-or-later
// Surgery in the studio: bones moved by figures, from the list of questions and by their arrows; on a made-up face with
// a made-up server, and on the embedded face with the program's own.
import assert from 'node:assert/strict';
import { existsSync, readdirSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { launch } from './browser.mjs';
import { openMadeUp } from './made_up_studio.mjs';
import { askWhatIf, openStudio, program, startStudio } from './studio_server.mjs';
import { zipOf } from './zip.mjs';

const phantom = join(dirname(fileURLToPath(import.meta.url)), '..', '..', '..', 'shared', 'data', 'ct', 'phantom_head.zip');
const boneKey = 'surgery.bone';

describe('bones with a made-up face', { concurrency: false }, () => {
  let browser;
  before(async () => (browser = await launch()));
  after(() => browser?.close());

  const sent = (session) => session().requests.filter(({ changes }) => changes?.[boneKey]);
  const figure = (page, name) => page.locator(`[data-bone="${name}"] input[type=number]`);

  test('a figure moves the chosen segment of another face; back where it was removes it', async () => {
    const { page, complaints, session, close } = await openMadeUp(browser, () => []);
    await page.click('#tab-bones');
    await page.click('#panel-bones [data-part=chin]');
    await figure(page, 'move_mm.2').fill('4');
    await figure(page, 'move_mm.2').press('Enter');
    await page.waitForFunction(() => document.getElementById('question-body').innerText.includes('chin 4 mm forward'));
    const [first] = sent(session).slice(-1);
    assert.equal(first.face, 1, 'base stays as it is');
    assert.deepEqual(first.changes[boneKey], [{ part: 'chin', cut: 'standard', move_mm: [0, 0, 4], turn_deg: [0, 0, 0], cut_shift_mm: 0 }]);

    // A second segment beside it, with a turn.
    await page.click('#panel-bones [data-part=mandible]');
    await page.locator('#panel-bones details').evaluate((details) => (details.open = true));
    await page.selectOption('#panel-bones select', 'whole');
    await figure(page, 'turn_deg.0').fill('-2.5');
    await figure(page, 'turn_deg.0').press('Enter');
    await page.waitForFunction(() => document.querySelectorAll('#tabs .tab-name')[1]?.innerText.includes('front 2.5 deg up'));
    assert.deepEqual(sent(session).at(-1).changes[boneKey].map(({ part, cut, turn_deg }) => [part, cut, turn_deg]), [
      ['chin', 'standard', [0, 0, 0]], ['mandible', 'whole', [-2.5, 0, 0]],
    ]);
    await page.locator('#panel-bones').getByRole('button', { name: 'Back where it was' }).click();
    await page.waitForFunction(() => document.querySelectorAll('#tabs .tab-name')[1]?.innerText === 'chin 4 mm forward');

    // The cross of the question removes the other.
    await page.locator('#question-body .change-out').click();
    await page.waitForFunction(() => !document.querySelectorAll('#tabs .tab-name')[1]?.innerText.includes('chin'));
    assert.deepEqual(sent(session).at(-1).changes[boneKey], []);
    assert.deepEqual(complaints, []);
    await close();
  });

  test('an arrow over the face is dragged: the shape follows, and the release is one change', async () => {
    const { page, complaints, session, close } = await openMadeUp(browser, () => []);
    await page.click('#tab-bones');
    await page.click('#panel-bones [data-part=maxilla]');
    const { x, y, width, height } = await page.locator('#face').boundingBox();
    // The arrow that points up is above the middle of the picture; the pointer's form shows it.
    const found = async (across) => {
      for (let at = y + 0.2 * height; at < y + 0.8 * height; at += 6) {
        await page.mouse.move(across, at);
        if (await page.locator('#face').evaluate((canvas) => canvas.style.cursor === 'grab')) return at;
      }
      return null;
    };
    const top = await found(x + width / 2);
    assert.notEqual(top, null, 'an arrow can be picked');
    assert.equal(await found(x + 0.1 * width), null, 'beside it the face is turned');
    await page.mouse.move(x + width / 2, top);
    await page.mouse.down();
    await page.mouse.move(x + width / 2, top - 10, { steps: 3 });
    await page.mouse.move(x + width / 2, top - 20, { steps: 3 });
    await page.mouse.up();
    await page.waitForFunction(() => document.getElementById('question-body').innerText.includes('maxilla'));
    const all = sent(session);
    const last = all.at(-1);
    assert.equal(last.live, false);
    assert.ok(all.some(({ live }) => live), 'the shape follows');
    assert.equal(all.filter(({ live }) => !live).length, 1);
    const [{ part, move_mm: [left, up, forward] }] = last.changes[boneKey];
    assert.deepEqual([part, left, forward], ['maxilla', 0, 0]);
    assert.ok(up > 0.5 && up < 15, `${up} mm up`);
    assert.equal(Number(await figure(page, 'move_mm.1').inputValue()), up);
    assert.deepEqual(complaints, []);
    await close();
  });
});

describe('bones with the program', { skip: program() ? false : 'the program is not built', concurrency: false }, () => {
  let browser;
  before(async () => (browser = await launch()));
  after(() => browser?.close());

  test('an advancement of the lower jaw: millimetres at rest beside published ratios; saved, it is a variant', async (t) => {
    const studio = await startStudio();
    t.after(() => studio.stop());
    const { page, complaints, close } = await openStudio(browser, studio.address);
    await page.waitForFunction(() => document.documentElement.dataset.current === 'true');
    await askWhatIf(page, 'lower jaw 6 mm');
    const row = page.locator('.bone-results tbody tr', { hasText: 'Chin' });
    await row.waitFor();
    const [, moved, ratio] = await row.locator('th, td').allInnerTexts();
    const forward = Number(/([\d.]+) forward/.exec(moved)[1]);
    assert.ok(forward > 4.8 && forward < 6.6, moved);
    assert.ok(Math.abs(parseFloat(ratio) - forward / 6) < 0.02, ratio);
    assert.match(ratio, /published 0\.80 to 1\.33/);
    assert.match(await page.locator('#scene-text').textContent(), /\[\[variant\]\][^[]*name = "mandible 6 mm forward"/);
    // Dragging: a shape in equilibrium comes at once.
    const shapes = () => page.evaluate(() => Number(document.documentElement.dataset.shapes ?? 0));
    const before = await shapes();
    await page.locator('[data-bone="move_mm.2"] input[type=range]').focus();
    await page.keyboard.press('ArrowLeft');
    await page.waitForFunction((n) => Number(document.documentElement.dataset.shapes ?? 0) > n, before);
    console.log(`a shape takes ${await page.evaluate(() => document.documentElement.dataset.shapeS)} s`);
    assert.deepEqual(complaints, []);
    await close();
  });

  test('a zipped CT: skin, bones and their pictures; then skull and jaw are divided anew by two clicks', { skip: existsSync(phantom) ? false : 'no CT is there' }, async (t) => {
    const studio = await startStudio();
    t.after(() => studio.stop());
    const { page, complaints, close } = await openStudio(browser, studio.address);
    page.setDefaultTimeout(180_000);
    const settled = () => page.waitForFunction(() => document.documentElement.dataset.current === 'true' && !document.documentElement.hasAttribute('data-opening'));
    await settled();
    await page.click('#open-files');
    assert.equal(await page.locator('#ct-panel').isVisible(), false, 'the embedded face has no CT');

    // No slices are in this one: one sentence, and the face stays.
    await page.setInputFiles('#file-picker', { name: 'letters.zip', mimeType: 'application/zip', buffer: zipOf([['a.txt', Buffer.from('no slice')]]) });
    await page.waitForFunction(() => /DICOM/.test(document.querySelector('#open-panel > .problem').textContent));
    assert.match(await page.locator('#open-panel > .problem').textContent(), /^letters\.zip/);

    const began = Date.now();
    await page.setInputFiles('#file-picker', { name: 'Doe Jane 1970.zip', mimeType: 'application/zip', buffer: await readFile(phantom) });
    await page.locator('.ct-pictures img').nth(2).waitFor();
    await settled();
    console.log(`a CT is open after ${((Date.now() - began) / 1e3).toFixed(0)} s`);
    for (const picture of await page.locator('.ct-pictures img').all()) assert.ok(await picture.evaluate((image) => image.decode().then(() => image.naturalWidth > 300)));
    // Its slices: one of each kind, along the head.
    const caption = page.locator('.ct-slices output');
    await page.waitForFunction(() => /^axial, y = -?\d+ mm/.test(document.querySelector('.ct-slices output').value));
    const [middle, source] = [await caption.textContent(), await page.locator('.ct-slices img').getAttribute('src')];
    await page.locator('.ct-slices input[type=range]').focus();
    for (let k = 0; k < 20; ++k) await page.keyboard.press('ArrowRight');
    await page.waitForFunction((old) => document.querySelector('.ct-slices output').value !== old, middle);
    assert.notEqual(await page.locator('.ct-slices img').getAttribute('src'), source);
    await page.locator('.ct-slices').getByRole('button', { name: 'Coronal' }).click();
    await page.waitForFunction(() => /^coronal, z = -?\d+ mm, from the front$/.test(document.querySelector('.ct-slices output').value));
    assert.ok(await page.locator('.ct-slices img').evaluate((image) => image.decode().then(() => image.naturalWidth > 300)));
    const boneHu = page.locator('.ct-slices input[type=number]');
    assert.ok(Number(await boneHu.inputValue()) > 150);
    const text = await page.locator('#scene-text').textContent();
    assert.match(text, /\[anatomy\]\s+ct = /);
    assert.doesNotMatch(text, /doe|jane|1970/i, 'the name of the file may name the patient');
    const kept = readdirSync(studio.folder, { recursive: true }).join('\n');
    assert.match(kept, /mandible\.ply/);
    assert.doesNotMatch(kept, /doe|jane|1970/i);

    await page.click('#open-files');
    await askWhatIf(page, 'lower jaw 6 mm');
    const row = page.locator('.bone-results tbody tr', { hasText: 'Chin' });
    await row.waitFor();
    const [, moved] = await row.locator('th, td').allInnerTexts();
    assert.ok(Number(/([\d.]+) forward/.exec(moved)[1]) > 4.8, moved);
    await page.locator('[data-mode=single]').click();
    const status = page.locator('.bones-panel [role=status]');
    const before = await page.locator('.ct-pictures img').first().getAttribute('src');
    const divideInto = async (folder) => {
      await page.getByRole('button', { name: 'Skull and jaw are divided wrongly' }).click();
      const { x, y, width, height } = await page.locator('#face').boundingBox();
      await page.mouse.click(x + 0.5 * width, y + 0.28 * height);
      await page.waitForFunction(() => /lower jaw/.test(document.querySelector('.bones-panel [role=status]').textContent));
      await page.mouse.click(x + 0.5 * width, y + 0.72 * height);
      await page.waitForFunction((name) => document.getElementById('scene-text').textContent.includes(name), folder);
      await settled();
    };
    // Another threshold of bone; a division after it keeps it.
    await page.click('#open-files');
    const other = String(Number(await boneHu.inputValue()) + 60);
    await boneHu.fill(other);
    await page.getByRole('button', { name: 'Find the bones anew' }).click();
    await page.waitForFunction(() => document.getElementById('scene-text').textContent.includes('ct-2'));
    await settled();
    assert.equal(await boneHu.inputValue(), other);
    // Its pictures are new.
    await page.waitForFunction((old) => document.querySelector('.ct-pictures img').getAttribute('src') !== old, before);
    await page.click('#open-files');
    const anew = await page.locator('.ct-pictures img').first().getAttribute('src');
    await divideInto('ct-3');
    await page.waitForFunction((old) => document.querySelector('.ct-pictures img').getAttribute('src') !== old, anew);
    assert.equal(await status.textContent(), '');
    await page.click('#undo');
    await page.waitForFunction(() => !document.getElementById('scene-text').textContent.includes('ct-3'));
    await settled();
    await page.click('#open-files');
    assert.equal(await boneHu.inputValue(), other);
    // Another face has no CT.
    const divide = page.getByRole('button', { name: 'Skull and jaw are divided wrongly' });
    assert.equal(await divide.isVisible(), true);
    page.on('dialog', (dialog) => void dialog.accept());
    await page.locator('#open-panel').getByRole('button', { name: 'Face built into Hyperex' }).click();
    await page.waitForFunction(() => document.getElementById('scene-text').textContent.includes('embedded'));
    await settled();
    assert.equal(await divide.isVisible(), false);
    assert.equal(await page.locator('#ct-panel').isVisible(), false);
    assert.doesNotMatch(studio.said(), /doe|jane|1970/i);
    assert.deepEqual(complaints, []);
    await close();
  });
});
