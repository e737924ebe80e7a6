// SPDX-License-Identifier: GPL-3.0-or-later
// The panels as tabs, one of them visible: the one that was left.
import { at, element } from '../page/dom';
import { remember, remembered } from '../page/remember';

export interface Panel {
  key: string;
  title: string;
  element: HTMLElement;
  /** Called when it is shown or hidden. */
  seen?(now: boolean): void;
}

/** Under which the panel chosen last is remembered. */
const tabKey = 'panel';

export class Panels {
  private readonly tabs: HTMLButtonElement[];
  private readonly scrolled: number[] = [];

  constructor(private readonly panels: Panel[]) {
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
    this.choose(Math.max(panels.findIndex(({ key }) => key === remembered(tabKey)), 0));
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
    remember(tabKey, this.panels[chosen].key);
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
}
