// SPDX-License-Identifier: GPL-3.0-or-later
// The displacement of a take over time, and the part to keep: two sliders under a curve.
import { element } from '../page/dom';

const [width, height] = [200, 46];
const svg = (name: string) => document.createElementNS('http://www.w3.org/2000/svg', name);

export class TrimCurve {
  readonly element = element('div', '', 'trim-curve');
  private readonly line = svg('polyline');
  private readonly kept = svg('rect');
  private readonly sliders: HTMLInputElement[];
  private readonly outputs = [element('output'), element('output')];
  private lengthS = 0;

  constructor(name: string, ends: [string, string]) {
    const picture = svg('svg');
    picture.setAttribute('viewBox', `0 0 ${width} ${height}`);
    picture.setAttribute('preserveAspectRatio', 'none');
    picture.setAttribute('role', 'img');
    picture.setAttribute('aria-label', name);
    this.kept.setAttribute('height', String(height));
    picture.append(this.kept, this.line);
    this.sliders = ends.map((end, i) => {
      const slider = element('input');
      Object.assign(slider, { type: 'range', min: '0', max: '1000', step: '1', value: String(1000 * i) });
      slider.setAttribute('aria-label', end);
      slider.addEventListener('input', () => this.pull(i));
      return slider;
    });
    this.element.append(picture);
    ends.forEach((end, i) => {
      const row = element('label');
      row.append(element('span', end), this.sliders[i], this.outputs[i]);
      this.element.append(row);
    });
  }

  /** Seconds since the first sample. */
  get range(): [number, number] {
    const [from, to] = this.sliders.map((slider) => (Number(slider.value) / 1000) * this.lengthS);
    return [from, to];
  }

  show(timeS: number[], values: number[]): void {
    this.lengthS = timeS[timeS.length - 1] ?? 0;
    const most = Math.max(...values, 1);
    const points = timeS.map((t, i) => `${((width * t) / (this.lengthS || 1)).toFixed(1)},${(height - 2 - ((height - 4) * values[i]) / most).toFixed(1)}`);
    this.line.setAttribute('points', points.join(' '));
    this.sliders.forEach((slider, i) => (slider.value = String(1000 * i)));
    this.update();
  }

  /** Keeps the ends in order. */
  private pull(moved: number): void {
    const [from, to] = this.sliders;
    const least = 20;
    if (Number(to.value) - Number(from.value) < least)
      if (moved === 0) from.value = String(Math.max(0, Number(to.value) - least));
      else to.value = String(Math.min(1000, Number(from.value) + least));
    this.update();
  }

  private update(): void {
    const [from, to] = this.range;
    const share = (s: number) => (width * s) / (this.lengthS || 1);
    this.kept.setAttribute('x', share(from).toFixed(1));
    this.kept.setAttribute('width', share(to - from).toFixed(1));
    [from, to].forEach((s, i) => {
      const text = `${s.toFixed(2)} s`;
      this.outputs[i].textContent = text;
      this.sliders[i].setAttribute('aria-valuetext', text);
    });
  }
}
