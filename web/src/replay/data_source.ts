// SPDX-License-Identifier: GPL-3.0-or-later
// Where a replay comes from, and what of it may change while it is looked at: a report holds its own and nothing
// changes, the studio's server sends another whenever it has computed one.
import { Listeners, type Undo } from '../page/listeners';
import { readPageData } from '../page/page_data';
import { replayOf, type Moving, type Replay } from './data';
import type { Manifest } from './manifest';

/** "face": another skin, all views are made anew. "motion": the same skin moves otherwise, or other variants of it. */
export type Change = 'face' | 'motion';

export interface DataSource {
  /** The same object from one "face" to the next; its parts are exchanged. */
  readonly replay: Replay;
  onChange(listener: (change: Change) => void): Undo;
}

/** The page's own data. */
export function pageSource(): DataSource {
  const { manifest, block } = readPageData<Manifest>();
  return { replay: replayOf(manifest, block), onChange: () => () => {} };
}

/** Whose data are exchanged by whoever holds it. */
export class ChangingSource implements DataSource {
  private current: Replay | null = null;
  private readonly listeners = new Listeners<Change>();

  get replay(): Replay {
    if (!this.current) throw new Error('No face is open.');
    return this.current;
  }

  get open(): boolean {
    return this.current !== null;
  }

  onChange(listener: (change: Change) => void): Undo {
    return this.listeners.add(listener);
  }

  setFace(replay: Replay): void {
    this.current = replay;
    this.listeners.notify('face');
  }

  setMotion(moving: Moving): void {
    Object.assign(this.replay, moving);
    this.listeners.notify('motion');
  }
}
