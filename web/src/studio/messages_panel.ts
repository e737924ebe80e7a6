// SPDX-License-Identifier: GPL-3.0-or-later
// What the command would write to its log, youngest first.
import { element } from '../page/dom';
import { words } from './words';

const most = 60;

export class MessagesPanel {
  private readonly list = element('ul', '', 'log');
  private readonly none = element('p', words.noMessages, 'why');

  constructor(into: HTMLElement) {
    this.list.setAttribute('role', 'log');
    this.list.setAttribute('aria-label', words.messages);
    this.list.tabIndex = 0;
    into.append(this.none, this.list);
    this.clear();
  }

  say(level: string, text: string): void {
    this.none.hidden = true;
    this.list.hidden = false;
    this.list.prepend(element('li', text, level));
    while (this.list.children.length > most) this.list.lastElementChild!.remove();
  }

  clear(): void {
    this.list.replaceChildren();
    this.list.hidden = true;
    this.none.hidden = false;
  }
}
