// SPDX-License-Identifier: GPL-3.0-or-later
// The studio's page on a made-up face with a made-up server: what must hold whatever the program computes.
import assert from 'node:assert/strict';
import { after, before, describe, test } from 'node:test';
import { launch } from './browser.mjs';
import { openMadeUp } from './made_up_studio.mjs';
import { imported } from './modules.mjs';
import { askWhatIf } from './studio_server.mjs';

const id = 'variant.muscle_hardly_used';
const weak = (face) => 'frontal_med_R' in face.values['muscles.gain'];
/** The warnings of the program on variants that change a muscle which the recording hardly uses. */
const remarksOf = (faces) => faces.slice(1).filter(weak)
  .map(({ name }) => ({ id, severity: 'warning', text: `variant ${name}: hardly known`, key: 'muscles.gain', variant: name }));

describe('the studio with a made-up face', { concurrency: false }, () => {
  let browser;
  before(async () => (browser = await launch()));
  after(() => browser?.close());

  test('a strength that the recording hardly uses: the warning stands beside its slider, and describes it', async () => {
    const { page, complaints, close } = await openMadeUp(browser, remarksOf);
    const slider = page.locator('[data-gain=frontal_med_R]');
    await slider.evaluate((input) => (input.closest('details').open = true));
    await slider.focus();
    await page.keyboard.press('PageDown');
    const beside = page.locator(`#panel-muscles [data-note-id="${id}"]`);
    await beside.waitFor();
    assert.equal(await beside.evaluate((note) => note.parentElement.querySelector('input').dataset.gain), 'frontal_med_R', 'in the row of the muscle');
    assert.equal(await slider.getAttribute('aria-describedby'), await beside.getAttribute('id'));
    assert.equal(await page.locator('[aria-describedby]').count(), 1, 'it describes no other control');
    assert.equal(await page.locator(`#messages-panel [data-note-id="${id}"]`).count(), 1);
    assert.equal(await page.locator('#tab-muscles.has-remark').count(), 1);
    // Base has no such warning.
    await page.locator('[data-mode=single]').dispatchEvent('click');
    await page.locator('#tabs .tab-name').first().dispatchEvent('click');
    await beside.waitFor({ state: 'detached' });
    assert.equal(await slider.getAttribute('aria-describedby'), null);
    assert.deepEqual(complaints, []);
    await close();
  });

  test('the points that the head is held still by are chosen from the recording’s, three or more', async () => {
    const { page, complaints, session, close } = await openMadeUp(browser, () => []);
    await page.locator('.rigid-points').evaluate((details) => (details.open = true));
    const box = (name) => page.locator(`.rigid-points input[value=${name}]`);
    const press = (name) => box(name).evaluate((input) => input.click());
    const apply = page.locator('.rigid-points button');
    assert.equal(await page.locator('.rigid-points summary').textContent(), 'Head pose: from 3 chosen points');
    assert.equal(await page.locator('.rigid-points input:checked').count(), 3);
    await press('band_3');
    assert.equal(await apply.isDisabled(), true, 'two are too few');
    assert.match(await page.locator('.rigid-points .hint').textContent(), /3 points or more/);
    await press('band_4');
    await apply.evaluate((button) => button.click());
    await page.waitForFunction(() => document.querySelectorAll('.rigid-points input:checked').length === 3);
    const changes = session().requests.filter(({ name, changes: of }) => name === 'set' && of['motion.rigid_points']);
    assert.deepEqual(changes.map(({ face, live, changes: of }) => [face, live, of['motion.rigid_points']]), [[0, false, ['band_1', 'band_2', 'band_4']]]);
    assert.deepEqual(complaints, []);
    await close();
  });

  test('the table of figures fits its panel, however long the words in it', async () => {
    const { page, complaints, close } = await openMadeUp(browser, () => [], { viewport: { width: 1440, height: 900 } });
    await page.locator('#tab-figures').dispatchEvent('click');
    const widths = await page.evaluate(() => {
      for (const cell of document.querySelectorAll('.corner-table td')) {
        const small = document.createElement('small');
        small.textContent = 'now 10.5 mm, unfiltered';
        cell.append(small);
      }
      for (const name of document.querySelectorAll('.corner-table tbody th')) name.append(' right zygomatic branch');
      const table = document.querySelector('.corner-table');
      return [table.getBoundingClientRect().right, table.parentElement.getBoundingClientRect().right];
    });
    assert.ok(widths[0] > 0 && widths[0] <= widths[1] + 0.5, `it ends at ${widths[0]}, its panel at ${widths[1]} px`);
    assert.deepEqual(complaints, []);
    await close();
  });

  test('a face is called by what it changes, until somebody names it', async () => {
    const { page, complaints, session, close } = await openMadeUp(browser, () => []);
    const names = () => page.locator('#tabs .tab-name').allInnerTexts();
    const named = (wanted) => page.waitForFunction((name) => document.querySelectorAll('#tabs .tab-name')[1]?.innerText === name, wanted);
    const pull = async (gain, key) => {
      await page.locator(`[data-gain=${gain}]`).focus();
      await page.keyboard.press(key);
      await page.locator('#face').focus(); // let go
    };
    // From 100 % down by a tenth of the slider's whole 200 %.
    await pull('side_R', 'PageDown');
    await named('right side 80 %');
    await pull('side_R', 'PageDown');
    await named('right side 60 %');
    await pull('zygomatic_L', 'Home');
    await named('right side 60 %; zygomatic, left 0 %');
    assert.equal(session().requests.filter(({ name }) => name === 'rename_variant').length, 0, 'one step each, that undo takes back');
    // Another one of the same change is numbered.
    await page.evaluate(() => document.querySelector('[data-mode=single]').click());
    await page.locator('#tabs .tab-name').first().click();
    await pull('side_R', 'PageDown');
    await page.waitForFunction(() => document.querySelectorAll('#tabs .tab-name')[2]?.innerText === 'right side 80 %');
    // Somebody renames the face.
    session().faces[1].name = 'visit A';
    session().scene();
    await named('visit A');
    await page.locator('#tabs .tab-name').nth(1).click();
    await pull('side_R', 'PageDown');
    await page.waitForFunction(() => document.getElementById('scene-text').textContent.includes('"side_R":0.4'));
    assert.deepEqual(await names(), ['Base', 'visit A', 'right side 80 %']);
    assert.deepEqual(complaints, []);
    await close();
  });

  test('a slow server: what it sends before it answers a change does not take the change back', async () => {
    const { page, complaints, session, close } = await openMadeUp(browser, () => []);
    const slider = page.locator('[data-gain=side_R]');
    const at = () => slider.evaluate((input) => input.getAttribute('aria-valuetext'));
    const pull = async () => {
      await slider.focus();
      await page.keyboard.press('PageDown');
      await page.locator('#face').focus(); // let go
    };
    const asks = async (count) => {
      for (let i = 0; session().held.length < count && i < 3000; ++i) await page.waitForTimeout(10);
      assert.ok(session().held.length >= count, 'it asks');
    };
    session().held = [];
    await pull();
    await asks(1); // for a face beside base
    session().scene();
    await pull();
    assert.equal(await at(), '60 %', 'from 80 %');
    session().release();
    await page.waitForFunction(() => document.getElementById('scene-text').textContent.includes('"side_R":0.6'));
    assert.equal(await at(), '60 %');
    // Back as in base: the value of base shows at once, and stays.
    await page.locator('#tab-tissue').dispatchEvent('click');
    const young = page.locator('[data-key="tissue.young_kpa"]');
    const digits = () => young.locator('input[type=number]').inputValue();
    await young.locator('input[type=number]').fill('300');
    await young.locator('input[type=number]').press('Enter');
    await page.waitForFunction(() => document.getElementById('scene-text').textContent.includes('"tissue.young_kpa":300'));
    await page.locator('#face').focus();
    session().held = [];
    await young.locator('.back').click();
    await asks(1);
    session().scene();
    await page.waitForFunction(() => document.querySelector('[data-key="tissue.young_kpa"] input[type=number]').value === '150');
    session().release();
    await page.waitForFunction(() => document.getElementById('scene-text').textContent.match(/"tissue.young_kpa":150/g)?.length === 2);
    assert.equal(await digits(), '150');
    // Once it has answered, its word counts: as after a step back.
    session().faces[1].values = { ...session().faces[1].values, 'muscles.gain': { side_R: 0.3 } };
    session().scene();
    await page.waitForFunction(() => document.querySelector('[data-gain=side_R]').getAttribute('aria-valuetext') === '30 %');
    assert.deepEqual(complaints, []);
    await close();
  });

  test('what if: the slider of the strength that was changed comes into view, and the change reads as a sentence', async () => {
    const { page, complaints, close } = await openMadeUp(browser, () => []);
    await page.locator('#tab-scene').dispatchEvent('click');
    await askWhatIf(page, 'zyg major, left 30');
    const slider = page.locator('[data-question=zyg_major_L] input[type=range]');
    await slider.waitFor();
    const [panel, own] = [await page.locator('#question-body').boundingBox(), await slider.boundingBox()];
    assert.ok(own.y >= panel.y && own.y + own.height <= panel.y + panel.height, `${own.y} is outside of ${panel.y} to ${panel.y + panel.height}`);
    await page.waitForFunction(() => document.querySelector('.corner-table tr[data-face="1"] small.change'));
    assert.equal(await page.locator('.corner-table tr[data-face="1"] td[data-side=left] small.change').textContent(), '3.0 mm less than base');
    assert.deepEqual(complaints, []);
    await close();
  });

  test('how certain the answer is: intervals of the face shown, of this scene alone', async () => {
    const { page, complaints, close } = await openMadeUp(browser, () => []);
    await askWhatIf(page, 'right side 70');
    await page.waitForFunction(() => document.getElementById('scene-text').textContent.includes('side_R'));
    await page.locator('.certainty-ask').click();
    const lines = page.locator('.certainty-lines li');
    await lines.first().waitFor();
    assert.deepEqual(await lines.allInnerTexts(), [
      'Right changes by −3.0 mm (at least ± 1.0), cannot tell', 'Left changes by 0.0 mm (95 %: −0.2 to 0.2; mostly mesh), undecided',
      'The recording’s jitter is not known, so each ± is only a lower bound.',
    ]);
    // The interval stands in place of the band in the answer, too.
    assert.match(await page.locator('.answer-side[data-side=right] .answer-change').textContent(), /3\.0 mm less than base \(at least ± 1\.0 mm\) \(cannot tell/);
    assert.match(await page.locator('.answer-side[data-side=left] .answer-change').textContent(), /undecided: .*\(95 %: ± 0\.2 mm\)/);
    assert.equal(await page.locator('.certainty-ask').isVisible(), false);
    await page.locator('[data-mode=single]').dispatchEvent('click');
    await page.locator('#tabs .tab-name').first().dispatchEvent('click');
    await page.waitForFunction(() => document.querySelector('.certainty-lines').textContent.includes('Left less right: 0.0 mm (95 %: −1.5 to 1.5; mostly mesh), undecided'));
    await askWhatIf(page, 'left side 50');
    await page.waitForFunction(() => document.querySelector('.certainty-lines').hidden);
    assert.equal(await page.locator('.certainty-ask').isVisible(), true, 'another scene: it can be asked again');
    assert.deepEqual(complaints, []);
    await close();
  });

  test('what has changed since the recording before: asked where there is one, of what was performed', async () => {
    const { page, complaints, session, close } = await openMadeUp(browser, () => []);
    const box = page.locator('.compare-recordings');
    assert.equal(await box.evaluate((element) => element.hidden), true);
    session().earlier = 'march.csv';
    session().scene();
    await page.waitForFunction(() => !document.querySelector('.compare-recordings').hidden);
    assert.match(await box.textContent(), /march\.csv moved the face/);
    await box.locator('select').evaluate((select) => (select.value = 'brow raise'));
    await box.locator('button').evaluate((press) => press.click());
    await page.waitForFunction(() => document.querySelector('.compare-result .why'));
    assert.match(await box.locator('.compare-result').textContent(), /brow raise: 4\.6 mm less.*\/mine\/visits-brow-raise\.html/i);
    session().faces[0].name = 'another scene';
    session().scene();
    await page.waitForFunction(() => !document.querySelector('.compare-result .why'));
    assert.deepEqual(complaints, []);
    await close();
  });

  test('a stroke of the brush is painted, sent and shown as a patch', async () => {
    const { page, complaints, session, close } = await openMadeUp(browser, () => []);
    await page.locator('#tab-paint').dispatchEvent('click');
    const { x, y, width, height } = await page.locator('#face').boundingBox();
    await page.mouse.move(x + width / 2, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(x + width / 2 + 20, y + height / 2, { steps: 3 });
    await page.mouse.up();
    await page.waitForFunction(() => document.getElementById('paint-patch').options.length === 2);
    const painted = session().requests.find(({ name }) => name === 'paint');
    assert.ok(painted.vertices.length > 0 && painted.shares.every((share) => share > 0 && share <= 1));
    // The made-up server may answer after the page shows the patch.
    const patches = () => session().faces[1]?.values['tissue.region'] ?? [];
    for (let tries = 0; tries < 200 && patches().length === 0; tries += 1) await new Promise((resolve) => setTimeout(resolve, 50));
    assert.deepEqual(patches().map(({ young_factor: factor }) => factor), [3]);
    assert.deepEqual(complaints, []);
    await close();
  });

  test('controls and typed amounts take what the server says that a scene allows', async () => {
    const { page, complaints, close } = await openMadeUp(browser, () => []);
    const limits = (control) => page.locator(control).evaluate(({ min, max }) => [Number(min), Number(max)]);
    for (const [control, wanted] of Object.entries({
      '[data-key="tissue.region"]': [0, 500], '[data-key="tissue.region.volume_ml"]': [-20, 8], '[data-key="mesh.thickness_mm"]': [1, 40],
      '[data-paint=young]': [0, 500], '[data-paint=viscosity]': [0, 500], '[data-paint=volume]': [-20, 8], '[data-paint=thickness]': [2, 30],
      '[data-bone="move_mm.2"]': [-25, 25], '[data-bone="turn_deg.0"]': [-12, 12], '[data-key="motion.gain"]': [0, 500],
    })) assert.deepEqual(await limits(`${control} input[type=number]`), wanted, control);
    assert.deepEqual(await limits('#bone-hu'), [50, 2000], 'as protocol.json has it');
    // What is refused itself, and the end of a slider that is allowed less than it usually has.
    await page.click('#tab-tissue');
    const factor = page.locator('[data-key="tissue.region"] input[type=number]');
    await factor.fill('0');
    await factor.press('Enter');
    assert.equal(await factor.evaluate((input) => input.validationMessage), '0: > 0 – 500');
    await factor.blur();
    assert.equal(await factor.inputValue(), '1');
    const volume = page.locator('[data-key="tissue.region.volume_ml"] input[type=range]');
    await volume.focus();
    await page.keyboard.press('End');
    assert.equal(await volume.getAttribute('aria-valuetext'), '8 ml');
    await page.waitForFunction(() => document.querySelectorAll('#tabs .tab-name')[1]?.innerText === 'cheek, right: 8 ml added');
    // A strength above the end of its slider.
    await askWhatIf(page, 'right side 300');
    const strength = page.locator('[data-question=side_R] input[type=number]');
    await strength.waitFor();
    assert.deepEqual([await strength.inputValue(), await strength.getAttribute('max')], ['300', '400']);
    assert.equal(await page.locator('[data-question=side_R] input[type=range]').getAttribute('aria-valuetext'), '300 %');
    assert.deepEqual(complaints, []);
    await close();
  });

  const requested = (session) => session().requests.filter(({ changes }) => changes?.['tissue.region']).at(-1);

  test('volume is added to a part of the face: in the row of its stiffness, and 0 takes it away', async () => {
    const { page, complaints, session, close } = await openMadeUp(browser, () => []);
    await page.click('#tab-tissue');
    const volume = page.locator('[data-key="tissue.region.volume_ml"] input[type=number]');
    const called = (wanted) => page.waitForFunction((name) => document.querySelectorAll('#tabs .tab-name')[1]?.innerText === name, wanted);
    const enter = async (field, value) => {
      await field.fill(value);
      await field.press('Enter');
    };
    assert.equal(await volume.inputValue(), '0');
    await enter(volume, '2');
    await page.waitForFunction(() => document.getElementById('question-body').innerText.includes('cheek, right: 2 ml added'));
    assert.deepEqual([requested(session).face, requested(session).changes['tissue.region']], [1, [{ name: 'cheek_R', volume_ml: 2 }]]);
    await page.waitForFunction(() => /2 ml added, 1\.8 ml show at the skin/.test(document.querySelector('.tissue-panel .region .why').textContent));

    await enter(page.locator('[data-key="tissue.region"] input[type=number]'), '5');
    await called('cheek, right: 5 x, 2 ml added');
    assert.deepEqual(requested(session).changes['tissue.region'], [{ name: 'cheek_R', volume_ml: 2, young_factor: 5 }]);
    await enter(volume, '0');
    await called('cheek, right 5 x');
    assert.deepEqual(requested(session).changes['tissue.region'], [{ name: 'cheek_R', young_factor: 5 }]);
    assert.equal(await page.locator('.tissue-panel .region .why').isVisible(), false);

    // A tenth by an arrow key; less than is there is taken away.
    await page.locator('[data-key="tissue.region.volume_ml"] input[type=range]').focus();
    await page.keyboard.press('ArrowLeft');
    await called('cheek, right: 5 x, 0.1 ml taken away');
    await page.locator('[data-key="tissue.region"] .back').click();
    await page.locator('[data-key="tissue.region.volume_ml"] .back').click();
    await page.waitForFunction(() => document.querySelectorAll('#tabs .tab-name')[1]?.innerText === 'What if');
    assert.deepEqual(requested(session).changes['tissue.region'], [], 'an empty row is no row');
    assert.deepEqual(complaints, []);
    await close();
  });

  test('a painted patch adds volume, which the skin shows; without it the paint stays', async () => {
    const { page, complaints, session, close } = await openMadeUp(browser, () => []);
    await page.locator('#tab-paint').dispatchEvent('click');
    const volume = page.locator('[data-paint=volume] input[type=number]');
    await volume.fill('1.5');
    await volume.press('Enter');
    assert.match(await page.locator('#colour-bar').innerText(), /Share of added volume/);
    const { x, y, width, height } = await page.locator('#face').boundingBox();
    await page.mouse.move(x + width / 2, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(x + width / 2 + 20, y + height / 2, { steps: 3 });
    await page.mouse.up();
    await page.waitForFunction(() => document.getElementById('paint-patch').options[0].text === '1: 3 ×, 1.5 ml');
    await page.waitForFunction(() => document.querySelectorAll('#tabs .tab-name')[1]?.innerText === 'painted patch: 3 x, 1.5 ml added');
    assert.deepEqual(requested(session).changes['tissue.region'].map(({ painted: _file, ...rest }) => rest), [{ young_factor: 3, volume_ml: 1.5 }]);
    await volume.fill('0');
    await volume.press('Enter');
    await page.waitForFunction(() => document.querySelectorAll('#tabs .tab-name')[1]?.innerText === 'painted patch 3 x');
    assert.match(await page.locator('#colour-bar').innerText(), /Stiffness/);
    const [{ painted, ...rest }] = requested(session).changes['tissue.region'];
    assert.match(painted, /^painted-/);
    assert.deepEqual(rest, { young_factor: 3 });

    const { withVolume } = await imported('studio/patches.ts');
    assert.deepEqual(withVolume({ painted: 'a.csv', volume_ml: 2 }, 0), { painted: 'a.csv', young_factor: 1 }, 'a scene refuses a patch of nothing');
    assert.deepEqual(complaints, []);
    await close();
  });
});
