// SPDX-License-Identifier: GPL-3.0-or-later
// The saved video of the studio, on a made-up face with a made-up server: a picture for each frame of the motion, each at
// its own time, however slow the machine is; by the browser's encoder, and by its recorder where it has none.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { launch } from './browser.mjs';
import { openMadeUp } from './made_up_studio.mjs';
import { decode } from './pixels.mjs';

const pictures = process.env.SCREENSHOTS;
let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

/** The elements of EBML from `at` to `end`: [id, from, to]; those of unknown length reach to the end. */
function* elements(bytes, at = 0, end = bytes.length) {
  const size = (i) => Math.clz32(bytes[i]) - 23;
  for (let i = at; i < end;) {
    const idSize = size(i);
    const id = bytes.subarray(i, i + idSize).toString('hex');
    const lengthSize = size((i += idSize));
    const raw = [...bytes.subarray(i, i + lengthSize)].map((b, k) => (k === 0 ? b & (0xff >> lengthSize) : b));
    const unknown = raw.every((b, k) => b === (k === 0 ? 0xff >> lengthSize : 0xff));
    const length = raw.reduce((sum, b) => 256 * sum + b, 0);
    i += lengthSize;
    const to = unknown ? end : Math.min(i + length, end);
    yield [id, i, to];
    i = to;
  }
}

/** Times of all pictures in the file, ms. */
function timesOf(bytes) {
  const times = [];
  const walk = (from, to) => {
    let start = 0;
    for (const [id, at, end] of elements(bytes, from, to)) {
      if (id === '18538067' || id === '1f43b675' || id === 'a0') walk(at, end);
      else if (id === 'e7') start = bytes.subarray(at, end).reduce((sum, b) => 256 * sum + b, 0);
      else if (id === 'a3' || id === 'a1') times.push(start + bytes.readInt16BE(at + 1));
    }
  };
  walk(0, bytes.length);
  return times;
}

/** Plays it in the page: how long, and how many of the pictures at these times differ. */
const played = (page, bytes, timesMs) => page.evaluate(async ([base64, times]) => {
  const video = document.createElement('video');
  video.muted = true;
  video.src = URL.createObjectURL(new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], { type: 'video/webm' }));
  await new Promise((done, fail) => {
    video.onloadeddata = done;
    video.onerror = () => fail(new Error(video.error.message));
  });
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [video.videoWidth, video.videoHeight];
  const seen = new Set();
  for (const ms of times) {
    await new Promise((done) => {
      video.onseeked = done;
      video.currentTime = (ms + 1) / 1e3;
    });
    canvas.getContext('2d').drawImage(video, 0, 0);
    seen.add(canvas.toDataURL());
  }
  return { duration: video.duration, width: canvas.width, height: canvas.height, distinct: seen.size, last: canvas.toDataURL().split(',')[1] };
}, [bytes.toString('base64'), timesMs]);

async function saved(page) {
  const [download] = await Promise.all([page.waitForEvent('download'), page.locator('#save-video').click()]);
  return readFile(await download.path());
}

/** Makes drawing as slow as on a slow or busy machine. */
const slowly = () => {
  const draw = HTMLCanvasElement.prototype.getContext;
  HTMLCanvasElement.prototype.getContext = function (...args) {
    const context = draw.apply(this, args);
    if (args[0] !== '2d' || !context || context.slow) return context;
    const { drawImage } = context;
    context.slow = true;
    context.drawImage = (...parts) => {
      for (const until = performance.now() + 400; performance.now() < until;);
      drawImage.apply(context, parts);
    };
    return context;
  };
};

const titleHeight = 58;
const stageOf = (page) => page.locator('#canvas-host').evaluate((e) => [e.clientWidth & ~1, e.clientHeight & ~1]);

/** How many colours a row of the picture has. */
const coloursIn = (picture, row) => picture.evaluate(({ data, width }, y) => {
  const seen = new Set();
  for (let i = 4 * y * width; i < 4 * (y + 1) * width; i += 4) seen.add([0, 1, 2].map((k) => data[i + k] >> 5).join());
  return seen.size;
}, row);

test('has the title, and the colour bar of a coloured face', async () => {
  const { page, complaints, close } = await openMadeUp(browser, () => []);
  await page.locator('#colouring [data-colouring=displacement]').click();
  const [, stageHeight] = await stageOf(page);
  const { height, last } = await played(page, await saved(page), [0]);
  const barHeight = height - titleHeight - stageHeight;
  assert.ok([76, 92].includes(barHeight), `${barHeight} pixels`);
  const picture = await decode(page, Buffer.from(last, 'base64'));
  assert.ok(await coloursIn(picture, titleHeight + stageHeight + 32) > 5, 'the bar');
  assert.ok(await coloursIn(picture, titleHeight / 2) > 1, 'the title');
  assert.deepEqual(complaints, []);
  await close();
});

test('has a picture for each frame of the motion, at its time, on a slow machine too', async () => {
  const { page, complaints, close } = await openMadeUp(browser, () => [], { init: slowly });
  assert.equal(await page.locator('#save-video').textContent(), 'Save video');
  const bytes = await saved(page);
  // Times of the made-up motion.
  assert.deepEqual(timesOf(bytes), [0, 500, 1000]);
  const { duration, width, height, distinct, last } = await played(page, bytes, [0, 500, 1000]);
  assert.equal(distinct, 3);
  assert.ok(Math.abs(duration - 1.5) < 0.01, `${duration} s`);
  assert.deepEqual([width, height - titleHeight], await stageOf(page));
  if (pictures) await (await import('node:fs/promises')).writeFile(join(pictures, 'video_last.png'), Buffer.from(last, 'base64'));
  assert.equal(await page.locator('#save-video').textContent(), 'Save video', 'done');
  assert.deepEqual(complaints, []);
  await close();
});

test('keeps the speed that is chosen, and leaves the time that was shown', async () => {
  const { page, close } = await openMadeUp(browser, () => []);
  await page.locator('#speed').selectOption('0.5');
  await page.locator('#frame').fill('1');
  assert.deepEqual(timesOf(await saved(page)), [0, 1000, 2000]);
  assert.equal(await page.locator('#frame').inputValue(), '1');
  await close();
});

test('a browser without an encoder records as many', async () => {
  const { page, complaints, close } = await openMadeUp(browser, () => [], { init: () => delete window.VideoEncoder });
  const bytes = await saved(page);
  const times = timesOf(bytes);
  assert.ok(times.length >= 3, String(times));
  assert.equal((await played(page, bytes, times)).distinct, 3);
  assert.deepEqual(complaints, []);
  await close();
});
