// SPDX-License-Identifier: GPL-3.0-or-later
// The panels as tabs, one of them visible; above them, the face that they edit.
import { at, element } from '../page/dom';
import { faceColour } from '../page/face_colour';
import type { StudioState } from './studio_state';
import { words } from './words';

export interface Panel {
  key: string;
  title: string;
  element: HTMLElement;
  /** Called when it is shown or hidden. */
  seen?(now: boolean): void;
}

/** Greatest number of a variant's changes listed above the panels. */
const mostChanges = 2;

export class Panels {
  private readonly tabs: HTMLButtonElement[];
  private readonly scrolled: number[] = [];

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
    state.sceneChanged.add(() => this.showWhose());
    state.shown.onChange(() => this.showWhose());
  }

  show(key: string): void {
    this.choose(this.panels.findIndex((panel) => panel.key === key));
  }

  private choose(chosen: number): void {
    const scroller = at('panels');
    const before = this.panels.findIndex(({ element: panel }) => !panel.hidden);
    if (before >= 0) this.scrolled[before] = scroller.scrollTop;
    this.tabs.forEach((tab, i) => {
      tab.setAttribute('aria-selected', String(i === chosen));
      tab.tabIndex = i === chosen ? 0 : -1;
      const { element: panel, seen } = this.panels[i];
      if (panel.hidden === (i !== chosen)) return;
      panel.hidden = i !== chosen;
      seen?.(i === chosen);
    });
    // All panels share one scrolling element: each returns to its own position.
    scroller.scrollTop = this.scrolled[chosen] ?? 0;
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

  /** The lines on base and on a variant share one place, one of which is hidden: a press that makes a
   *  variant must not move what is pressed. */
  private showWhose(): void {
    const { state } = this;
    const { edited } = state;
    const whose = at('whose');
    const focused = whose.contains(document.activeElement);
    const dot = (face: number) => {
      const made = element('i');
      made.style.background = faceColour(face);
      return made;
    };
    const ofBase = element('span', '', edited > 0 ? 'out-of-sight' : '');
    const label = element('label', '', 'check');
    const box = element('input');
    Object.assign(box, { type: 'checkbox', checked: state.changeBase, id: 'change-base' });
    box.addEventListener('change', () => {
      state.changeBase = box.checked;
      state.sceneChanged.notify();
    });
    label.append(box, words.changeBase);
    ofBase.append(dot(0), state.changeBase ? words.whoseBaseItself : words.whoseBase, label);
    const ofVariant = element('span', '', edited > 0 ? '' : 'out-of-sight');
    if (edited > 0) {
      const changes = state.changesOf(edited);
      const more = changes.length - mostChanges;
      const soFar = [...changes.slice(0, mostChanges), ...(more > 0 ? [words.whoseMore(more)] : [])].join(', ');
      const text = soFar ? words.whoseSoFar(state.nameOf(edited), soFar) : words.whose(state.nameOf(edited));
      ofVariant.append(dot(edited), text);
      ofVariant.title = text;
    }
    whose.replaceChildren(ofBase, ofVariant);
    if (focused) box.focus();
  }
}
