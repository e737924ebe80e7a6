// SPDX-License-Identifier: GPL-3.0-or-later
// Which faces are shown, and how. All views follow its changes.

import { Listeners, type Undo } from '../page/listeners';

export type Mode = 'single' | 'side-by-side' | 'wipe';

export interface Choice {
  /** Places in `Replay.faces`. */
  first: number;
  /** The other face of two; kept while only one is shown. */
  second: number;
  mode: Mode;
}

export class Shown {
  private choice: Choice;
  private readonly listeners = new Listeners();

  /** Begins with base alone; the first variant is the second face. */
  constructor(private count: number) {
    this.choice = { first: 0, second: count > 1 ? 1 : 0, mode: 'single' };
  }

  get first(): number {
    return this.choice.first;
  }
  get second(): number {
    return this.choice.second;
  }
  get mode(): Mode {
    return this.choice.mode;
  }

  /** The faces now visible: one or two, left one first. */
  get visible(): number[] {
    return this.mode === 'single' ? [this.first] : [this.first, this.second];
  }

  onChange(listener: () => void): Undo {
    return this.listeners.add(listener);
  }

  /** Sets the number of faces. Removed faces are replaced by the last; listeners are called in any case. */
  setCount(count: number): void {
    this.count = count;
    const inside = (face: number) => Math.min(face, count - 1);
    this.choice = {
      first: inside(this.first), mode: count > 1 ? this.mode : 'single',
      // The other face; where two are shown it may be base itself.
      second: inside(this.mode === 'single' ? this.second || 1 : this.second),
    };
    this.listeners.notify();
  }

  /** Changes the given properties; faces that do not exist are ignored, and a single face has one mode. */
  set(change: Partial<Choice>): void {
    const exists = (face: number) => Number.isInteger(face) && face >= 0 && face < this.count;
    const next = { ...this.choice, ...change };
    if (!exists(next.first)) next.first = this.choice.first;
    if (!exists(next.second)) next.second = this.choice.second;
    if (this.count < 2) next.mode = 'single';
    const same = next.first === this.first && next.second === this.second && next.mode === this.mode;
    this.choice = next;
    if (!same) this.listeners.notify();
  }
}
