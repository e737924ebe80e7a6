// SPDX-License-Identifier: GPL-3.0-or-later
// A magnified view of what lies under the pointer, beside it so that no finger hides it.
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

  /** The surroundings of a place in the window. */
  show(clientX: number, clientY: number): void {
    const host = at('canvas-host');
    const box = host.getBoundingClientRect();
    const [x, y] = [clientX - box.left, clientY - box.top];
    this.glass.hidden = false;
    const ratio = Math.min(window.devicePixelRatio, 2);
    this.glass.width = this.glass.height = Math.round(sizePx * ratio);
    this.glass.style.width = this.glass.style.height = `${sizePx}px`;
    this.viewer.magnify(x, y, sizePx, zoom, this.glass);
    drawCross(this.glass, ratio);
    // Above the pointer, or below it where there is no room; inside the picture.
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

/** A cross in the middle, open in its centre. `ratio`: pixels of the picture for each of the page's. */
function drawCross(picture: HTMLCanvasElement, ratio: number): void {
  const pen = picture.getContext('2d')!;
  const [middle, arm] = [picture.width / 2, 9 * ratio];
  for (const [colour, wide] of [['#000a', 3], ['#fff', 1.2]] as const) {
    pen.strokeStyle = colour;
    pen.lineWidth = wide * ratio;
    pen.beginPath();
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
      pen.moveTo(middle + 0.35 * arm * dx, middle + 0.35 * arm * dy);
      pen.lineTo(middle + arm * dx, middle + arm * dy);
    }
    pen.stroke();
  }
}
