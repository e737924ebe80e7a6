// SPDX-License-Identifier: GPL-3.0-or-later
// Figures at a place of the skin: those under a pointer that rests, or those of the place last pressed, which stay,
// follow the time and are read aloud.
import type { Colouring, Painting } from './colouring';
import type { Replay } from '../data';
import { nearestVertex } from './deform';
import { element } from '../../page/dom';
import { faceColour } from '../../page/face_colour';
import { faceWords, landmarkName, number } from '../../page/format';
import type { Shown } from '../shown';
import type { Place } from './picking';
import type { FaceViewer } from './viewer';

const restMs = 350;
/** A pointer that moved farther, or was held longer, has turned the face. */
const pressPx = 5;
const pressMs = 600;

interface Figures {
  face: number;
  displacement: string;
  /** The value of the colouring, unless it is the displacement. */
  value: string;
}

export class Readout {
  private readonly box = element('div', '', 'readout');
  private readonly dot = element('i', '', 'place');
  private readonly landmarks: Float32Array;
  private place: Place | null = null;
  private pinned = false;
  private rest = 0;
  private last: { x: number; y: number } | null = null;

  constructor(
    host: HTMLElement, canvas: HTMLElement, private readonly viewer: FaceViewer, private readonly replay: Replay,
    private readonly shown: Shown, private readonly now: () => { colouring: Colouring; painting: Painting },
    private readonly announce: (text: string) => void,
  ) {
    this.landmarks = replay.landmarks.positions.slice(0, 3 * replay.landmarks.names.length);
    this.box.setAttribute('aria-hidden', 'true'); // pressed places are announced elsewhere
    host.append(this.dot, this.box);
    this.clear();
    viewer.onDraw(() => this.draw());
    this.listen(canvas);
  }

  get visible(): boolean {
    return this.place !== null;
  }

  /** Removes it from the page. */
  dispose(): void {
    this.clear();
    this.box.remove();
    this.dot.remove();
  }

  clear(): void {
    clearTimeout(this.rest);
    this.place = null;
    this.pinned = false;
    this.draw();
  }

  private listen(canvas: HTMLElement): void {
    let down: PointerEvent | null = null;
    canvas.addEventListener('pointerdown', (event) => {
      clearTimeout(this.rest);
      down = event.isPrimary && event.button === 0 ? event : null;
    });
    canvas.addEventListener('pointerup', (event) => {
      const from = down;
      down = null;
      if (!from || event.timeStamp - from.timeStamp > pressMs) return;
      if (Math.hypot(event.clientX - from.clientX, event.clientY - from.clientY) > pressPx) return;
      this.show(event.clientX, event.clientY, true);
    });
    canvas.addEventListener('pointermove', (event) => {
      const { clientX: x, clientY: y } = event;
      const same = this.last?.x === x && this.last.y === y; // the page has moved, not the pointer
      this.last = { x, y };
      if (same || this.pinned || event.pointerType === 'touch') return;
      if (this.place) this.clear();
      clearTimeout(this.rest);
      if (event.buttons === 0) this.rest = window.setTimeout(() => this.show(x, y, false), restMs);
    });
    canvas.addEventListener('pointerleave', () => {
      clearTimeout(this.rest);
      if (!this.pinned) this.clear();
    });
  }

  private show(clientX: number, clientY: number, pinned: boolean): void {
    const place = this.viewer.pick.placeAt(clientX, clientY);
    if (!place) {
      this.clear();
      return;
    }
    this.place = place;
    this.pinned = pinned;
    this.draw();
    if (pinned) this.announce(this.words());
  }

  private figures({ vertex }: Place): Figures[] {
    const { scale } = this.now().painting;
    const unit = scale?.unit ?? '';
    return this.viewer.figuresAt(vertex).map(({ displacementMm, share }, i) => {
      const value = scale ? scale.least + share * (scale.greatest - scale.least) : NaN;
      const text = unit === 'mm' ? value.toFixed(2) : number(Number(value.toPrecision(3)));
      return {
        face: this.shown.visible[i],
        displacement: `${displacementMm.toFixed(2)} mm`,
        value: Number.isNaN(value) ? '–' : `${text} ${unit}`,
      };
    });
  }

  /** The value of the colouring for the button; empty where the button shows it anyway. */
  private get measure(): string {
    const { colouring, painting } = this.now();
    return painting.scale && colouring.key !== 'displacement' ? colouring.label : '';
  }

  private near({ vertex }: Place): string {
    const { points, landmarks } = this.replay;
    const found = nearestVertex(this.landmarks, points.subarray(3 * vertex, 3 * vertex + 3));
    if (found.vertex < 0) return '';
    return `${(1e3 * found.distance).toFixed(0)} mm from ${landmarkName(landmarks.names[found.vertex])}`;
  }

  private words(): string {
    const { faces } = this.replay;
    const figures = this.figures(this.place!).map(({ face, displacement, value }) => {
      const own = faces.length > 1 ? `${faceWords(faces, face)}: ` : '';
      return `${own}displacement ${displacement}${this.measure ? `, ${this.measure} ${value}` : ''}`;
    });
    return [this.near(this.place!), ...figures].filter((text) => text).join('; ');
  }

  private table(place: Place): HTMLElement {
    const { faces } = this.replay;
    const table = element('table');
    const head = table.createTHead().insertRow();
    head.append(element('td'), element('th', 'Displacement'), ...(this.measure ? [element('th', this.measure)] : []));
    const body = table.createTBody();
    for (const { face, displacement, value } of this.figures(place)) {
      const name = element('th');
      if (faces.length > 1) {
        const swatch = element('i');
        swatch.style.background = faceColour(face);
        name.append(swatch, faceWords(faces, face));
      }
      body.insertRow().append(name, element('td', displacement), ...(this.measure ? [element('td', value)] : []));
    }
    return table;
  }

  private draw(): void {
    const at = this.place && this.viewer.pick.whereIs(this.place);
    this.box.hidden = this.dot.hidden = !at;
    if (!at) return;
    const near = this.near(this.place!);
    this.box.replaceChildren(...(near ? [element('p', near)] : []), this.table(this.place!));
    this.dot.style.translate = `${at.x}px ${at.y}px`;
    // Beside the place, and inside the picture.
    const { offsetWidth: width, offsetHeight: height } = this.box;
    const host = this.box.parentElement!;
    const x = at.x + 14 + width > host.clientWidth - 6 ? at.x - 14 - width : at.x + 14;
    const y = at.y + 12 + height > host.clientHeight - 6 ? at.y - 12 - height : at.y + 12;
    this.box.style.translate = `${Math.max(x, 6)}px ${Math.max(y, 6)}px`;
  }
}
