// SPDX-License-Identifier: GPL-3.0-or-later
// What lies under the pointer, larger and beside it, where neither it nor a finger hides it.
import { at, element } from '../page/dom';
import type { FaceViewer } from '../replay/face/viewer';

const sizePx = 132;
const zoom = 3;
const awayPx = 22;

export class Magnifier {
  private readonly glass = element('canvas', '', 'magnifier');

  constructor(private readonly viewer: FaceViewer) {
    this.glass.setAttribute('aria-hidden', 'true');
    this.glass.hidden = true;
    at('canvas-host').append(this.glass);
  }

  /** About a place in the window. */
  show(clientX: number, clientY: number): void {
    const host = at('canvas-host');
    const box = host.getBoundingClientRect();
    const [x, y] = [clientX - box.left, clientY - box.top];
    this.glass.hidden = false;
    this.viewer.magnify(x, y, sizePx, zoom, this.glass);
    // Above, or where there is no room, below; inside the picture.
    const up = y - awayPx - sizePx;
    const left = Math.min(Math.max(x - sizePx / 2, 4), host.clientWidth - sizePx - 4);
    this.glass.style.translate = `${left}px ${up < 4 ? y + awayPx : up}px`;
  }

  hide(): void {
    this.glass.hidden = true;
  }

  remove(): void {
    this.glass.remove();
  }
}
