// SPDX-License-Identifier: GPL-3.0-or-later
// The messages that the command would log, and remarks on the run, newest first.
import { element } from '../page/dom';
import { sentenceOf, type Remark } from './remarks';
import { words } from './words';

const most = 60;

export class MessagesPanel {
  private readonly list = element('ul', '', 'log');
  private readonly none = element('p', words.noMessages, 'why');

  constructor(into: HTMLElement) {
    this.list.setAttribute('aria-live', 'polite');
    this.list.setAttribute('aria-label', words.messages);
    this.list.tabIndex = 0;
    into.append(this.none, this.list);
    this.clear();
  }

  add(level: string, text: string): HTMLElement {
    this.none.hidden = true;
    this.list.hidden = false;
    const item = element('li', text, level);
    this.list.prepend(item);
    while (this.list.children.length > most) this.list.lastElementChild!.remove();
    return item;
  }

  /** Shows each once, since later motions repeat most remarks. */
  addRemarks(remarks: Remark[]): void {
    for (const remark of remarks) {
      const sentence = sentenceOf(remark, words.remarks);
      const there = [...this.list.children].find(({ textContent }) => textContent === sentence || textContent === remark.text);
      const item = (there as HTMLElement | undefined) ?? this.add(remark.severity, sentence);
      item.dataset.noteId = remark.id;
    }
  }

  clear(): void {
    this.list.replaceChildren();
    this.list.hidden = true;
    this.none.hidden = false;
  }
}
