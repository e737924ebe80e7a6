// SPDX-License-Identifier: GPL-3.0-or-later
// Keys for what the page's buttons do, and the list of them that is shown on "?".

import { Undoing, type Undo } from '../page/listeners';

export interface Key {
  /** The text in the list of keys: "1 to 9". */
  shown: string;
  does: string;
  /** Whether the key press matches, as `KeyboardEvent.key` or a test of the event. */
  when: string[] | ((event: KeyboardEvent) => boolean);
  act(event: KeyboardEvent): void;
}

/** Elements that use the key themselves. Buttons, boxes and sliders do not use letters. */
function taken(event: KeyboardEvent): boolean {
  const target = event.target instanceof Element ? event.target : null;
  if (!target) return false;
  if (target.closest('dialog, select, textarea, [contenteditable], input:not([type=checkbox], [type=range])')) return true;
  if (event.key === ' ') return target.closest('button, summary, a, input, [role=button]') !== null;
  return /^(Arrow|Home|End|Page)/.test(event.key) && target.closest('input, [role=slider]') !== null;
}

function listOf(keys: Key[]): HTMLElement {
  const list = document.createElement('dl');
  for (const key of keys) {
    const row = document.createElement('div');
    const term = document.createElement('dt');
    for (const [i, part] of key.shown.split(' ').entries()) {
      const word = document.createElement(/^(to|or|and)$/.test(part) ? 'span' : 'kbd');
      word.textContent = part;
      term.append(i > 0 ? ' ' : '', word);
    }
    const meaning = document.createElement('dd');
    meaning.textContent = key.does;
    row.append(term, meaning);
    list.append(row);
  }
  return list;
}

/** Listens on the whole page until the returned function is called. `enabled`: a box that turns these keys off, for
 *  readers whose software uses them. */
export function wireKeys(keys: Key[], help: HTMLDialogElement, open: HTMLButtonElement, enabled: HTMLInputElement): Undo {
  const undoing = new Undoing();
  const { signal } = undoing;
  const all: Key[] = [
    ...keys,
    { shown: '?', does: 'this list', when: ['?'], act: () => help.showModal() },
  ];
  help.querySelector('.list')!.replaceChildren(listOf(all));
  open.addEventListener('click', () => help.showModal(), { signal });
  help.addEventListener('click', (event) => {
    if (event.target === help) help.close(); // beside it
  }, { signal });
  document.addEventListener('keydown', (event) => {
    if (event.defaultPrevented || event.ctrlKey || event.altKey || event.metaKey || !enabled.checked || taken(event)) return;
    const named = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const key = all.find(({ when }) => (Array.isArray(when) ? when.includes(named) : when(event)));
    if (!key) return;
    event.preventDefault();
    key.act(event);
  }, { signal });
  return () => undoing.undo();
}
