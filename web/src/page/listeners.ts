// SPDX-License-Identifier: GPL-3.0-or-later
// Functions that are called after each change, until they unsubscribe.

/** Ends a subscription, or reverses the call that returned it. */
export type Undo = () => void;

export class Listeners<T = void> {
  private readonly all = new Set<(value: T) => void>();

  add(listener: (value: T) => void): Undo {
    // A new function for each call: the same listener may be added twice.
    const own = (value: T) => listener(value);
    this.all.add(own);
    return () => void this.all.delete(own);
  }

  notify(value: T): void {
    for (const listener of [...this.all]) if (this.all.has(listener)) listener(value);
  }
}

/** Collects functions that clean up at the end, called in reverse order. */
export class Undoing {
  private readonly all: Undo[] = [];
  private readonly events = new AbortController();

  /** For addEventListener: ends with all else. */
  get signal(): AbortSignal {
    return this.events.signal;
  }

  add(...undo: Undo[]): void {
    this.all.push(...undo);
  }

  undo(): void {
    this.events.abort();
    for (const undo of this.all.splice(0).reverse()) undo();
  }
}
