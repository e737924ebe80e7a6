// SPDX-License-Identifier: GPL-3.0-or-later
// The control of a value: a slider, a number field where there is room, and a reset button.
import { element } from '../page/dom';
import { number } from '../page/format';
import { holds, type Bounds } from './bounds';
import type { Control } from './remark_places';
import { words } from './words';

/** From a place on the slider, 0 to 1, to the value and back. */
export interface Course {
  at(share: number): number;
  of(value: number): number;
}

export const linear = (low: number, high: number): Course => ({
  at: (share) => low + share * (high - low),
  of: (value) => (value - low) / (high - low),
});

/** Logarithmic; both limits above 0. */
export const logarithmic = (low: number, high: number): Course => ({
  at: (share) => low * (high / low) ** share,
  of: (value) => Math.log(Math.max(value, low) / low) / Math.log(high / low),
});

export const threeDigits = (value: number): number => Number(value.toPrecision(3));

export interface SliderOptions {
  /** The accessible name; also visible unless `bare`. */
  name: string;
  unit: string;
  hint: string;
  course: Course;
  /** Rounds what the slider gives. */
  round(value: number): number;
  /** Range of typed numbers; the slider itself may cover less. */
  bounds: Bounds;
  /** What an arrow key changes on a linear slider; not given: a thousandth of its length. */
  step?: number;
  /** Only the slider, with its value behind it. */
  bare?: boolean;
  /** Stands in the label's place. */
  head?: HTMLElement;
  /** Called while the slider is dragged, and when it is released; null: reset. */
  live(value: number): void;
  done(value: number | null): void;
}

/** After this long without a key press, a slider moved by keys counts as released. */
const keysRestMs = 500;

let count = 0;

export class Slider {
  readonly element = element('div', '', 'slider');
  readonly range = element('input');
  private readonly digits = element('input');
  private readonly shownValue = element('output');
  private readonly inBase = element('span', '', 'in-base');
  private readonly back = element('button', '↺', 'back');
  private readonly steps: number;
  private value = 0;
  private held = false;
  private moved = false;
  private rest = 0;

  constructor(private readonly options: SliderOptions) {
    const { name, unit, hint, bare, course, step, bounds } = options;
    this.steps = step === undefined ? 1000 : Math.round((course.at(1) - course.at(0)) / step);
    const id = `slider-${++count}`;
    Object.assign(this.range, { type: 'range', id, min: '0', max: String(this.steps), step: '1', title: hint });
    Object.assign(this.digits, { type: 'number', min: String(bounds.low), max: String(bounds.high), step: 'any' });
    this.digits.setAttribute('aria-label', words.number(name, unit));
    Object.assign(this.back, { type: 'button', title: words.reset(name) });
    this.back.setAttribute('aria-label', words.reset(name));
    this.element.title = hint;
    if (bare) {
      this.element.classList.add('bare');
      this.range.setAttribute('aria-label', name);
      this.shownValue.setAttribute('for', id);
      this.element.append(this.range, this.shownValue);
    } else {
      const label = options.head ?? Object.assign(element('label', name), { htmlFor: id });
      if (options.head) this.range.setAttribute('aria-label', name);
      const digits = element('span', '', 'digits');
      digits.append(this.digits, element('span', unit, 'unit'), this.back);
      this.element.append(label, digits, this.range, this.inBase, element('span', hint, 'hint'));
    }
    this.listen();
  }

  /** Whether the user is dragging it; then nothing else moves it. */
  get busy(): boolean {
    return this.held || this.rest !== 0 || document.activeElement === this.digits;
  }

  get current(): number {
    return this.value;
  }

  /** Where remarks on its value stand. */
  get control(): Control {
    return { box: this.element, inputs: [this.range, this.digits] };
  }

  /** `base`: the value in base, where this is another face. */
  set(value: number, base: number | null, enabled = true): void {
    this.range.disabled = this.digits.disabled = !enabled;
    const changed = base !== null && Math.abs(value - base) > 1e-9 * Math.max(Math.abs(value), Math.abs(base));
    this.inBase.textContent = changed ? words.inBase(`${number(base)} ${this.options.unit}`.trim()) : '';
    this.back.hidden = !changed || !enabled;
    this.element.classList.toggle('changed', changed);
    if (!this.busy) this.show(value);
  }

  private show(value: number): void {
    this.value = value;
    const share = Math.min(Math.max(this.options.course.of(value), 0), 1);
    this.range.value = String(Math.round(share * this.steps));
    this.showText();
    this.digits.value = String(Number(value.toPrecision(6)));
  }

  private showText(): void {
    const { unit } = this.options;
    const text = `${number(this.value)} ${unit}`.trim();
    this.shownValue.textContent = text;
    this.range.setAttribute('aria-valuetext', text);
    this.element.style.setProperty('--share', String(Number(this.range.value) / this.steps));
  }

  private listen(): void {
    const { range, digits, options } = this;
    range.addEventListener('pointerdown', () => (this.held = true));
    range.addEventListener('input', () => {
      this.value = options.round(options.course.at(Number(range.value) / this.steps));
      this.moved = true;
      digits.value = String(Number(this.value.toPrecision(6)));
      this.showText();
      if (!this.held) this.restKeys();
      options.live(this.value);
    });
    const letGo = () => {
      this.held = false;
      if (this.rest === 0) this.finish();
    };
    range.addEventListener('pointerup', () => requestAnimationFrame(letGo)); // after its last input
    range.addEventListener('pointercancel', letGo);
    range.addEventListener('blur', () => {
      clearTimeout(this.rest);
      this.rest = 0;
      letGo();
    });
    range.addEventListener('dblclick', () => this.back.click());
    digits.addEventListener('change', () => {
      const value = Number(digits.value);
      if (digits.value === '') {
        this.restore();
        return;
      }
      if (!holds(options.bounds, value)) {
        this.refuse(value);
        return;
      }
      digits.setCustomValidity('');
      this.show(value);
      options.done(value);
    });
    // A value that was refused is not kept.
    digits.addEventListener('blur', () => {
      if (digits.value === '' || !digits.validity.valid) this.restore();
    });
    this.back.addEventListener('click', () => options.done(null));
  }

  private restore(): void {
    this.digits.setCustomValidity('');
    this.show(this.value);
  }

  private refuse(value: number): void {
    const { low, high, above } = this.options.bounds;
    this.digits.setCustomValidity(`${number(value)}: ${above ? '> ' : ''}${number(low)} – ${number(high)}`);
    this.digits.reportValidity();
  }

  private restKeys(): void {
    clearTimeout(this.rest);
    this.rest = window.setTimeout(() => {
      this.rest = 0;
      if (!this.held) this.finish();
    }, keysRestMs);
  }

  private finish(): void {
    if (!this.moved) return;
    this.moved = false;
    this.options.done(this.value);
  }
}
