// SPDX-License-Identifier: GPL-3.0-or-later
// Values and changes as the table prints them.
import { fixed } from '../page/format';
import type { Change, Measure, Value } from './manifest';

const digitsOf = (unit: Measure['unit']): number => (unit === '%' ? 0 : 1);

/** "+2.1": a change always has a sign, a value only if it is negative. */
const withSign = (text: string): string => (text.startsWith('−') || Number(text) === 0 ? text : `+${text}`);

export interface Figure {
  value: string;
  interval: string;
}

const interval = (low: number | null, high: number | null, digits: number): string =>
  low === null || high === null ? 'not known' : `${fixed(low, digits)} to ${fixed(high, digits)}`;

export function valueFigure({ value, low, high }: Value, unit: Measure['unit']): Figure {
  const digits = digitsOf(unit);
  return { value: fixed(value, digits), interval: interval(low, high, digits) };
}

/** With one more decimal where a bound would print as 0 beside a change that is beyond. */
function changeDigits({ low, high, beyond }: Change, unit: Measure['unit']): number {
  const digits = digitsOf(unit);
  const toNothing = [low, high].some((bound) => bound !== null && bound !== 0 && Number(bound.toFixed(digits)) === 0);
  return beyond === 'yes' && toNothing ? digits + 1 : digits;
}

export function changeFigure(change: Change, unit: Measure['unit']): Figure & { measured: string } {
  const digits = changeDigits(change, unit);
  return {
    value: withSign(fixed(change.value, digits)),
    interval: interval(change.low, change.high, digits),
    measured: interval(change.low_measured, change.high_measured, digits),
  };
}

/** Measures that differ by their side alone, in the order of their first; right before left. */
export function grouped(measures: Measure[]): Measure[][] {
  const groups = new Map<string, Measure[]>();
  for (const measure of measures) {
    const name = JSON.stringify([measure.key, measure.words, measure.unit]);
    groups.set(name, [...(groups.get(name) ?? []), measure]);
  }
  const order = ['R', 'L', ''];
  return [...groups.values()].map((group) => group.sort((a, b) => order.indexOf(a.side) - order.indexOf(b.side)));
}
