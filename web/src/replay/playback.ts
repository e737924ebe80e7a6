// SPDX-License-Identifier: GPL-3.0-or-later
// The clock: the time shown, and whether it runs. Independent of the data shown.
import { Listeners, type Undo } from '../page/listeners';

export class Playback {
  private t: number;
  private running = false;
  private last = 0;
  private readonly listeners = new Listeners();
  speed = 1;
  /** At the end, starts again; else stops there. */
  loop = true;

  constructor(private startS: number, private endS: number) {
    this.t = startS;
  }

  get timeS(): number {
    return this.t;
  }
  get playing(): boolean {
    return this.running;
  }

  onChange(listener: () => void): Undo {
    return this.listeners.add(listener);
  }

  /** Sets the times of another recording. The time shown is kept where it lies in both. */
  setRange(startS: number, endS: number): void {
    [this.startS, this.endS] = [startS, endS];
    this.t = Math.min(Math.max(this.t, startS), endS);
    if (!(endS > startS)) this.running = false;
    this.notify();
  }

  play(): void {
    if (this.running || !(this.endS > this.startS)) return;
    if (!this.loop && this.t >= this.endS) this.t = this.startS;
    this.running = true;
    this.last = performance.now();
    requestAnimationFrame(this.tick);
    this.notify();
  }

  pause(): void {
    if (!this.running) return;
    this.running = false;
    this.notify();
  }

  /** Stops at t. */
  seek(t: number): void {
    this.running = false;
    this.t = Math.min(Math.max(t, this.startS), this.endS);
    this.notify();
  }

  private readonly tick = (now: number): void => {
    if (!this.running) return;
    // A page that was hidden continues where it was.
    const step = Math.min(Math.max(now - this.last, 0) / 1e3, 0.25);
    this.last = now;
    this.t += step * this.speed;
    if (this.t > this.endS) {
      this.t = this.loop ? this.startS : this.endS;
      this.running = this.loop;
    }
    this.notify();
    if (this.running) requestAnimationFrame(this.tick);
  };

  private notify(): void {
    this.listeners.notify();
  }
}
