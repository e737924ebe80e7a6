// SPDX-License-Identifier: GPL-3.0-or-later
// The clock: what time is shown, and whether it runs. Knows nothing of what is shown.

export class Playback {
  private t: number;
  private running = false;
  private last = 0;
  private readonly listeners: (() => void)[] = [];
  speed = 1;

  constructor(private readonly startS: number, private readonly endS: number) {
    this.t = startS;
  }

  get timeS(): number {
    return this.t;
  }
  get playing(): boolean {
    return this.running;
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  play(): void {
    if (this.running || !(this.endS > this.startS)) return;
    this.running = true;
    this.last = performance.now();
    requestAnimationFrame(this.tick);
    this.tell();
  }

  pause(): void {
    if (!this.running) return;
    this.running = false;
    this.tell();
  }

  /** Stops at t. */
  seek(t: number): void {
    this.running = false;
    this.t = Math.min(Math.max(t, this.startS), this.endS);
    this.tell();
  }

  private readonly tick = (now: number): void => {
    if (!this.running) return;
    // A page that was hidden goes on where it was.
    const step = Math.min(Math.max(now - this.last, 0) / 1e3, 0.25);
    this.last = now;
    this.t += step * this.speed;
    if (this.t > this.endS) this.t = this.startS;
    this.tell();
    requestAnimationFrame(this.tick);
  };

  private tell(): void {
    for (const listener of this.listeners) listener();
  }
}
