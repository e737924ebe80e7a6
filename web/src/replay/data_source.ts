// SPDX-License-Identifier: GPL-3.0-or-later
// The source of a replay. A report contains its replay, which never changes; the studio's server sends a new one
// whenever it has computed it.
import { Listeners, type Undo } from '../page/listeners';
import { readPageData } from '../page/page_data';
import { replayOf, type Moving, type Replay } from './data';
import type { Manifest } from './manifest';

/** "face": another skin, all views are made anew. "motion": a new motion of the same skin, or other variants. */
export type Change = 'face' | 'motion';

export interface DataSource {
  /** The same object until the next "face"; its parts are replaced. */
  readonly replay: Replay;
  onChange(listener: (change: Change) => void): Undo;
}

/** The page's own data. */
export function pageSource(): DataSource {
  const { manifest, block } = readPageData<Manifest>();
  return { replay: replayOf(manifest, block), onChange: () => () => {} };
}

/** A source whose owner replaces the data. */
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
