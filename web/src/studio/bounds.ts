// SPDX-License-Identifier: GPL-3.0-or-later
// What a scene allows of a number. The server sends it as the program describes it (StudioState.boundsOf).

export interface Bounds {
  low: number;
  high: number;
  /** `low` itself is refused. */
  above: boolean;
}

export const holds = ({ low, high, above }: Bounds, value: number): boolean => (above ? value > low : value >= low) && value <= high;

/** The ends of a slider, where they are allowed. */
export const clipped = ({ low, high }: Bounds, from: number, to: number): [number, number] => [Math.max(from, low), Math.min(to, high)];

/** Of a factor that is shown in per cent. */
export const inPercent = ({ low, high, above }: Bounds): Bounds => ({ low: 100 * low, high: 100 * high, above });
