// SPDX-License-Identifier: GPL-3.0-or-later
// Remarks of the program on a run: how they are read, for which face they hold, and where the studio's page shows them.
// Needs no program.
import assert from 'node:assert/strict';
import { after, before, describe, test } from 'node:test';
import { launch } from './browser.mjs';
import { imported, script } from './modules.mjs';

const remark = (id, more = {}) => ({ id, severity: 'warning', text: `${id}.`, key: '', variant: '', ...more });

describe('remarks as values', async () => {
  const { remarksOf, sentenceOf, holdingFor, differingGains } = await imported('studio/remarks.ts');

  test('are read from a summary; an older one has none', () => {
    assert.deepEqual(remarksOf({ warnings: ['old'] }), []);
    assert.deepEqual(remarksOf({ remarks: 'none' }), []);
    assert.deepEqual(
      remarksOf({ remarks: [{ id: 'a', severity: 'note', text: 'A.' }, { id: 'b', severity: 'warning', text: 'B.', key: 'k.b', variant: 'v' }, { id: 'c' }] }),
      [remark('a', { severity: 'note', text: 'A.' }), remark('b', { text: 'B.', key: 'k.b', variant: 'v' })]);
  });

  test('are translated by id, else shown in the words of the program', () => {
    assert.equal(sentenceOf(remark('a'), { a: 'Auf Deutsch.' }), 'Auf Deutsch.');
    assert.equal(sentenceOf(remark('a'), { b: 'Auf Deutsch.' }), 'a.');
  });

  test('on a variant hold for that variant alone', () => {
    const all = [remark('scene'), remark('weak', { variant: 'weak' }), remark('stiff', { variant: 'stiff' })];
    assert.deepEqual(holdingFor('', all).map(({ id }) => id), ['scene']);
    assert.deepEqual(holdingFor('weak', all).map(({ id }) => id), ['scene', 'weak']);
  });

  test('on strengths are on those that differ from base', () => {
    assert.deepEqual(differingGains({ side_R: 0.5, zyg_major_L: 1 }, { frontalis_R: 0.2 }), ['side_R', 'frontalis_R']);
    assert.deepEqual(differingGains({ side_R: 0.5 }, { side_R: 0.5 }), []);
  });
});

describe('remarks beside controls', { concurrency: false }, () => {
  let browser, page;
  before(async () => {
    browser = await launch();
    page = await browser.newPage();
    await page.setContent(`<button id="tab-first"></button><button id="tab-rest"></button>
      <div id="panels"><div id="first"><label>One<input id="one" type="range"></label><label>Two<input id="two" type="range"></label></div>
      <div id="rest"></div></div>`);
    await page.addScriptTag({ content: await script('studio/remark_places.ts', 'places') });
    await page.evaluate(() => {
      const at = (id) => document.getElementById(id);
      const control = (id) => ({ box: at(id).parentElement, inputs: [at(id)] });
      window.variant = '';
      window.shown = new places.RemarkPlaces([
        { key: 'first', sections: ['first'], element: at('first'),
          controlsOf: ({ key }) => ({ 'first.one': [control('one')], 'first.all': [control('one'), control('two'), { box: at('rest'), inputs: [] }] })[key] ?? [] },
        { key: 'rest', sections: [''], element: at('rest'), controlsOf: () => [] },
      ], () => window.variant);
    });
  });
  after(() => browser?.close());
  const set = (remarks) => page.evaluate((all) => window.shown.set(all), remarks);
  /** Where each remark stands: the input or panel that holds it. */
  const standing = () => page.evaluate(() => Object.fromEntries([...document.querySelectorAll('[data-note-id]')]
    .map((note) => [note.dataset.noteId, note.parentElement.querySelector(':scope > input')?.id ?? note.parentElement.id])));
  const describing = (id) => page.evaluate((input) => (document.getElementById(input).getAttribute('aria-describedby') ?? '').split(' ')
    .filter((one) => one).map((one) => document.getElementById(one).textContent), id);

  test('stand at the control of their key, which they describe; without one at the top of its panel', async () => {
    await set([remark('a', { key: 'first.one' }), remark('b', { key: 'first.other' }), remark('c', { key: 'contact.lips' }), remark('d')]);
    assert.deepEqual(await standing(), { a: 'one', b: 'first', c: 'rest' });
    assert.deepEqual(await describing('one'), ['a.']);
    assert.deepEqual(await describing('first'), ['b.']);
    assert.deepEqual(await describing('two'), []);
    assert.deepEqual(await page.locator('.has-remark').evaluateAll((tabs) => tabs.map(({ id }) => id)), ['tab-first', 'tab-rest']);
  });

  test('go with their cause, and with the face that is edited', async () => {
    await set([remark('weak', { key: 'first.one', variant: 'weak' })]);
    assert.deepEqual(await standing(), {});
    assert.deepEqual(await describing('one'), []);
    await page.evaluate(() => { window.variant = 'weak'; window.shown.update(); });
    assert.deepEqual(await standing(), { weak: 'one' });
    await set([]);
    assert.equal(await page.locator('[aria-describedby], [data-note-id], .has-remark').count(), 0);
  });

  test('on many controls stand once, and describe each', async () => {
    await set([remark('many', { key: 'first.all' })]);
    assert.equal(await page.locator('[data-note-id=many]').count(), 1);
    assert.deepEqual(await standing(), { many: 'first' });
    assert.deepEqual([await describing('one'), await describing('two')], [['many.'], ['many.']]);
  });

  test('come only when no slider is held', async () => {
    await set([]);
    const { x, y } = await page.locator('#one').boundingBox();
    await page.mouse.move(x + 20, y + 5);
    await page.mouse.down();
    await set([remark('late', { key: 'first.one' })]);
    assert.deepEqual(await standing(), {});
    await page.mouse.up();
    await page.waitForSelector('[data-note-id=late]');
  });
});
