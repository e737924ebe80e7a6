// SPDX-License-Identifier: GPL-3.0-or-later
// Shows each warning beside the control of its key: under the slider, or at the top of the section's panel where
// there is no single control. Inputs are described by it (aria-describedby).
import { at, element } from '../page/dom';
import { holdingFor, sentenceOf, type Remark } from './remarks';
import { words } from './words';

export interface Control {
  /** Takes the remark as its last child. */
  box: HTMLElement;
  /** The inputs that the remark describes. */
  inputs: HTMLElement[];
}

export interface RemarkPanel {
  /** Sections of the scene whose keys it sets: "tissue"; "": all sections of no other panel. */
  sections: string[];
  key: string;
  element: HTMLElement;
  /** The controls that set what the remark is about; [] where there are none. */
  controlsOf(remark: Remark): Control[];
}

/** With more controls than this the remark is shown once, at the top. */
const mostBeside = 2;

export class RemarkPlaces {
  private remarks: Remark[] = [];
  private shown: { note: HTMLElement; inputs: HTMLElement[] }[] = [];
  private count = 0;

  /** `variant`: the name of the variant that is edited, empty for base. */
  constructor(private readonly panels: RemarkPanel[], private readonly variant: () => string) {
    // Nothing moves under a pressed pointer: remarks that arrive meanwhile are shown at its release.
    document.addEventListener('pointerup', () => requestAnimationFrame(() => this.update()));
  }

  set(remarks: Remark[]): void {
    this.remarks = remarks;
    this.update();
  }

  /** After another face is edited or panels were built anew. */
  update(): void {
    if (at('panels').querySelector('input:active')) return;
    this.clear();
    for (const remark of holdingFor(this.variant(), this.remarks)) {
      if (remark.key && remark.severity === 'warning') this.place(remark);
    }
    for (const { key, element: panel } of this.panels) {
      const tab = at(`tab-${key}`);
      const has = this.shown.some(({ note }) => panel.contains(note));
      tab.classList.toggle('has-remark', has);
      tab.title = has ? words.remarksHere : '';
    }
  }

  private clear(): void {
    for (const { note, inputs } of this.shown) {
      note.remove();
      for (const input of inputs) describe(input, note.id, false);
    }
    this.shown = [];
  }

  private place(remark: Remark): void {
    const [section] = remark.key.split('.');
    const panel = this.panels.find(({ sections }) => sections.includes(section)) ?? this.panels.find(({ sections }) => sections.includes(''));
    if (!panel) return;
    const controls = panel.controlsOf(remark);
    const boxes = new Map<HTMLElement, HTMLElement[]>();
    for (const { box, inputs } of controls) boxes.set(box, [...(boxes.get(box) ?? []), ...inputs]);
    if (boxes.size > 0 && boxes.size <= mostBeside) {
      for (const [box, inputs] of boxes) box.append(this.note(remark, inputs));
      return;
    }
    panel.element.prepend(this.note(remark, [panel.element, ...controls.flatMap(({ inputs }) => inputs)]));
  }

  private note(remark: Remark, inputs: HTMLElement[]): HTMLElement {
    const note = element('p', sentenceOf(remark, words.remarks), `control-remark ${remark.severity}`);
    note.id = `remark-${++this.count}`;
    note.dataset.noteId = remark.id;
    for (const input of inputs) describe(input, note.id, true);
    this.shown.push({ note, inputs });
    return note;
  }
}

/** Adds an id to what describes an input, or removes it. */
function describe(input: HTMLElement, id: string, described: boolean): void {
  const ids = (input.getAttribute('aria-describedby') ?? '').split(' ').filter((one) => one !== '' && one !== id);
  if (described) ids.push(id);
  if (ids.length > 0) input.setAttribute('aria-describedby', ids.join(' '));
  else input.removeAttribute('aria-describedby');
}
