// SPDX-License-Identifier: GPL-3.0-or-later
// How finely pictures are drawn. Without a graphics processor, pictures in motion have few pixels, and the last one is
// drawn once more with all.
import { remembered } from '../../page/remember';
import { drawsInSoftware } from '../software_gl';

/** After this many late pictures in a row, pictures in motion stay coarse: switching back and forth would be visible.
 *  */
const lateInARow = 3;

/** Pixels for each of the page's while something moves: the face has most of the window, and each pixel costs. */
const inMotion = 0.8;
const whenLate = 0.7;
/** Edges are not smoothed: more pixels in each direction make them smooth. */
const atRest = 2;

export class PicturePace {
  readonly software = drawsInSoftware();
  /** More live shapes follow as fast as they are drawn, computed on the same processor. */
  streaming = false;
  /** Factor on the number of pixels in each direction, where the processor draws. 1, unless a browser test has stored a
   *  smaller one to save time. */
  private readonly share = Number(remembered('picture-pixels') ?? 1);
  private drawnAt = 0;
  private late = 0;
  private timer = 0;

  /** Pixels of the picture for each of the page's. */
  get ratio(): number {
    if (!this.software) return Math.min(window.devicePixelRatio, 2);
    return this.share * (this.late < lateInARow && !this.streaming ? inMotion : inMotion * whenLate);
  }

  /** Pixel ratio of the picture at rest. */
  get fineRatio(): number {
    return this.share * atRest;
  }

  /** After a picture that was begun at `time`, ms. `refine` is called when no other follows. */
  drawn(time: number, playing: boolean, live: boolean, refine: () => void): void {
    const gap = time - this.drawnAt;
    this.drawnAt = time;
    if (this.late < lateInARow) this.late = (playing || live) && gap > 50 && gap < 400 ? this.late + 1 : 0;
    this.stop();
    // A slider that is held still soon moves on.
    if (!playing) this.timer = window.setTimeout(refine, live ? 700 : 150);
  }

  stop(): void {
    clearTimeout(this.timer);
  }
}
