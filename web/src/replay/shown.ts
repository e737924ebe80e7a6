// SPDX-License-Identifier: GPL-3.0-or-later
// Which faces are looked at, and how. Whoever changes it, all views follow.

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

  /** Begins with base alone, and the first variant ready beside it. */
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

  /** Sets the number of faces. Faces that are gone are replaced by the last; listeners are called in any case. */
  setCount(count: number): void {
    this.count = count;
    const inside = (face: number) => Math.min(face, count - 1);
    this.choice = {
      first: inside(this.first), mode: count > 1 ? this.mode : 'single',
      // Ready beside base; where two are seen it may be base itself.
      second: inside(this.mode === 'single' ? this.second || 1 : this.second),
    };
    this.listeners.notify();
  }

  /** Changes what is named; faces that do not exist are left out, and a single face has one mode. */
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
