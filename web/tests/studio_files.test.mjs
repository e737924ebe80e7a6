// SPDX-License-Identifier: GPL-3.0-or-later
// Files that are chosen in the studio, on a made-up face with a made-up server: each wrong one is named with what was
// expected, a recording alone moves the face that is open, and no face is taken for the next one while that comes.
import assert from 'node:assert/strict';
import { File } from 'node:buffer'; // Debian 12's Node 18 has no global one
import { after, before, test } from 'node:test';
import { launch } from './browser.mjs';
import { openMadeUp } from './made_up_studio.mjs';
import { imported } from './modules.mjs';

let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

const file = (name, text) => ({ name, mimeType: 'application/octet-stream', buffer: Buffer.from(text, 'latin1') });
const recording = 'time_s,cheilion_L_x\n0,0\n';

async function open(remarksOf = () => []) {
  const studio = await openMadeUp(browser, remarksOf);
  const uploads = [];
  await studio.page.route('**/upload/*', (route) => {
    uploads.push(decodeURIComponent(route.request().url().split('/').pop()));
    return route.fulfill({ contentType: 'application/json', body: JSON.stringify({ name: uploads.at(-1) }) });
  });
  const choose = (...files) => studio.page.setInputFiles('#file-picker', files);
  const problem = async () => {
    await studio.page.waitForSelector('#open-panel > .problem:not([hidden])');
    return studio.page.locator('#open-panel > .problem').textContent();
  };
  return { ...studio, uploads, choose, problem };
}

test('each wrong file is named, with what it is and what was expected', async () => {
  const { choose, problem, uploads, complaints, close } = await open();
  const wrong = [
    [file('face.jpg', '\xff\xd8\xff'), /^face\.jpg is a picture: expected a scan .* a recording .* a scene/],
    [file('points.json', '{}'), /^points\.json is JSON: expected a scan .*Landmarks are loaded under/],
    [file('smile.mp4', 'this is no video'), /^smile\.mp4 is not a valid video, .*: expected a scan/],
    [file('visit2.csv', ''), /^visit2\.csv is empty: expected a scan/],
    [file('notes.docx', 'PK'), /^notes\.docx has an unknown format: expected a scan/],
  ];
  for (const [one, expected] of wrong) {
    await choose(one);
    assert.match(await problem(), expected);
  }
  await choose(file('a.csv', recording), file('b.csv', recording));
  assert.match(await problem(), /^One recording at a time: a\.csv, b\.csv/);
  await choose(file('a.ply', 'ply'), file('b.ply', 'ply'));
  assert.match(await problem(), /^One scan at a time: a\.ply, b\.ply/);
  assert.deepEqual(uploads, []);
  assert.deepEqual(complaints, []);
  await close();
});

test('a recording alone moves the face that is open, which stays in sight', async () => {
  const { page, choose, session, uploads, complaints, close } = await open();
  await choose(file('visit2.csv', recording));
  await page.waitForFunction(() => !document.querySelector('.open-now').textContent.startsWith('Reading'));
  for (let tries = 0; tries < 100 && !session().requests.some(({ name }) => name === 'open'); ++tries) await page.waitForTimeout(50);
  assert.deepEqual(session().requests.filter(({ name }) => name === 'open'), [{ name: 'open', what: 'current', recording: 'visit2.csv' }]);
  assert.deepEqual(uploads, ['visit2.csv']);
  assert.equal(await page.locator('html[data-opening]').count(), 0);
  assert.deepEqual(complaints, []);
  await close();
});

test('while another face comes neither the one before nor its figures are seen', async () => {
  const { page, choose, session, complaints, close } = await open();
  const seen = () => page.evaluate(() => ['#face', '#figures-body', '.transport'].map((one) => getComputedStyle(document.querySelector(one)).visibility));
  assert.deepEqual(await seen(), ['visible', 'visible', 'visible']);
  await choose(file('somebody.ply', 'ply'));
  await page.waitForSelector('html[data-opening]');
  assert.deepEqual(await seen(), ['hidden', 'hidden', 'hidden']);
  assert.equal(await page.locator('#opening').textContent(), 'Opening somebody.ply …');
  for (let tries = 0; tries < 100 && !session().requests.some(({ name }) => name === 'open'); ++tries) await page.waitForTimeout(50);
  await page.waitForTimeout(300);
  assert.deepEqual(await seen(), ['hidden', 'hidden', 'hidden'], 'until the next face is there');
  // Without a title it is called by its files, in the panel, above, and in the names of what is saved.
  session().title = '';
  session().faces[0].values = { ...session().faces[0].values, 'scan.file': '/own/uploads/somebody.ply', 'motion.file': '/own/uploads/visit2.csv' };
  session().scene();
  session().moved('face');
  await page.waitForSelector('html:not([data-opening])');
  assert.deepEqual(await seen(), ['visible', 'visible', 'visible']);
  for (const place of ['.open-now', '#scene-title']) assert.equal(await page.locator(place).textContent(), 'somebody.ply, moved by visit2.csv');
  assert.equal(await page.locator('html').getAttribute('data-subject'), 'somebody.ply, moved by visit2.csv');
  assert.deepEqual(complaints, []);
  await close();
});

test('doubts about landmarks and the head stand beside the figures, also after the page is loaded again', async () => {
  const doubt = 'landmark cheilion_L is 8 mm off';
  const { page, complaints, close } = await open(() => [
    { id: 'landmarks.doubtful', severity: 'warning', text: doubt, key: 'scan.landmarks', variant: '' },
    { id: 'lips.pass_through', severity: 'warning', text: 'lips pass', key: '', variant: '' },
  ]);
  for (let i = 0; i < 2; ++i) {
    const doubts = await page.locator('#figures-body .doubts li').allTextContents();
    assert.equal(doubts.length, 2, doubts.join('; '));
    assert.equal(doubts[0], doubt);
    assert.match(doubts[1], /pose is uncertain by up to 2\.6 mm and 1\.3°/);
    assert.deepEqual(await page.locator('#messages-panel li').allTextContents(), ['lips pass', doubt]);
    await page.reload();
    await page.waitForSelector('html[data-ready]');
  }
  assert.deepEqual(complaints, []);
  await close();
});

test('a video is distinguished from another file with its extension', async () => {
  const { kindOf } = await imported('studio/file_kinds.ts');
  const kind = (name, text) => kindOf(new File([Buffer.from(text, 'latin1')], name));
  assert.equal(await kind('a.mp4', '\0\0\0\x18ftypisom'), 'recording');
  assert.equal(await kind('a.avi', 'RIFF....AVI '), 'recording');
  assert.equal(await kind('a.webm', '\x1a\x45\xdf\xa3'), 'recording');
  assert.equal(await kind('a.MKV', 'nothing of it'), 'torn video');
  assert.equal(await kind('A.PLY', 'ply'), 'scan');
});
