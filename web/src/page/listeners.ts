// SPDX-License-Identifier: GPL-3.0-or-later
// Whoever wants to be told of a change, until it does not any more.

/** Undoes what it was given for: a subscription. */
export type Undo = () => void;

export class Listeners<T = void> {
  private readonly all = new Set<(told: T) => void>();

  add(listener: (told: T) => void): Undo {
    // A listener of its own for each call, so that none takes another's place.
    const own = (told: T) => listener(told);
    this.all.add(own);
    return () => void this.all.delete(own);
  }

  tell(what: T): void {
    for (const listener of [...this.all]) if (this.all.has(listener)) listener(what);
  }
}

/** What has to be undone in the end, the last first. */
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
