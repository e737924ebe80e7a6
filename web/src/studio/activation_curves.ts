// SPDX-License-Identifier: GPL-3.0-or-later
// The activation of each muscle over time, drawn small beside its slider: of the edited face and of base.
import { element } from '../page/dom';
import type { Block } from '../page/page_data';
import type { Activations } from './messages';
import type { StudioState } from './studio_state';
import { words } from './words';

const svg = 'http://www.w3.org/2000/svg';
const [wide, high] = [100, 20];

/** Of one muscle and side. */
interface Drawn {
  name: string;
  called: string;
  picture: SVGSVGElement;
  own: SVGPolylineElement;
  base: SVGPolylineElement;
  zero: SVGLineElement;
}

export class ActivationCurves {
  private names: string[] = [];
  private notes: string[] = [];
  private timeS: number[] = [];
  /** Names x times, of each face; null where they are not known. */
  private faces: (Float32Array | null)[] = [];
  private range: [number, number] = [0, 1];
  private drawn: Drawn[] = [];

  /** `holder`: the element that holds the time shown as a style property. */
  constructor(private readonly state: StudioState, private readonly holder: HTMLElement) {
    state.shown.onChange(() => this.draw());
  }

  /** Before the panel's rows are made anew. */
  clear(): void {
    this.drawn = [];
  }

  take(given: Activations | null, block: Block): void {
    this.names = given?.names ?? [];
    this.notes = given?.notes ?? [];
    this.timeS = given?.time_s ?? [];
    this.faces = (given?.faces ?? []).map((values) => values && block.float32(values).slice());
    // One range for all, so that weak activations look weak.
    let [least, most] = [0, 0.05];
    for (const values of this.faces)
      for (const value of values ?? []) {
        least = Math.min(least, value);
        most = Math.max(most, value);
      }
    this.range = [least, most];
  }

  /** Of a muscle with its side. */
  add(name: string, called: string): HTMLElement {
    const box = element('div', '', 'activation');
    const make = <K extends 'svg' | 'polyline' | 'line'>(tag: K, className: string) => {
      const made = document.createElementNS(svg, tag);
      made.setAttribute('class', className);
      return made;
    };
    const picture = make('svg', '');
    picture.setAttribute('viewBox', `0 0 ${wide} ${high}`);
    picture.setAttribute('preserveAspectRatio', 'none');
    picture.setAttribute('role', 'img');
    const one: Drawn = { name, called, picture, own: make('polyline', 'own'), base: make('polyline', 'base'), zero: make('line', 'zero') };
    picture.append(one.zero, one.base, one.own);
    box.append(picture);
    this.drawn.push(one);
    return box;
  }

  /** At the time shown. */
  mark(timeS: number): void {
    const [from, to] = [this.timeS[0] ?? 0, this.timeS[this.timeS.length - 1] ?? 0];
    const share = to > from ? Math.min(Math.max((timeS - from) / (to - from), 0), 1) : 0;
    this.holder.style.setProperty('--now', share.toFixed(4));
  }

  draw(): void {
    const { edited } = this.state;
    for (const one of this.drawn) {
      const row = this.names.indexOf(one.name);
      const own = row < 0 ? null : this.rowOf(this.faces[edited] ?? null, row);
      const base = row < 0 || edited === 0 ? null : this.rowOf(this.faces[0] ?? null, row);
      // Unknown curves keep their space, so that nothing moves under the pointer.
      one.picture.parentElement!.style.visibility = own || base ? '' : 'hidden';
      one.own.setAttribute('points', own ? this.points(own) : '');
      one.base.setAttribute('points', base ? this.points(base) : '');
      const y = this.height(0).toFixed(2);
      for (const [key, value] of [['x1', '0'], ['x2', String(wide)], ['y1', y], ['y2', y]]) one.zero.setAttribute(key, value);
      const most = (values: Float32Array) => Math.max(...values).toFixed(2);
      const spoken = words.activation(one.called, own ? most(own) : '–', base ? most(base) : '', this.notes[row] ?? '');
      one.picture.setAttribute('aria-label', spoken);
      one.picture.parentElement!.title = spoken;
    }
  }

  private rowOf(values: Float32Array | null, row: number): Float32Array | null {
    const { length } = this.timeS;
    return values && length > 1 ? values.subarray(row * length, (row + 1) * length) : null;
  }

  private height(value: number): number {
    const [least, most] = this.range;
    return 1 + (high - 2) * (1 - (value - least) / (most - least));
  }

  private points(values: Float32Array): string {
    const { timeS } = this;
    const [from, to] = [timeS[0], timeS[timeS.length - 1]];
    return Array.from(values, (value, i) => `${((wide * (timeS[i] - from)) / (to - from)).toFixed(2)},${this.height(value).toFixed(2)}`).join(' ');
  }
}
