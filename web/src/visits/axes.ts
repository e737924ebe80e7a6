// SPDX-License-Identifier: GPL-3.0-or-later
// Ranges of the curves and the numbers along their axes.
import type { VisitCurve } from './manifest';

export type Range = [low: number, high: number];

/** The least of 1, 2 and 5 times a power of ten that divides the range into at most `most` steps. */
export function stepOf([low, high]: Range, most: number): number {
  const rough = (high - low) / Math.max(most, 1);
  const power = 10 ** Math.floor(Math.log10(rough));
  return power * ([1, 2, 5].find((factor) => factor * power >= rough * (1 - 1e-9)) ?? 10);
}

export function ticksOf(range: Range, most: number): { value: number; text: string }[] {
  const step = stepOf(range, most);
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const [first, last] = [Math.ceil(range[0] / step - 1e-9), Math.floor(range[1] / step + 1e-9)];
  return Array.from({ length: Math.max(last - first + 1, 0) }, (_, i) => {
    const value = (first + i) * step;
    return { value, text: (Math.abs(value) < step / 2 ? 0 : value).toFixed(digits).replace('-', '−') };
  });
}

/** Ranges of all curves, so that both sides and all visits have one scale; null: nothing was measured. */
export function rangesOf(curves: VisitCurve[]): { time: Range; mm: Range } | null {
  const measured = curves.flatMap((curve) => curve.time_s.flatMap((time, i) => {
    const values = [curve.right_mm[i], curve.left_mm[i]].filter((value) => value !== null);
    return values.map((value) => [time, value] as const);
  }));
  if (measured.length === 0) return null;
  const least = (place: 0 | 1) => measured.reduce((found, point) => Math.min(found, point[place]), Infinity);
  const most = (place: 0 | 1) => measured.reduce((found, point) => Math.max(found, point[place]), -Infinity);
  const [from, to] = [least(0), most(0)];
  const high = Math.max(most(1) * 1.04, 1);
  return { time: to > from ? [from, to] : [from - 0.5, to + 0.5], mm: [Math.min(0, least(1)), high] };
}
