// SPDX-License-Identifier: GPL-3.0-or-later
// Drags a segment of bone by one of its arrows.
import { Vector3 } from 'three';
import { at } from '../page/dom';
import { Undoing } from '../page/listeners';
import type { Vec3 } from '../replay/data';
import type { FaceViewer } from '../replay/face/viewer';
import type { BoneView } from './bone_view';

/** How near a pointer must be to an arrow, pixels. */
const nearPx = 12;
/** An arrow that points at the viewer cannot be dragged: it must be at least this long, pixels. */
const shortestPx = 12;

interface Shaft {
  axis: number;
  alongX: number;
  alongY: number;
  px: number;
  lengthM: number;
}

export class BoneHandles {
  private readonly undoing = new Undoing();
  /** Another use of the pointer. */
  paused = false;
  private held: { shaft: Shaft; x: number; y: number; from: Vec3 } | null = null;

  /** `moved`: called with the new move_mm while it is dragged, and once when it is released (`done`). */
  constructor(
    private readonly viewer: FaceViewer, private readonly view: BoneView, private readonly now: () => Vec3,
    private readonly moved: (moveMm: Vec3, done: boolean) => void,
  ) {
    this.listen(at('face'));
  }

  dispose(): void {
    this.undoing.undo();
    this.viewer.turning = true;
  }

  private listen(canvas: HTMLElement): void {
    // Before the view's own listeners, so that picking an arrow does not turn the face.
    const first = { signal: this.undoing.signal, capture: true };
    canvas.addEventListener('pointerdown', (event) => {
      const shaft = event.button === 0 && !this.paused ? this.nearest(event.clientX, event.clientY) : null;
      if (!shaft) return;
      event.stopImmediatePropagation();
      event.preventDefault();
      canvas.setPointerCapture(event.pointerId);
      this.viewer.turning = false;
      this.held = { shaft, x: event.clientX, y: event.clientY, from: [...this.now()] };
    }, first);
    canvas.addEventListener('pointermove', (event) => {
      if (!this.held) {
        if (event.buttons === 0 && !this.paused) canvas.style.cursor = this.nearest(event.clientX, event.clientY) ? 'grab' : '';
        return;
      }
      event.stopImmediatePropagation();
      this.moved(this.movedTo(event), false);
    }, first);
    const letGo = (event: PointerEvent) => {
      if (!this.held) return;
      event.stopImmediatePropagation();
      const to = this.movedTo(event);
      this.held = null;
      this.viewer.turning = true;
      this.moved(to, true);
    };
    canvas.addEventListener('pointerup', letGo, first);
    canvas.addEventListener('pointercancel', letGo, first);
    this.undoing.add(() => (canvas.style.cursor = ''));
  }

  private movedTo({ clientX, clientY }: PointerEvent): Vec3 {
    const { shaft, x, y, from } = this.held!;
    const px = (clientX - x) * shaft.alongX + (clientY - y) * shaft.alongY;
    const to: Vec3 = [...from];
    to[shaft.axis] = Math.round(10 * (from[shaft.axis] + (1e3 * px * shaft.lengthM) / shaft.px)) / 10;
    return to;
  }

  private nearest(x: number, y: number): Shaft | null {
    const { at: base, axes, lengthM } = this.view.handle;
    const from = this.viewer.pick.inWindow(base.toArray() as Vec3);
    let best: Shaft | null = null;
    let bestPx = nearPx;
    axes.forEach((direction, axis) => {
      const end = this.viewer.pick.inWindow(new Vector3().copy(base).addScaledVector(direction, lengthM).toArray() as Vec3);
      const px = Math.hypot(end.x - from.x, end.y - from.y);
      if (px < shortestPx) return;
      const [alongX, alongY] = [(end.x - from.x) / px, (end.y - from.y) / px];
      const along = Math.min(Math.max((x - from.x) * alongX + (y - from.y) * alongY, px / 4), px);
      const off = Math.hypot(from.x + along * alongX - x, from.y + along * alongY - y);
      if (off >= bestPx) return;
      bestPx = off;
      best = { axis, alongX, alongY, px, lengthM };
    });
    return best;
  }
}
