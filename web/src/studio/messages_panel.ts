// SPDX-License-Identifier: GPL-3.0-or-later
// The messages that the command would log, and remarks on the run, newest first: a sheet below their count, which is
// there only where there are any. New warnings are announced to screen readers.
import { element } from '../page/dom';
import { wireSheet } from '../page/menu';
import { sentenceOf, type Remark } from './remarks';
import { words } from './words';

const most = 60;
const severities = ['error', 'warning', 'note'] as const;

export class MessagesPanel {
  private readonly list = element('ul', '', 'log');

  /** `opener`: the button with their count; `news`: the live region that announces new warnings. */
  constructor(into: HTMLElement, private readonly opener: HTMLElement, private readonly news: HTMLElement) {
    this.list.setAttribute('aria-label', words.messages);
    this.list.tabIndex = 0;
    into.append(this.list);
    wireSheet(opener, into);
    this.count();
  }

  add(level: string, text: string): HTMLElement {
    const item = element('li', text, level);
    this.list.prepend(item);
    while (this.list.children.length > most) this.list.lastElementChild!.remove();
    if (level === 'warning' || level === 'error') this.news.textContent = words.newMessage(text);
    this.count();
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
    this.news.textContent = '';
    this.count();
  }

  /** How many, and as what the worst of them counts. */
  private count(): void {
    const { length } = this.list.children;
    const worst = severities.find((level) => this.list.querySelector(`.${level}`)) ?? 'note';
    this.opener.hidden = length === 0;
    this.opener.textContent = String(length);
    this.opener.classList.remove(...severities);
    this.opener.classList.add(worst);
    this.opener.dataset.icon = worst === 'note' ? 'note' : 'warning';
    const text = words.messageCount(length, worst);
    this.opener.title = text;
    this.opener.setAttribute('aria-label', text);
  }
}
