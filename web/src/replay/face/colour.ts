// SPDX-License-Identifier: GPL-3.0-or-later
// The colour maps and the bar that explains them. Even steps of a map look evenly far apart: equal steps
// of lightness along a curve in OKLab (Ottosson 2020, https://bottosson.github.io/posts/oklab).
// Their lightness alone orders the values, so colour-blind readers and grey prints keep them. All begin pale:
// a face that hardly moves must not look like a hole.

export type RampName = 'moss' | 'embers' | 'sea' | 'plum';

type Rgb = [number, number, number];

const ramps: Record<RampName, Rgb[]> = {
  // From pale, where nothing moves, to dark green. OKLCH lightness 0.91 to 0.34, hue 100 to 165 degrees.
  moss: [
    [228, 226, 211], [210, 209, 172], [188, 194, 134], [163, 180, 102], [134, 166, 79], [106, 151, 67],
    [79, 135, 63], [55, 119, 61], [32, 102, 57], [9, 85, 53], [0, 68, 46],
  ],
  // From pale, where nothing differs, to dark red. OKLCH lightness 0.90 to 0.33, hue 85 to 18 degrees.
  embers: [
    [226, 222, 213], [218, 201, 173], [212, 180, 134], [213, 155, 96], [215, 128, 61], [215, 98, 33],
    [198, 73, 28], [179, 47, 27], [157, 23, 29], [130, 15, 30], [103, 7, 27],
  ],
  // OKLCH lightness 0.91 to 0.35, hue 150 to 275 degrees.
  sea: [
    [219, 228, 220], [184, 216, 204], [146, 203, 198], [113, 187, 192], [82, 169, 188], [58, 150, 183],
    [44, 130, 175], [38, 110, 166], [41, 89, 151], [44, 69, 133], [44, 50, 114],
  ],
  // OKLCH lightness 0.91 to 0.33, hue 350 to 300 degrees.
  plum: [
    [230, 221, 225], [232, 195, 214], [228, 169, 206], [220, 145, 201], [206, 121, 196], [187, 99, 189],
    [164, 80, 180], [138, 66, 165], [113, 52, 148], [89, 39, 131], [66, 26, 113],
  ],
};

/** The colour of vertices without a value; no ramp has a similar one. */
const noValue: Rgb = [128, 128, 128];

function colourAt(stops: Rgb[], share: number): Rgb {
  const x = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
  const i = Math.min(Math.floor(x), stops.length - 2);
  return stops[i].map((c, k) => c + (x - i) * (stops[i + 1][k] - c)) as Rgb;
}

/** `size` colours from the map's first to its last, sRGB and opaque, four bytes each; then as many of the colour for no
 *  value. */
export function rampBytes(name: RampName, size: number): Uint8Array<ArrayBuffer> {
  const out = new Uint8Array(8 * size);
  for (let i = size; i < 2 * size; ++i) out.set([...noValue, 255], 4 * i);
  for (let i = 0; i < size; ++i)
    out.set([...colourAt(ramps[name], i / (size - 1)).map(Math.round), 255], 4 * i);
  return out;
}

/** The map's colours at even steps, as style sheets and canvases write them. */
export const rampStops = (name: RampName): string[] => ramps[name].map((c) => `rgb(${c.join(' ')})`);

export const linearOf = (byte: number): number => {
  const s = byte / 255;
  return s <= 0.04045 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4;
};

/** The least of a few round numbers times a power of ten that is not below `value`. */
export function niceCeiling(value: number): number {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  for (const m of [1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10])
    if (m * power >= value * (1 - 1e-9)) return m * power;
  return 10 * power;
}
