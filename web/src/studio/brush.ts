// SPDX-License-Identifier: GPL-3.0-or-later
// The brush: turns pointer and key events over the picture into places on the skin; a ring shows its size.
import { at, element } from '../page/dom';
import { Undoing } from '../page/listeners';
import type { SkinHit } from '../replay/face/face_body';
import type { FaceViewer } from '../replay/face/viewer';

/** What an arrow key moves the brush by, pixels. */
const stepPx = 4;
/** Greatest distance of a stroke's places, over the brush's radius. */
const spacing = 0.4;

export interface Painter {
  /** Null: pointers turn the face. */
  radiusM(): number | null;
  begin(): void;
  dab(at: SkinHit): void;
  /** `keep` false: undo it. */
  end(keep: boolean): void;
  /** Widens the brush by this many steps. */
  widen(steps: number): void;
  /** To screen readers. */
  announce(what: 'down' | 'up'): void;
}

export class BrushInHand {
  private readonly ring = element('div', '', 'brush-ring');
  private readonly undoing = new Undoing();
  private pointer = -1;
  private last: { x: number; y: number } | null = null;
  /** The brush's place by keys, and whether keys hold it down. */
  private placed: SkinHit | null = null;
  private held = false;

  constructor(private readonly viewer: FaceViewer, private readonly painter: Painter) {
    this.ring.setAttribute('aria-hidden', 'true');
    this.ring.hidden = true;
    at('canvas-host').append(this.ring);
    this.listen(at('face'));
  }

  /** Puts the brush away. */
  dispose(): void {
    this.lift(false);
    this.undoing.undo();
    this.ring.remove();
    this.viewer.turning = true;
  }

  /** After its size or tool changed. */
  show(): void {
    if (this.last && !this.ring.hidden) this.place(this.last.x, this.last.y);
  }

  private listen(canvas: HTMLElement): void {
    const { signal } = this.undoing;
    // Before the view's own listeners, which neither turn the face nor show figures then.
    const first = { signal, capture: true };
    canvas.addEventListener('pointerdown', (event) => {
      if (this.pointer >= 0) {
        // A second finger: turns or zooms the face.
        this.lift(false);
        return;
      }
      const hit = event.button === 0 && this.painter.radiusM() !== null ? this.viewer.pick.hitAt(event.clientX, event.clientY) : null;
      if (!hit || this.held) return;
      event.stopImmediatePropagation();
      event.preventDefault();
      canvas.focus({ preventScroll: true });
      canvas.setPointerCapture(event.pointerId);
      this.viewer.turning = false;
      this.pointer = event.pointerId;
      this.placed = null;
      this.painter.begin();
      this.painter.dab(hit);
      this.place(event.clientX, event.clientY);
    }, first);
    canvas.addEventListener('pointermove', (event) => {
      if (this.pointer >= 0 && event.pointerId !== this.pointer) return;
      if (this.pointer < 0) {
        if (event.buttons === 0 && event.pointerType !== 'touch') {
          if (this.painter.radiusM() !== null) event.stopImmediatePropagation();
          this.place(event.clientX, event.clientY);
        } else {
          this.ring.hidden = true;
        }
        return;
      }
      event.stopImmediatePropagation();
      this.drawTo(event.clientX, event.clientY);
    }, first);
    const up = (keep: boolean) => (event: PointerEvent) => {
      if (event.pointerId !== this.pointer) return;
      event.stopImmediatePropagation();
      this.lift(keep);
    };
    canvas.addEventListener('pointerup', up(true), first);
    canvas.addEventListener('pointercancel', up(false), first);
    canvas.addEventListener('pointerleave', () => {
      if (this.pointer < 0) this.ring.hidden = true;
    }, { signal });
    canvas.addEventListener('keydown', (event) => this.press(event), first);
    canvas.addEventListener('blur', () => this.lift(true), { signal });
  }

  private press(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey || event.shiftKey || this.painter.radiusM() === null) return;
    const steps: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const step = steps[event.key];
    if (step) this.walk(...step);
    else if (event.key === 'Enter') this.toggle();
    else if (event.key === 'Escape' && (this.held || this.pointer >= 0)) this.lift(false);
    else if (event.key === '[' || event.key === ']') {
      this.painter.widen(event.key === ']' ? 1 : -1);
      this.show();
    } else return;
    event.preventDefault();
    event.stopImmediatePropagation(); // else they step through the frames
  }

  private walk(x: number, y: number): void {
    const from = this.start();
    const hit = this.viewer.pick.hitAt(from.x + stepPx * x, from.y + stepPx * y);
    if (!hit) return;
    this.placed = hit;
    if (this.held) this.painter.dab(hit);
    this.place(from.x + stepPx * x, from.y + stepPx * y);
  }

  /** Where keys begin to move it: at its last place, else at the pointer's last place, else in the middle of the last
   *  face shown. */
  private start(): { x: number; y: number } {
    if (this.placed) return this.viewer.pick.seenAt(this.placed);
    if (this.last && this.viewer.pick.hitAt(this.last.x, this.last.y)) return this.last;
    const box = at('canvas-host').getBoundingClientRect();
    const two = at('canvas-host').dataset.mode === 'side-by-side';
    return { x: box.left + (two ? 0.75 : 0.5) * box.width, y: box.top + 0.5 * box.height };
  }

  private toggle(): void {
    if (this.held) {
      this.lift(true);
      this.painter.announce('up');
      return;
    }
    const { x, y } = this.start();
    const hit = this.viewer.pick.hitAt(x, y);
    if (!hit) return;
    this.placed = hit;
    this.held = true;
    this.painter.begin();
    this.painter.dab(hit);
    this.place(x, y);
    this.painter.announce('down');
  }

  private lift(keep: boolean): void {
    if (this.pointer < 0 && !this.held) return;
    this.pointer = -1;
    this.held = false;
    this.viewer.turning = true;
    this.ring.classList.remove('down');
    this.painter.end(keep);
  }

  /** Places between the pointer's last and this one, so that nothing is left out. */
  private drawTo(x: number, y: number): void {
    const from = this.last ?? { x, y };
    const gap = Math.hypot(x - from.x, y - from.y);
    const radiusPx = Math.max(this.ring.offsetWidth / 2, 4);
    const count = Math.min(Math.ceil(gap / (spacing * radiusPx)), 40);
    for (let i = 1; i <= count; ++i) {
      const hit = this.viewer.pick.hitAt(from.x + ((x - from.x) * i) / count, from.y + ((y - from.y) * i) / count);
      if (hit) this.painter.dab(hit);
    }
    this.place(x, y);
  }

  private place(x: number, y: number): void {
    this.last = { x, y };
    const radius = this.painter.radiusM();
    const hit = radius === null ? null : this.viewer.pick.hitAt(x, y);
    this.ring.hidden = !hit;
    if (!hit || radius === null) return;
    const box = at('canvas-host').getBoundingClientRect();
    const size = 2 * radius * hit.pixelsPerM;
    this.ring.style.width = this.ring.style.height = `${size.toFixed(1)}px`;
    this.ring.style.translate = `${x - box.left - size / 2}px ${y - box.top - size / 2}px`;
    this.ring.classList.toggle('down', this.pointer >= 0 || this.held);
  }
}
