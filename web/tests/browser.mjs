// SPDX-License-Identifier: GPL-3.0-or-later
// Chromium, and a page opened from the disk in it that remembers everything that should not happen.
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

/** WebGL is drawn in software, as there may be no GPU. Pages are put together without WebGL, which is less work. */
export const launch = () =>
  chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: [
      '--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-gpu-compositing',
      '--disable-background-networking', '--disable-component-update', '--no-first-run',
    ],
  });

/** The page's pictures have a quarter of the pixels in each direction: most time of a test goes into them. Whether a
 *  picture has changed shows in these too. */
export const fewPixels = (context) =>
  context.addInitScript(() => {
    try {
      sessionStorage.setItem('hyperex.picture-pixels', '0.25');
    } catch {
      // A page that may keep nothing has all pixels.
    }
  });

/** Waits until the page says that it is ready. `complaints`: errors, warnings and requests. `init`: a
 *  script that runs before the page's own. `pixels`: all of them, as readers see pictures. `readyMs`: from requesting the page until it is ready. */
export async function openPage(browser, file, { init, pixels = false, ...options } = {}) {
  const context = await browser.newContext({
    viewport: { width: 1360, height: 900 }, reducedMotion: 'reduce', ...options,
  });
  if (!pixels) await fewPixels(context);
  if (init) await context.addInitScript(init);
  const page = await context.newPage();
  page.setDefaultTimeout(60_000);
  const complaints = [];
  const address = pathToFileURL(file).href;
  page.on('console', (message) => {
    // Reading pixels back, as the tests do, is slow, and software drivers and Chromium say so.
    if (/GPU stall due to ReadPixels|readback operations using getImageData/.test(message.text())) return;
    if (['error', 'warning'].includes(message.type())) complaints.push(message.text());
  });
  page.on('pageerror', (error) => complaints.push(String(error)));
  page.on('request', (request) => {
    const url = request.url();
    if (url !== address && !/^(data|blob):/.test(url)) complaints.push(`request to ${url}`);
  });
  const asked = performance.now();
  await page.goto(address);
  await page.waitForSelector('html[data-ready]', { timeout: 60_000 });
  const readyMs = performance.now() - asked;
  return { page, complaints, readyMs, close: () => context.close() };
}

/** By how many pixels the page is wider than its window. */
export const tooWide = (page) =>
  page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
