// SPDX-License-Identifier: GPL-3.0-or-later
// The colour map of displacements (viridis: even in lightness, safe for colour-blind readers).

const stops = [
  [68, 1, 84], [72, 36, 117], [65, 68, 135], [53, 95, 141], [42, 120, 142], [33, 145, 140],
  [34, 168, 132], [68, 191, 112], [122, 209, 81], [189, 223, 38], [253, 231, 37],
];

function srgbAt(share: number): number[] {
  const x = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
  const i = Math.min(Math.floor(x), stops.length - 2);
  return stops[i].map((c, k) => c + (x - i) * (stops[i + 1][k] - c));
}

export const linearOf = (byte: number): number => {
  const s = byte / 255;
  return s <= 0.04045 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4;
};

const size = 512;
const table = new Float32Array(3 * size);
for (let i = 0; i < size; ++i) table.set(srgbAt(i / (size - 1)).map(linearOf), 3 * i);

/** Writes the linear colour of `share` (0 to 1) at out[at .. at + 2]. */
export function putColour(share: number, out: Float32Array, at: number): void {
  const i = 3 * Math.min(size - 1, Math.max(0, Math.round(share * (size - 1))));
  out[at] = table[i];
  out[at + 1] = table[i + 1];
  out[at + 2] = table[i + 2];
}

export function cssGradient(direction: string): string {
  return `linear-gradient(${direction}, ${stops.map((c) => `rgb(${c.join(' ')})`).join(', ')})`;
}

/** The least of a few round numbers times a power of ten that is not below `value`. */
export function niceCeiling(value: number): number {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  for (const m of [1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10])
    if (m * power >= value * (1 - 1e-9)) return m * power;
  return 10 * power;
}

/** Fills the figure with a vertical bar from 0 to `topMm`. */
export function drawColourBar(figure: HTMLElement, topMm: number): void {
  const ticks = [1, 0.75, 0.5, 0.25, 0].map((share) => {
    const text = document.createElement('span');
    text.textContent = String(Number((share * topMm).toPrecision(3)));
    return text;
  });
  const caption = document.createElement('figcaption');
  caption.textContent = 'mm';
  const bar = document.createElement('div');
  bar.className = 'bar';
  bar.style.background = cssGradient('to top');
  const labels = document.createElement('div');
  labels.className = 'ticks';
  labels.append(...ticks);
  figure.replaceChildren(caption, bar, labels);
  figure.setAttribute('aria-label', `Colours: displacement from rest, 0 to ${topMm} mm`);
}
