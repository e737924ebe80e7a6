// SPDX-License-Identifier: GPL-3.0-or-later
// The paper: one page A4. Letters and distances shrink together until all fits; the least size can still be read.
import { whenPrinting } from '../page/printing';

/** What the margins leave (scale.css). */
const heightMm = 273;
const perMm = 96 / 25.4;
/** Scale relative to the style sheet's size. */
const [largest, least, step] = [1.22, 0.78, 0.02];

function fits(): boolean {
  const { body } = document;
  const wide = [...document.querySelectorAll<HTMLElement>('.table-box, .face-row')].some((box) => box.scrollWidth > box.clientWidth + 1);
  // Printers break lines a little differently.
  return !wide && body.getBoundingClientRect().height <= 0.985 * heightMm * perMm;
}

/** What does not fit in the least size takes a second page in the usual one. */
function fit(): void {
  const { style } = document.documentElement;
  for (let size = largest; size >= least; size -= step) {
    style.setProperty('--fit', size.toFixed(2));
    if (fits()) return;
  }
  style.setProperty('--fit', '1');
}

export function fitOnPaper(draw: () => void): void {
  whenPrinting((on) => {
    if (on) fit();
    draw();
  });
}
