// SPDX-License-Identifier: GPL-3.0-or-later
// What the skin looks like, in pixels: a scan's texture where it was on the scan, and a border that fades out.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { launch, openPage } from './browser.mjs';
import { fixture } from './fixtures.mjs';
import { look } from './pixels.mjs';

let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

/** The skin at rest, from the front. */
async function atRest(name) {
  const { page, close } = await openPage(browser, fixture(name), { viewport: { width: 960, height: 700 }, pixels: true });
  await page.waitForSelector('#face[data-frame]');
  await page.locator('#frame').fill('0');
  await page.waitForFunction(() => Number(document.getElementById('face').dataset.frame) === 0);
  return { page, close };
}

/** The middle row of pixels, or a column beside the middle, from the top. */
const pixels = (picture, along) =>
  picture.evaluate(({ width, height, data }, row) => {
    const at = (x, y) => [0, 1, 2].map((k) => data[4 * (y * width + x) + k]);
    if (row) return Array.from({ length: width }, (_, x) => at(x, Math.round(0.5 * height)));
    return Array.from({ length: height }, (_, y) => at(Math.round(0.42 * width), y));
  }, along === 'row');

test('a texture lies where it was on the scan, on both sides of its seam', async () => {
  const { page, close } = await atRest('textured.html');
  const row = (await pixels(await look(page), 'row')).map(([r]) => r);
  await close();
  // Stripes of red 60 and 230, eight over the picture; each half of the face has half of them, and the seam between the
  // halves joins a dark and a bright one. So red changes at every eighth of the face's width, once at its middle.
  const edges = [];
  for (let x = 3; x + 3 < row.length; ++x) {
    const step = Math.abs(row[x + 2] - row[x - 2]);
    if (step > 45 && step >= Math.abs(row[x + 1] - row[x - 3]) && step > Math.abs(row[x + 3] - row[x - 1]) && x - (edges.at(-1) ?? -9) > 4) edges.push(x);
  }
  const middle = row.length / 2;
  const inner = edges.filter((x) => Math.abs(x - middle) < 0.25 * row.length);
  const seam = inner.reduce((a, b) => (Math.abs(b - middle) < Math.abs(a - middle) ? b : a));
  assert.ok(Math.abs(seam - middle) < 4, `the seam is ${seam - middle} pixels from the middle`);
  const at = inner.indexOf(seam);
  assert.ok(at >= 2 && inner.length - at > 2, `edges at ${inner}`);
  const stripe = (inner[at + 2] - inner[at - 2]) / 4;
  for (const k of [-2, -1, 1, 2])
    assert.ok(Math.abs(inner[at + k] - seam - k * stripe) < 0.12 * stripe, `edge ${k} of ${inner}`);
});

test("skin fades out where the scan ends, and a colour map is cut there", async () => {
  const { page, close } = await atRest('plain.html');
  const widthOfEdge = async () => {
    const row = await pixels(await look(page), 'column');
    const far = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    const first = row.findIndex((pixel, y) => y > 8 && far(pixel, row[8]) > 12);
    const inside = row[first + 40];
    const whole = far(inside, row[first - 2]);
    const at = (share) => row.findIndex((pixel, x) => x >= first - 2 && far(pixel, row[first - 2]) > share * whole);
    return at(0.8) - at(0.2);
  };
  const skin = await widthOfEdge();
  await page.getByRole('button', { name: 'Displacement' }).click();
  const map = await widthOfEdge();
  await close();
  assert.ok(skin > 5, `skin ends within ${skin} pixels`);
  assert.ok(map <= 2, `a map ends within ${map} pixels`);
});
