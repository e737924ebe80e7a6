// SPDX-License-Identifier: GPL-3.0-or-later
// Pages as they are printed.

const perMm = 96 / 25.4;
/** What the margins of A4 leave, in the page's pixels. */
export const a4 = { width: 186 * perMm, height: 273 * perMm };
export const millimetres = (px) => px / perMm;

/** Number of pages of a PDF. */
export const pagesOf = (pdf) => pdf.toString('latin1').match(/\/Type\s*\/Page\b/g)?.length ?? 0;

/** Lays the page out for the printer, or again for the screen, and waits until the page has noticed. */
export async function onPaper(page, on) {
  await page.emulateMedia({ media: on ? 'print' : 'screen' });
  await page.waitForSelector(on ? 'html.printing' : 'html:not(.printing)');
}
