// SPDX-License-Identifier: GPL-3.0-or-later
// The range of a number in a scene. The server sends the ranges that the program describes (StudioState.boundsOf).

export interface Bounds {
  low: number;
  high: number;
  /** `low` itself is refused. */
  above: boolean;
}

export const holds = ({ low, high, above }: Bounds, value: number): boolean => (above ? value > low : value >= low) && value <= high;

/** The range of a slider from `from` to `to`, without what is not allowed. */
export const clipped = ({ low, high }: Bounds, from: number, to: number): [number, number] => [Math.max(from, low), Math.min(to, high)];

/** The bounds of a factor that is shown in per cent. */
export const inPercent = ({ low, high, above }: Bounds): Bounds => ({ low: 100 * low, high: 100 * high, above });
