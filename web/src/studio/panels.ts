// SPDX-License-Identifier: GPL-3.0-or-later
// The panels of which one is seen, as tabs; above them, whose values they change.
import { at, element } from '../page/dom';
import { faceColour } from '../page/face_colour';
import type { StudioState } from './studio_state';
import { words } from './words';

export interface Panel {
  key: string;
  title: string;
  element: HTMLElement;
  /** Told when it comes into view and when it goes. */
  seen?(now: boolean): void;
}

export class Panels {
  private readonly tabs: HTMLButtonElement[];

  constructor(private readonly state: StudioState, private readonly panels: Panel[]) {
    this.tabs = panels.map(({ key, title, element: panel }, i) => {
      const tab = element('button', title);
      Object.assign(tab, { type: 'button', id: `tab-${key}` });
      tab.setAttribute('role', 'tab');
      tab.setAttribute('aria-controls', `panel-${key}`);
      tab.addEventListener('click', () => this.choose(i));
      tab.addEventListener('keydown', (event) => this.press(event, i));
      panel.id = `panel-${key}`;
      panel.setAttribute('role', 'tabpanel');
      panel.setAttribute('aria-labelledby', tab.id);
      panel.hidden = i > 0;
      return tab;
    });
    at('panel-tabs').append(...this.tabs);
    at('panels').append(...panels.map(({ element: panel }) => panel));
    this.choose(0);
    state.sceneChanged.add(() => this.tellWhose());
    state.shown.onChange(() => this.tellWhose());
  }

  private choose(chosen: number): void {
    this.tabs.forEach((tab, i) => {
      tab.setAttribute('aria-selected', String(i === chosen));
      tab.tabIndex = i === chosen ? 0 : -1;
      const { element: panel, seen } = this.panels[i];
      if (panel.hidden === (i !== chosen)) return;
      panel.hidden = i !== chosen;
      seen?.(i === chosen);
    });
  }

  private press(event: KeyboardEvent, i: number): void {
    const to: Record<string, number> = { ArrowRight: i + 1, ArrowLeft: i - 1, Home: 0, End: this.tabs.length - 1 };
    if (!(event.key in to)) return;
    event.preventDefault();
    event.stopPropagation();
    const next = (to[event.key] + this.tabs.length) % this.tabs.length;
    this.choose(next);
    this.tabs[next].focus();
  }

  private tellWhose(): void {
    const { state } = this;
    const { edited } = state;
    const whose = at('whose');
    const dot = element('i');
    dot.style.background = faceColour(edited);
    if (edited > 0) {
      whose.replaceChildren(dot, words.whose(state.nameOf(edited)));
      return;
    }
    const focused = whose.contains(document.activeElement);
    const label = element('label', '', 'check');
    const box = element('input');
    Object.assign(box, { type: 'checkbox', checked: state.changeBase, id: 'change-base' });
    box.addEventListener('change', () => {
      state.changeBase = box.checked;
      state.sceneChanged.tell();
    });
    label.append(box, words.changeBase);
    whose.replaceChildren(dot, element('span', state.changeBase ? words.whoseBaseItself : words.whoseBase), label);
    if (focused) box.focus();
  }
}
