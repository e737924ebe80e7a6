// SPDX-License-Identifier: GPL-3.0-or-later
// The visit that is compared with the first: the last, until the reader chooses another.
import { Listeners } from '../page/listeners';

export class Choice {
  private chosen: number;
  private readonly listeners = new Listeners();

  constructor(readonly count: number) {
    this.chosen = Math.max(count - 1, 0);
  }

  get visit(): number {
    return this.chosen;
  }

  choose(visit: number): void {
    this.chosen = visit;
    this.listeners.notify();
  }

  onChange(listener: () => void): void {
    this.listeners.add(listener);
  }
}

/** At most four visits for the paper, evenly spaced, the first, the chosen and the last among them. */
export function printedVisits(count: number, chosen: number): number[] {
  if (count <= 4) return Array.from({ length: count }, (_, i) => i);
  const last = count - 1;
  const printed = [0, Math.round(last / 3), Math.round((2 * last) / 3), last];
  if (printed.includes(chosen)) return printed;
  const nearest = Math.abs(chosen - printed[1]) <= Math.abs(chosen - printed[2]) ? 1 : 2;
  printed[nearest] = chosen;
  return printed.sort((a, b) => a - b);
}
