// SPDX-License-Identifier: GPL-3.0-or-later
// The 3D view as people see it: decoded and kept in the browser, a handle here.

/** Pixels of a PNG: { width, height, data } with four bytes a pixel. */
export const decode = (page, png) =>
  page.evaluateHandle(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    return context.getImageData(0, 0, image.width, image.height);
  }, png.toString('base64'));

/** What lies over the picture, and is not the face. */
const over = '.colour-key, .save-tools { visibility: hidden !important; }';

/** The face, once it is drawn as finely as it will be. */
export async function look(page) {
  await page.waitForSelector('#face[data-at-rest="true"]');
  return decode(page, await page.locator('#face').screenshot({ style: over }));
}

/** Share of pixels that differ, in a part of the picture: { left, right, top, bottom } from 0 to 1. */
export const changedShare = (before, after, part = {}) =>
  before.evaluate((a, { b, left = 0, right = 1, top = 0, bottom = 1 }) => {
    if (a.width !== b.width || a.height !== b.height) throw new Error('the canvas changed its size');
    let [changed, all] = [0, 0];
    for (let y = Math.ceil(top * a.height); y < bottom * a.height; ++y)
      for (let x = Math.ceil(left * a.width); x < right * a.width; ++x, ++all) {
        const i = 4 * (y * a.width + x);
        const far = [0, 1, 2].reduce((sum, k) => sum + Math.abs(a.data[i + k] - b.data[i + k]), 0);
        if (far > 12) ++changed;
      }
    return changed / all;
  }, { b: after, ...part });

/** Share of the left half's pixels that differ from those at the same place in the right half, between labels and
 *  buttons. */
export const halvesDiffer = (picture) =>
  picture.evaluate(({ width, height, data }) => {
    const half = Math.floor(width / 2);
    let [changed, all] = [0, 0];
    for (let y = Math.ceil(0.2 * height); y < 0.85 * height; ++y)
      for (let x = 2; x < half - 2; ++x, ++all) {
        const [i, j] = [4 * (y * width + x), 4 * (y * width + x + width - half)];
        if ([0, 1, 2].reduce((sum, k) => sum + Math.abs(data[i + k] - data[j + k]), 0) > 24) ++changed;
      }
    return changed / all;
  });

export const distinctColours = (picture) =>
  picture.evaluate(({ data }) => {
    const seen = new Set();
    for (let i = 0; i < data.length; i += 4)
      seen.add((data[i] >> 3) * 1024 + (data[i + 1] >> 3) * 32 + (data[i + 2] >> 3));
    return seen.size;
  });

/** Share of pixels with a strong colour, from `left` to `right` (0 to 1). */
export const colourfulShare = (picture, part = {}) =>
  picture.evaluate(({ width, data }, { left = 0, right = 1 }) => {
    let [strong, all] = [0, 0];
    for (let i = 0; i < data.length; i += 4) {
      const x = ((i / 4) % width) / width;
      if (x < left || x >= right) continue;
      ++all;
      const rgb = [data[i], data[i + 1], data[i + 2]];
      if (Math.max(...rgb) - Math.min(...rgb) > 60) ++strong;
    }
    return strong / all;
  }, part);
