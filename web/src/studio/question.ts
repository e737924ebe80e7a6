// SPDX-License-Identifier: GPL-3.0-or-later
// The question that the edited face asks, as a sentence of parts that can be changed: what pulls with which strength,
// each with its slider, and what else differs from base.
import { at, button, element } from '../page/dom';
import { faceColour } from '../page/face_colour';
import { menuOf } from '../page/menu';
import { namedChanges, type NamedChange } from './brief_name';
import type { Edits } from './edits';
import { isRecord } from './messages';
import type { Slider } from './slider';
import { strengthSlider } from './strength_slider';
import { gainKey, type StudioState } from './studio_state';
import type { WhatIf } from './what_if';
import { words } from './words';

const regionKey = 'tissue.region';
const boneKey = 'surgery.bone';

export class Question {
  private built = '';
  private readonly sliders = new Map<string, Slider>();
  private readonly sheets: HTMLElement[] = [];

  /** `showPanel`: opens the panel that sets a key. */
  constructor(
    private readonly state: StudioState, private readonly edits: Edits, private readonly whatIf: WhatIf, private readonly into: HTMLElement,
    private readonly showPanel: (key: 'tissue' | 'paint' | 'muscles' | 'bones') => void,
  ) {
    state.sceneChanged.add(() => this.update());
    state.shown.onChange(() => this.update());
    // Colours come with the first face.
    state.source.onChange(() => this.update());
  }

  private get changes(): NamedChange[] {
    const { state } = this;
    return state.edited === 0 ? [] : namedChanges(state.scene?.faces[state.edited]?.changes ?? {}, state.valuesOf(0), state.muscles);
  }

  private update(): void {
    const { state } = this;
    if (!state.scene) return;
    this.showTitle();
    const changes = this.changes;
    const built = JSON.stringify([state.edited, state.changeBase, changes.map(({ gain, text }) => gain ?? text)]);
    if (built !== this.built) {
      this.built = built;
      this.build(changes);
    }
    const [own, base] = [this.edits.gains, state.gainsOf(0)];
    for (const [gain, slider] of this.sliders) slider.set(100 * (own[gain] ?? 1), 100 * (base[gain] ?? 1));
  }

  private showTitle(): void {
    const { edited } = this.state;
    const dot = element('i');
    dot.style.background = faceColour(edited);
    at('question-title').replaceChildren(dot, edited === 0 ? words.base : words.question);
    at('question').classList.toggle('asked', edited > 0);
  }

  private build(changes: NamedChange[]): void {
    this.sliders.clear();
    for (const sheet of this.sheets.splice(0)) sheet.remove();
    if (this.state.edited === 0) this.into.replaceChildren(...this.ofBase());
    else {
      const and = this.chooser(button(changes.length > 0 ? words.questionAnd : words.questionChoose, 'add-change', () => {}), null);
      this.into.replaceChildren(...changes.map((change) => (change.gain ? this.strength(change.gain, change.of!) : this.other(change))), and);
    }
  }

  /** What a change of base does, and whether base itself may be changed. */
  private ofBase(): HTMLElement[] {
    const { state } = this;
    const label = element('label', '', 'check');
    const box = element('input');
    Object.assign(box, { type: 'checkbox', checked: state.changeBase, id: 'change-base' });
    box.addEventListener('change', () => {
      state.changeBase = box.checked;
      state.sceneChanged.notify();
      at('change-base').focus();
    });
    label.append(box, words.changeBase);
    return [element('p', state.changeBase ? words.whoseBaseItself : words.whoseBase, 'base-says'), label];
  }

  /** "right zygomatic branch at 30 %": either part can be changed. */
  private strength(gain: string, of: string): HTMLElement {
    const head = element('span', '', 'change-head');
    head.append(this.chooser(button(of, 'change-chip opens', () => {}), gain), words.questionAt);
    const set = (value: number) => this.edits.commit({ [gainKey]: { ...this.edits.gains, [gain]: value } });
    const slider = strengthSlider(this.state.boundsOf(gainKey), {
      name: words.questionStrength(of), hint: '', head,
      live: (value) => this.edits.live({ [gainKey]: { ...this.edits.gains, [gain]: value / 100 } }),
      done: (value) => {
        if (value === null) this.leave({ key: gainKey, text: of, gain });
        else void set(value / 100);
      },
    });
    slider.element.dataset.question = gain;
    this.sliders.set(gain, slider);
    return slider.element;
  }

  private other(change: NamedChange): HTMLElement {
    const row = element('div', '', 'change');
    const region = change.key === regionKey && change.row !== undefined ? this.rows(regionKey)[change.row] : undefined;
    const painted = region !== undefined && 'painted' in region;
    const panel = painted ? 'paint' : change.key === boneKey ? 'bones' : change.key === 'motion.gain' ? 'muscles' : 'tissue';
    const out = button('×', 'change-out', () => this.leave(change));
    out.setAttribute('aria-label', words.questionLeave(change.text));
    row.append(button(change.text, 'change-chip', () => this.showPanel(panel)), out);
    return row;
  }

  /** Lets a button choose what else changes, or what changes in the place of `gain`. */
  private chooser(opener: HTMLButtonElement, gain: string | null): HTMLButtonElement {
    const { sheet } = menuOf(opener, gain ? words.questionInstead : words.questionAnd, (into, close) => this.whatIf.fillChange(into, close, gain));
    this.sheets.push(sheet);
    return opener;
  }

  private rows(key: string): Record<string, unknown>[] {
    const value = this.edits.value(key);
    return Array.isArray(value) ? value.filter(isRecord) : [];
  }

  /** Back to what base has. */
  private leave({ key, gain, row }: NamedChange): void {
    if (gain) {
      const { [gain]: _left, ...kept } = this.edits.gains;
      const before = this.state.gainsOf(0)[gain];
      void this.edits.commit({ [gainKey]: before === undefined ? kept : { ...kept, [gain]: before } });
    } else if (row !== undefined) void this.edits.commit({ [key]: this.rows(key).filter((_, i) => i !== row) });
    else void this.edits.commit({ [key]: null });
  }
}
