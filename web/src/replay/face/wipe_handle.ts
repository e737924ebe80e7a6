// SPDX-License-Identifier: GPL-3.0-or-later
// The vertical line between two faces in one place: dragged, or moved with the arrow keys.

export class WipeHandle {
  private share = 0.5;

  constructor(
    private readonly handle: HTMLElement,
    private readonly host: HTMLElement,
    private readonly names: () => [string, string],
    private readonly moved: (share: number) => void,
    signal: AbortSignal,
  ) {
    handle.addEventListener('pointerdown', (event) => {
      event.preventDefault();
      handle.focus();
      handle.setPointerCapture(event.pointerId);
    }, { signal });
    handle.addEventListener('pointermove', (event) => {
      if (!handle.hasPointerCapture(event.pointerId)) return;
      const box = host.getBoundingClientRect();
      this.moveTo((event.clientX - box.left) / box.width);
    }, { signal });
    handle.addEventListener('keydown', (event) => this.press(event), { signal });
    this.moveTo(this.share);
  }

  get at(): number {
    return this.share;
  }

  show(visible: boolean): void {
    this.handle.hidden = !visible;
    this.moveTo(this.share);
  }

  private press(event: KeyboardEvent): void {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const step = event.shiftKey ? 0.1 : 0.02;
    const target: Record<string, number> = {
      ArrowLeft: this.share - step, ArrowDown: this.share - step,
      ArrowRight: this.share + step, ArrowUp: this.share + step,
      PageDown: this.share - 0.1, PageUp: this.share + 0.1, Home: 0, End: 1,
    };
    if (!(event.key in target)) return;
    event.preventDefault();
    event.stopPropagation(); // these keys step through the frames elsewhere
    this.moveTo(target[event.key]);
  }

  private moveTo(share: number): void {
    this.share = Math.min(Math.max(share, 0), 1);
    const percent = Math.round(100 * this.share);
    const [left, right] = this.names();
    this.handle.setAttribute('aria-valuenow', String(percent));
    this.handle.setAttribute('aria-valuetext', `${percent} % ${left}, ${100 - percent} % ${right}`);
    this.host.style.setProperty('--wipe', `${100 * this.share}%`);
    this.moved(this.share);
  }
}
