// SPDX-License-Identifier: GPL-3.0-or-later
// The frame shown and the stretch of time around it: slider, keys, buttons; calls its listeners.
export class Cursor {
  frame = 0;
  /** null: the whole recording. */
  window: [number, number] | null = null;
  private readonly listeners: (() => void)[] = [];

  constructor(private readonly timeS: number[]) {}

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  get last(): number {
    return Math.max(this.timeS.length - 1, 0);
  }

  goTo(frame: number): void {
    this.frame = Math.min(Math.max(Math.round(frame), 0), this.last);
    this.follow();
    this.notify();
  }

  /** The frame nearest to a time. */
  seek(timeS: number): void {
    let low = 0;
    let high = this.last;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.timeS[middle] <= timeS) low = middle;
      else high = middle;
    }
    this.goTo(this.timeS[high] - timeS < timeS - this.timeS[low] ? high : low);
  }

  /** `factor` < 1 shows less, around the frame shown; 0 shows all. */
  zoom(factor: number): void {
    const [first, last] = this.whole;
    const [from, to] = this.window ?? this.whole;
    const length = Math.max((to - from) * factor, (10 * (last - first)) / Math.max(this.last, 1));
    if (factor === 0 || length >= last - first) this.window = null;
    else this.window = this.around(this.timeS[this.frame], length);
    this.notify();
  }

  private get whole(): [number, number] {
    return [this.timeS[0] ?? 0, this.timeS[this.last] ?? 0];
  }

  private around(timeS: number, length: number): [number, number] {
    const [first, last] = this.whole;
    const from = Math.min(Math.max(timeS - length / 2, first), last - length);
    return [from, from + length];
  }

  /** The interval follows a frame that leaves it. */
  private follow(): void {
    if (!this.window) return;
    const [from, to] = this.window;
    const t = this.timeS[this.frame];
    if (t < from || t > to) this.window = this.around(t, to - from);
  }

  private notify(): void {
    for (const listener of this.listeners) listener();
  }
}

/** Left and right: a frame, with Shift ten; + and −: a shorter or longer stretch; 0: all. */
export function listenToKeys(cursor: Cursor): void {
  const keys: Record<string, (far: boolean) => void> = {
    ArrowLeft: (far) => cursor.goTo(cursor.frame - (far ? 10 : 1)),
    ArrowRight: (far) => cursor.goTo(cursor.frame + (far ? 10 : 1)),
    '+': () => cursor.zoom(0.5),
    '=': () => cursor.zoom(0.5),
    '-': () => cursor.zoom(2),
    '0': () => cursor.zoom(0),
  };
  document.addEventListener('keydown', (event) => {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey || event.altKey || target.closest('input[type=search]')) return;
    const go = keys[event.key];
    if (!go) return;
    event.preventDefault();
    go(event.shiftKey);
  });
}
