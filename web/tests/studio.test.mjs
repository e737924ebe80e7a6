// SPDX-License-Identifier: GPL-3.0-or-later
// The studio as a user has it: the program's own server and its page in Chromium.
//   HYPEREX=build/release/bin/hyperex node --test web/tests/studio.test.mjs
// SCREENSHOTS=FOLDER keeps pictures of the page in light and dark at three sizes, to be looked at.
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { mkdir, readFile, writeFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { launch, tooWide } from './browser.mjs';
import { askWhatIf, openStudio, placeOnFace, program, run, startStudio } from './studio_server.mjs';

const skip = program() ? false : 'the program is not built';
const axe = await readFile(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

const count = (page, what) => page.evaluate((key) => Number(document.documentElement.dataset[key] ?? 0), what);
const faces = (page) => page.locator('.tab-name').allInnerTexts();
const sceneText = (page) => page.locator('#scene-text').textContent();
/** Largest distance of a corner from rest in a face, mm, not rounded. */
const cornerMm = (page, face, side) =>
  page.locator(`.corner-table tr[data-face="${face}"] td[data-side=${side}]`).first().getAttribute('data-mm').then(Number);

/** After `act` another motion has come and is shown. */
async function afterMotion(page, act, more = 1) {
  const before = await count(page, 'motions');
  await act();
  await page.waitForFunction((n) => Number(document.documentElement.dataset.motions ?? 0) >= n, before + more);
}

/** Until the motion that is shown is that of the scene as it is. */
const settled = (page) => page.waitForFunction(() => document.documentElement.dataset.current === 'true');

/** Pulls a slider to a share of its length in steps, and holds it there. */
async function pull(page, range, to, steps = 8) {
  await range.scrollIntoViewIfNeeded();
  const { x, y, width, height } = await range.boundingBox();
  const [from, middle] = [Number(await range.inputValue()) / 1000, y + height / 2];
  // The thumb's middle does not reach the ends.
  const at = (share) => x + 8 + share * (width - 16);
  await page.mouse.move(at(from), middle);
  await page.mouse.down();
  for (let i = 1; i <= steps; ++i) {
    await page.mouse.move(at(from + ((to - from) * i) / steps), middle);
    await page.waitForTimeout(30);
  }
}

/** A variant whose muscles of a side keep so many per cent of their strength. */
async function weaker(page, side, percent) {
  await askWhatIf(page, `${side === 'R' ? 'right' : 'left'} side ${percent}`);
  await page.waitForFunction((to) => document.getElementById('scene-text').textContent.includes(`side_${to[0]}" = ${to[1]}`), [side, percent / 100]);
  await settled(page);
}

describe('the studio', { skip, concurrency: false }, () => {
  let browser;
  before(async () => (browser = await launch()));
  after(() => browser?.close());

  test('what if the right side had 70 % of its strength: beside base, in millimetres, as a picture, as a scene that runs', async (t) => {
    const studio = await startStudio([], { bands: true });
    t.after(() => studio.stop());
    const { page, complaints, close } = await openStudio(browser, studio.address);
    assert.equal(new URL(page.url()).hash, '', 'the token is gone from the address');
    assert.deepEqual(await faces(page), ['Base']);
    await weaker(page, 'R', 70);
    assert.deepEqual(await faces(page), ['Base', 'right side 70 %']);
    assert.equal(await page.evaluate(() => document.activeElement.dataset.face), '1', 'the face that was made has the focus');
    assert.equal(await page.locator('#canvas-host').getAttribute('data-mode'), 'side-by-side');
    const [baseR, ownR] = [await cornerMm(page, 0, 'right'), await cornerMm(page, 1, 'right')];
    assert.ok(ownR < baseR - 1 && ownR > 0.5 * baseR, `${baseR} to ${ownR} mm`);
    // Error bands follow by themselves.
    await page.waitForFunction(() => document.documentElement.dataset.bands === 'true');
    assert.match(await page.locator('.corner-table tr[data-face="1"] td[data-side=right]').innerText(), /\d\.\d+ mm less than base\s+\(± \d\.\d+ mm\)/);
    assert.ok(!(await page.locator('.no-band').count()));

    // Where it differs most, by either button.
    await page.click('#to-most');
    const most = await page.locator('#frame-label').innerText();
    await page.click('#to-peak');
    await page.click('#tab-figures');
    await page.click('.seek-most');
    assert.equal(await page.locator('#frame-label').innerText(), most);
    assert.ok((await page.locator('.seek-most').innerText()).endsWith(`at ${/\d\.\d+ s$/.exec(most)[0]}`), most);

    // What is written into the picture: figures of its time and of the whole motion, with what is uncertain.
    await page.evaluate(() => {
      window.written = [];
      const write = CanvasRenderingContext2D.prototype.fillText;
      CanvasRenderingContext2D.prototype.fillText = function (text, ...rest) {
        window.written.push(text);
        return write.call(this, text, ...rest);
      };
    });
    const [picture] = await Promise.all([page.waitForEvent('download'), page.click('#save-picture')]);
    const written = await page.evaluate(() => window.written.join(' '));
    const when = Number(/(\d\.\d+) s$/.exec(most)[1]).toFixed(3);
    assert.match(written, new RegExp(`Corners of the mouth at ${when} s: right \\d+\\.\\d mm, left \\d+\\.\\d mm`));
    assert.match(written, /At most, whole motion: right \d+\.\d mm, left \d+\.\d mm \(sides differ by \d\.\d ± \d\.\d mm/);
    assert.match(written, new RegExp(`right ${ownR.toFixed(1)} mm \\(moves ${(baseR.toFixed(1) - ownR.toFixed(1)).toFixed(1)} mm less than in base, ± \\d\\.\\d mm`));
    assert.match(written, /±: from jitter \(95 %\) and mesh \(one sample\) alone/);
    assert.match(picture.suggestedFilename(), /^a-smile-base-right-side-70.*\.png$/);
    assert.deepEqual([...(await readFile(await picture.path())).subarray(1, 4)].map((c) => String.fromCharCode(c)).join(''), 'PNG');

    // A video shows the motion once from its start.
    const [video] = await Promise.all([page.waitForEvent('download'), page.click('#save-video')]);
    assert.match(video.suggestedFilename(), /right-side-70\.webm$/);
    const film = await readFile(await video.path());
    assert.equal(film.readUInt32BE(0), 0x1a45dfa3, 'EBML, as WebM begins');
    assert.ok(film.length > 20_000, `${film.length} bytes`);
    assert.ok(await page.locator('#unsaved').isVisible());
    await writeFile(join(studio.folder, 'a-smile.toml'), 'not of the studio');
    await page.click('#save-menu');
    await page.waitForFunction(() => document.getElementById('save-name').value === 'a-smile-2');
    await page.fill('#save-name', 'weaker');
    await page.click('[data-save=scene]');
    await page.waitForSelector('.save-sheet .status:has-text("weaker.toml")');
    await page.keyboard.press('Escape');
    assert.ok(!(await page.locator('#unsaved').isVisible()));
    const file = join(studio.folder, 'weaker.toml');
    assert.equal(await readFile(file, 'utf8').then((text) => text.includes('side_R')), true);

    const out = join(studio.folder, 'out');
    await run(['run', file, '--out', out], studio);
    const summary = JSON.parse(await readFile(join(out, 'summary.json'), 'utf8'));
    const excursions = (holder) => holder.excursions.find(({ point }) => point === 'cheilion' || point === 'ibug68_48/54').excursion_mm;
    const runs = [excursions(summary.symmetry), excursions(summary.variants.table[1])];
    for (const [face, own] of runs.entries())
      for (const [side, name] of [['right', 'R'], ['left', 'L']]) {
        const shown = await cornerMm(page, face, side);
        assert.ok(Math.abs(shown - own[name]) <= 1e-6 * own[name], `face ${face}, ${side}: ${shown} here, ${own[name]} by hyperex run`);
      }
    assert.deepEqual(complaints, []);
    await close();
  });

  test('a slider makes a face beside base, moves it while it is pulled and changes it when let go; undo and redo', async (t) => {
    const studio = await startStudio([], { bands: true });
    t.after(() => studio.stop());
    const { page, complaints, close } = await openStudio(browser, studio.address);
    await page.click('#tab-tissue');
    const young = page.locator('[data-key="tissue.young_kpa"] input[type=range]');
    const place = () => young.evaluate((range) => range.getBoundingClientRect().top - document.getElementById('panels').scrollTop);
    const placed = await place();
    const before = await page.locator('[data-key="tissue.young_kpa"] input[type=number]').inputValue();
    await pull(page, young, 0.8, 12);
    await page.waitForFunction(() => Number(document.documentElement.dataset.shapes ?? 0) > 0);
    assert.deepEqual(await faces(page), ['Base', 'What if']);
    assert.equal(await place(), placed, 'nothing moves under the pointer while another face is made');
    await afterMotion(page, () => page.mouse.up());
    assert.equal(await place(), placed);
    await page.waitForFunction(() => /young_kpa/.test(document.getElementById('scene-text').textContent));
    await settled(page);
    const stiff = Number(/young_kpa = ([\d.]+)/.exec(await sceneText(page))[1]);
    assert.ok(stiff > 2 * Number(before), `${before} to ${stiff} kPa`);
    assert.equal(Number(await page.locator('[data-key="tissue.young_kpa"] input[type=number]').inputValue()), stiff);
    const changed = await cornerMm(page, 1, 'left');
    assert.ok(changed < (await cornerMm(page, 0, 'left')) - 1, 'stiffer tissue answers less');

    await page.keyboard.press('Control+z');
    await page.waitForFunction(() => !/young_kpa/.test(document.getElementById('scene-text').textContent));
    await settled(page);
    assert.equal(await page.locator('[data-key="tissue.young_kpa"] input[type=number]').inputValue(), before);
    await page.keyboard.press('Control+Shift+z');
    await page.waitForFunction(() => /young_kpa/.test(document.getElementById('scene-text').textContent));
    await settled(page);
    assert.equal(await cornerMm(page, 1, 'left'), changed, 'the same scene gives the same figures');

    // One part of the face, by its number.
    const factor = page.locator('[data-key="tissue.region"] input[type=number]');
    await page.selectOption('.part select', 'cheek_R');
    await factor.fill('5');
    await factor.press('Enter');
    await page.waitForFunction(() => /"young_factor" = 5/.test(document.getElementById('scene-text').textContent));
    await settled(page);
    assert.match(await sceneText(page), /"name" = "cheek_R"/);
    assert.match(await page.locator('#second-label').innerText(), /Cheek, right: stiffness × 5/);
    await page.locator('[data-key="tissue.region"] .back').click();
    await page.waitForFunction(() => !/young_factor/.test(document.getElementById('scene-text').textContent));
    await settled(page);
    await factor.fill('-5');
    await factor.press('Enter');
    assert.ok(!(await factor.evaluate((input) => input.validity.valid)), 'what is out of range is not sent');
    await factor.blur();
    assert.equal(await factor.inputValue(), '1', 'and does not stay');
    await factor.fill('');
    await factor.press('Enter');
    assert.equal(await factor.inputValue(), '1', 'nor does nothing');
    assert.doesNotMatch(await sceneText(page), /young_factor/);

    // Each panel opens where it was left.
    await page.locator('#panels').evaluate((panels) => (panels.scrollTop = 60));
    await page.click('#tab-paint');
    assert.equal(await page.locator('#panels').evaluate((panels) => panels.scrollTop), 0);
    await page.click('#tab-tissue');
    assert.equal(await page.locator('#panels').evaluate((panels) => panels.scrollTop), 60);

    // A muscle, by keys alone; its line lights up.
    await page.click('#tab-muscles');
    await page.locator('[data-gain=zygomatic_R]').focus();
    for (let i = 0; i < 3; ++i) await page.keyboard.press('PageDown');
    await page.waitForFunction(() => /zygomatic_R/.test(document.getElementById('scene-text').textContent));
    await settled(page);
    assert.match(await sceneText(page), /"zygomatic_R" = 0\.4/);
    const weak = await cornerMm(page, 1, 'right');
    assert.ok(weak < changed);

    // One muscle alone, and all again; the place of its curve stays while another face is made.
    await page.click('.muscle-group summary >> nth=1');
    const curve = page.locator('.muscle-group >> nth=1').locator('.activation').first();
    const high = await curve.evaluate((box) => box.offsetHeight);
    assert.ok(high > 10);
    await page.click('#tabs .tab-name >> nth=0');
    await page.waitForFunction(() => document.documentElement.dataset.bands === 'true');
    assert.equal(await page.locator('#tabs .tab-name').first().getAttribute('aria-pressed'), 'true', 'what comes leaves the face chosen');
    const slider = page.locator('.muscle-group >> nth=1').locator('input[data-gain$=_L]').first();
    const name = await slider.getAttribute('data-gain');
    await slider.focus();
    await page.keyboard.press('PageDown');
    await page.waitForFunction(() => document.querySelectorAll('.tab-name').length === 3);
    assert.equal(await curve.evaluate((box) => box.offsetHeight), high);
    await page.waitForFunction((gain) => document.getElementById('scene-text').textContent.includes(`"${gain}"`), name);
    await settled(page);
    await page.locator('.tab-more').nth(1).click();
    await page.click('.sheet:popover-open .entry:has-text("Delete")');
    await page.waitForFunction(() => document.querySelectorAll('.tab-name').length === 2);
    await page.click('#tabs .tab-name >> nth=1');
    await settled(page);
    const solo = page.locator('.muscle-group >> nth=1').getByRole('button', { name: 'R S: Solo Zygomaticus major, right' });
    await solo.click();
    await page.waitForFunction(() => /zyg_major_L" = 0/.test(document.getElementById('scene-text').textContent));
    await settled(page);
    assert.equal(await solo.getAttribute('aria-pressed'), 'true');
    assert.ok((await cornerMm(page, 1, 'left')) < 0.5 * changed, 'the other side hardly moves');
    await solo.click();
    await page.waitForFunction(() => !/zyg_major/.test(document.getElementById('scene-text').textContent));
    await settled(page);
    assert.match(await sceneText(page), /"zygomatic_R" = 0\.4/);
    const again = await cornerMm(page, 1, 'right');
    assert.ok(Math.abs(again - weak) <= 1e-5 * weak, `${weak}, then ${again} mm`);
    assert.deepEqual(complaints, []);
    await close();
  });

  test('variants from presets: added, renamed, duplicated, deleted; wipe and difference', async (t) => {
    const studio = await startStudio();
    t.after(() => studio.stop());
    const { page, complaints, close } = await openStudio(browser, studio.address);
    await askWhatIf(page, 'zygomaticus major, right 40');
    await page.waitForFunction(() => /zyg_major_R" = 0\.4/.test(document.getElementById('scene-text').textContent));
    await settled(page);
    assert.deepEqual(await faces(page), ['Base', 'zygomaticus major, right 40 %']);
    assert.match(await page.locator('#question-body').innerText(), /^right zygomaticus major\s+at/);
    assert.equal(await page.getByRole('spinbutton', { name: 'Strength of right zygomaticus major, %' }).inputValue(), '40');
    await page.click('#undo');
    await page.click('#undo');
    await page.waitForFunction(() => document.querySelectorAll('.tab-name').length === 1);
    await settled(page);

    await page.click('#what-if');
    await page.click('[data-choice=palsy_complete_L]');
    await page.waitForFunction(() => document.querySelectorAll('.tab-name').length === 2);
    await settled(page);
    assert.deepEqual(await faces(page), ['Base', 'palsy complete, left']);
    const [left, leftOfBase] = [await cornerMm(page, 1, 'left'), await cornerMm(page, 0, 'left')];
    assert.ok(left < 0.6 * leftOfBase, /* the other side drags it along */ `${left} of ${leftOfBase} mm`);

    await page.locator('.tab-name').nth(1).dblclick();
    await page.fill('.tab-rename', 'Left palsy');
    await page.keyboard.press('Enter');
    await page.waitForSelector('.tab-name:has-text("Left palsy")');
    await page.locator('.tab-more').first().click();
    await page.click('.sheet:popover-open .entry:has-text("Duplicate")');
    await page.waitForFunction(() => document.querySelectorAll('.tab-name').length === 3);
    await settled(page);
    assert.deepEqual(await faces(page), ['Base', 'Left palsy', 'Left palsy, copy']);
    const [copy, own] = [await cornerMm(page, 2, 'left'), await cornerMm(page, 1, 'left')];
    assert.ok(Math.abs(copy - own) <= 1e-5 * own, `${copy} of the copy, ${own} mm`);

    await page.click('#modes [data-mode=wipe]');
    await page.click('[data-colouring=difference]');
    assert.match(await page.locator('#colour-bar').innerText(), /Distance between the faces/);
    assert.equal(await page.locator('#canvas-host').getAttribute('data-mode'), 'wipe');
    await page.locator('.tab-more').nth(1).click();
    await page.click('.sheet:popover-open .entry:has-text("Delete")');
    await page.waitForFunction(() => document.querySelectorAll('.tab-name').length === 2);
    await settled(page);
    assert.equal(await page.locator('.corner-table tbody tr:not(.differs)').count(), 2);
    assert.deepEqual(complaints, []);
    await close();
  });

  test('landmarks: dragged over the skin and moved by keys, doubted, used', async (t) => {
    const studio = await startStudio();
    t.after(() => studio.stop());
    const { page, complaints, close } = await openStudio(browser, studio.address);
    await page.click('#open-files');
    await page.getByRole('button', { name: 'Correct them' }).click();
    const names = await page.locator('.landmark-choice option').allInnerTexts();
    assert.ok(names.length > 60 && new Set(names).size === names.length, `${names.length} points, each once`);
    // Where the cheek of the embedded face lies at rest.
    const [cheekX, cheekY] = await placeOnFace(page, 0.207, 0.554);
    const chosen = () => page.locator('.landmark-choice select').evaluate((select) => select.selectedOptions[0].text);
    await page.mouse.move(cheekX, cheekY);
    await page.mouse.down();
    for (let i = 1; i <= 6; ++i) await page.mouse.move(cheekX + 6 * i, cheekY + 5 * i);
    await page.mouse.up();
    assert.equal(await chosen(), 'Cheek, left');
    await page.waitForSelector('#landmarks-panel .doubts li');
    assert.match(await page.locator('#landmarks-panel .doubts').innerText(), /cheek_L is \d+\.\d mm/);
    await page.selectOption('.landmark-choice select', { label: 'Tip of the nose (pronasale)' });
    for (let i = 0; i < 3; ++i) await page.locator('#face').press('ArrowUp');
    await page.click('.landmark-buttons .primary');
    await page.waitForFunction(() => /landmarks/.test(document.getElementById('scene-text').textContent));
    await settled(page);
    await page.keyboard.press('Control+z');
    await page.waitForFunction(() => !/landmarks/.test(document.getElementById('scene-text').textContent));
    await settled(page);
    assert.deepEqual(complaints, []);
    await close();
  });

  test('files: what is no scan is refused in place; a scene opens; a server that dies and comes back', async (t) => {
    const studio = await startStudio();
    t.after(() => studio.stop());
    const { page, complaints, close } = await openStudio(browser, studio.address);
    const choose = async (name, text) => page.locator('#file-picker').setInputFiles({ name, mimeType: 'text/plain', buffer: Buffer.from(text) });
    await choose('broken.ply', 'ply\nformat nonsense\n');
    await page.waitForSelector('#open-panel > .problem:not([hidden])');
    assert.match(await page.locator('#open-panel > .problem').innerText(), /broken\.ply/);
    await choose('alone.csv', 'time_s\n');
    await page.waitForSelector('#open-panel > .problem:has-text("alone.csv")');
    assert.equal(await page.locator('html[data-opening]').count(), 0, 'the face that is open stays');

    const motions = await count(page, 'motions');
    await choose('mine.toml', 'title = "Mine"\nscan = { file = "embedded" }\nmotion = { file = "embedded" }\n[[variant]]\nname = "stiff"\ntissue.young_kpa = 900\n');
    await page.waitForFunction(() => document.getElementById('scene-title').textContent === 'Mine');
    await page.waitForFunction(() => document.querySelectorAll('.corner-table tbody tr:not(.differs)').length === 2);
    assert.deepEqual(await faces(page), ['Base', 'stiff']);
    assert.equal(await count(page, 'motions'), motions, 'a face, not another motion');
    await weaker(page, 'R', 80);
    assert.deepEqual(complaints, []);

    await studio.kill();
    await page.waitForSelector('#banner:not([hidden])');
    assert.match(await page.locator('#banner').innerText(), /does not answer/);
    // Another one in its place has another token, and offers what was not saved.
    const next = await startStudio([], { port: studio.port, folder: studio.folder });
    t.after(() => next.stop());
    await page.waitForSelector('#banner:has-text("refuses this page")');
    const again = await openStudio(browser, next.address);
    assert.match(await again.page.locator('.rescue').innerText(), /“Mine”, of \w+ \d+, \d{4}/);
    assert.deepEqual(await again.page.locator('.rescue button').allInnerTexts(), ['Open it', 'Leave it', 'Delete it…']);
    await again.page.click('.rescue button >> nth=0');
    await again.page.waitForFunction(() => /side_R/.test(document.getElementById('scene-text').textContent));
    await settled(again.page);
    assert.deepEqual(await faces(again.page), ['Base', 'stiff', 'right side 80 %']);
    assert.deepEqual(again.complaints, []);
    await again.close();
    await close();

    // Left again, and deleted when the question is answered with yes.
    await next.kill();
    const last = await startStudio([], { port: studio.port, folder: studio.folder });
    t.after(() => last.stop());
    const third = await openStudio(browser, last.address);
    third.page.on('dialog', (dialog) => dialog.accept());
    await third.page.click('.rescue button >> nth=2');
    await third.page.waitForSelector('.rescue', { state: 'hidden' });
    await third.page.reload();
    await third.page.waitForSelector('html[data-ready]');
    assert.ok(!(await third.page.locator('.rescue').isVisible()));
    assert.deepEqual(third.complaints, []);
    await third.close();
  });

  test('a page that is loaded again goes on; another window takes over; a wrong token is turned away', async (t) => {
    const studio = await startStudio();
    t.after(() => studio.stop());
    const first = await openStudio(browser, studio.address);
    await weaker(first.page, 'L', 50);
    await first.page.reload();
    await first.page.waitForSelector('html[data-ready]');
    assert.deepEqual(await faces(first.page), ['Base', 'left side 50 %']);
    const second = await openStudio(browser, studio.address);
    await first.page.waitForSelector('#banner:not([hidden])');
    assert.match(await first.page.locator('#banner').innerText(), /another window/);
    assert.deepEqual(await faces(second.page), ['Base', 'left side 50 %']);
    const stranger = await openStudio(browser, studio.address.replace(/#.*/, '#00112233445566778899aabbccddeeff'), { ready: false });
    await stranger.page.waitForSelector('#banner:not([hidden])');
    assert.match(await stranger.page.locator('#banner').innerText(), /refuses this page/);
    const blocked = await stranger.page.evaluate(() => new Promise((done) => {
      document.addEventListener('securitypolicyviolation', ({ effectiveDirective }) => done(effectiveDirective));
      fetch('http://127.0.0.1:9/').catch(() => setTimeout(() => done('none'), 500));
    }));
    assert.equal(blocked, 'connect-src', 'the page talks to its own server alone');
    for (const { complaints, close } of [first, second]) {
      assert.deepEqual(complaints, []);
      await close();
    }
    await stranger.close();
  });

  test('axe-core finds nothing, nothing is wider than the window: light and dark at three sizes', async (t) => {
    const studio = await startStudio();
    t.after(() => studio.stop());
    const shots = process.env.SCREENSHOTS;
    if (shots) await mkdir(shots, { recursive: true });
    let made = false;
    for (const colorScheme of ['light', 'dark'])
      for (const [name, viewport] of [['small', { width: 1280, height: 720 }], ['large', { width: 2560, height: 1440 }], ['tablet', { width: 820, height: 1180 }]]) {
        const { page, complaints, close } = await openStudio(browser, studio.address, { colorScheme, viewport });
        if (!made) await weaker(page, 'R', 70);
        made = true;
        await page.click('#modes [data-mode=side-by-side]');
        assert.ok((await tooWide(page)) <= 0, `${colorScheme} ${name}`);
        await page.evaluate(axe);
        for (const panel of ['muscles', 'tissue', 'figures', 'scene']) {
          await page.click(`#tab-${panel}`);
          const { violations, passes } = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
          assert.ok(passes.length >= 12);
          assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.slice(0, 3).map((n) => n.target.join(' ')).join(', ')}`), [], `${colorScheme} ${name} ${panel}`);
          if (shots) await writeFile(join(shots, `${colorScheme}-${name}-${panel}.png`), await page.screenshot());
        }
        await page.click('#what-if');
        const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
        assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.slice(0, 3).map((n) => n.target.join(' ')).join(', ')}`), []);
        if (shots) await writeFile(join(shots, `${colorScheme}-${name}-what-if.png`), await page.screenshot());
        assert.deepEqual(complaints, []);
        await close();
      }
    assert.ok(existsSync(studio.folder));
  });

  test('two millilitres in the right cheek: what shows at the skin, and one step back', async (t) => {
    const studio = await startStudio();
    t.after(() => studio.stop());
    const { page, complaints, close } = await openStudio(browser, studio.address);
    await page.click('#tab-tissue');
    const volume = page.locator('[data-key="tissue.region.volume_ml"] input[type=number]');
    await volume.fill('2');
    await volume.press('Enter');
    await page.waitForFunction(() => /"volume_ml" = 2/.test(document.getElementById('scene-text').textContent));
    await settled(page);
    const says = page.locator('.tissue-panel .region .why');
    await says.waitFor();
    const [, shows, most] = /^2 ml added, ([\d.]+) ml show at the skin, which moves by up to ([\d.]+) mm$/.exec(await says.textContent());
    assert.ok(shows > 1 && shows < 2.5 && most > 0.2 && most < 10, `${shows} ml, ${most} mm`);
    assert.deepEqual(await faces(page), ['Base', 'cheek, right: 2 ml added']);
    await volume.blur();
    await page.keyboard.press('Control+z');
    await page.waitForFunction(() => !/volume_ml/.test(document.getElementById('scene-text').textContent));
    await settled(page);
    assert.equal(await volume.inputValue(), '0');
    assert.equal(await says.isVisible(), false);
    assert.deepEqual(complaints, []);
    await close();
  });
});
