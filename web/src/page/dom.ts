// SPDX-License-Identifier: GPL-3.0-or-later
// Finding and making elements of a page.

export const at = <T extends HTMLElement>(id: string): T => document.getElementById(id) as T;

export function element<K extends keyof HTMLElementTagNameMap>(tag: K, text = '', className = ''): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  made.textContent = text;
  made.className = className;
  return made;
}

/** A text for a paragraph whose numbers stay beside their units, "(± 0.6 mm)", where it breaks into lines. */
export const unbroken = (text: string): (string | HTMLElement)[] =>
  text.split(/(\(?(?:± )?\d[\d.]* (?:mm|s|%)(?![\p{L}\d])[).,:;]*)/u)
    .map((part, i) => (i % 2 === 1 ? element('span', part, 'unbroken') : part));

export function button(text: string, className: string, press: () => void): HTMLButtonElement {
  const made = element('button', text, className);
  made.type = 'button';
  made.addEventListener('click', press);
  return made;
}

/** A box that puts `item` into `chosen` and takes it out; `changed` is called after each change. */
export function memberBox<T>(chosen: Set<T>, item: T, changed: () => void): HTMLInputElement {
  const box = document.createElement('input');
  box.type = 'checkbox';
  box.checked = chosen.has(item);
  box.addEventListener('change', () => {
    if (box.checked) chosen.add(item);
    else chosen.delete(item);
    changed();
  });
  return box;
}

/** Shows an error instead of the title if the page cannot start. */
export function startPage(start: () => void): void {
  try {
    start();
  } catch (error) {
    at('title').textContent = error instanceof Error ? error.message : String(error);
  }
}
