// SPDX-License-Identifier: GPL-3.0-or-later
// A list of choices in groups, with a search field above it. The arrow keys move the selection and Enter takes it. A
// number at the end of the search text sets how much: "zygomatic right 30", "cheek left 2 ml", "lower jaw 4 mm".
import { element } from '../page/dom';
import { holds, type Bounds } from './bounds';
import { words } from './words';

/** How much of a choice there is. */
export interface Amount {
  unit: '%' | 'ml' | 'mm';
  /** If no number is typed. */
  usual: number;
  bounds: Bounds;
}

export interface Choice {
  group: string;
  /** Names it for tests and the server. */
  value: string;
  text: string;
  /** Beside it; with an amount, what it would be. */
  detail: string | ((amount: number) => string);
  /** Below the list while it is chosen. */
  says?: string;
  amount?: Amount;
  /** `amount`: what was typed, or the usual one; 0 where the choice has none. */
  take(amount: number): void;
}

/** Letters and numbers; a dot stays between digits alone. */
const plain = (text: string): string =>
  text.toLowerCase().normalize('NFD').replace(/[^a-z0-9%.]+/g, ' ').replace(/(?<!\d)\.|\.(?!\d)/g, ' ');
const wordsOf = (text: string): string[] => plain(text).split(' ').filter(Boolean);

export interface Query {
  /** The words to find in choices with an amount, and in all others. */
  parts: string[];
  all: string[];
  /** At its end, with its unit where that is typed. */
  amount: number | null;
  unit: string;
}

export function readQuery(typed: string): Query {
  const text = typed.toLowerCase().replace(/(\d),(\d)/g, '$1.$2').replaceAll('−', '-');
  const found = /^(.*?)\s*(?<![a-z0-9.])(-?\d{1,3}(?:\.\d+)?)\s*(%|ml|mm)?\s*$/.exec(text);
  const all = wordsOf(text);
  return found ? { parts: wordsOf(found[1]), all, amount: Number(found[2]), unit: found[3] ?? '' } : { parts: all, all, amount: null, unit: '' };
}

/** What is typed as an amount of this choice; null: it is none. */
function amountOf({ amount: of }: Choice, { amount, unit }: Query): number | null {
  if (!of || amount === null || (unit !== '' && unit !== of.unit)) return null;
  // No millimetre and no millilitre are no change.
  return holds(of.bounds, amount) && (amount !== 0 || of.unit === '%') ? amount : null;
}

/** The choices that have all words. */
export function matching(choices: Choice[], typed: string): Choice[] {
  const query = readQuery(typed);
  return choices.filter((choice) => {
    const text = plain(`${choice.text} ${choice.group} ${typeof choice.detail === 'string' ? choice.detail : ''}`);
    return (amountOf(choice, query) === null ? query.all : query.parts).every((part) => text.includes(part));
  });
}

let count = 0;

class Chooser {
  private readonly find = element('input', '', 'chooser-find');
  private readonly list = element('div', '', 'chooser-list');
  private readonly says = element('p', words.chooserSays, 'chooser-says');
  private shown: Choice[] = [];
  private active = 0;
  private readonly id = `choices-${++count}`;

  constructor(sheet: HTMLElement, private readonly choices: Choice[], private readonly close: () => void) {
    const { find, list } = this;
    Object.assign(find, { type: 'search', placeholder: words.chooserFind, autocomplete: 'off', spellcheck: false });
    for (const [name, value] of Object.entries({ role: 'combobox', 'aria-label': words.chooserFind, 'aria-expanded': 'true', 'aria-autocomplete': 'list', 'aria-controls': this.id }))
      find.setAttribute(name, value);
    list.id = this.id;
    list.setAttribute('role', 'listbox');
    list.setAttribute('aria-label', words.chooserList);
    this.says.setAttribute('role', 'status');
    find.addEventListener('input', () => this.fill());
    find.addEventListener('keydown', (event) => this.press(event));
    sheet.append(find, list, this.says);
    this.fill();
  }

  private amountOf(choice: Choice): number {
    return amountOf(choice, readQuery(this.find.value)) ?? choice.amount?.usual ?? 0;
  }

  private fill(): void {
    this.shown = matching(this.choices, this.find.value);
    this.active = 0;
    const groups = new Map<string, HTMLElement>();
    this.shown.forEach((choice, i) => {
      const group = groups.get(choice.group) ?? this.group(choice.group);
      groups.set(choice.group, group);
      group.append(this.option(choice, i));
    });
    this.list.replaceChildren(...groups.values());
    this.mark();
  }

  private group(name: string): HTMLElement {
    const group = element('div');
    const title = element('h3', name);
    title.setAttribute('role', 'presentation');
    group.setAttribute('role', 'group');
    group.setAttribute('aria-label', name);
    group.append(title);
    return group;
  }

  private option(choice: Choice, i: number): HTMLElement {
    const option = element('div', '', 'choice');
    option.id = `${this.id}-${i}`;
    option.setAttribute('role', 'option');
    option.dataset.choice = choice.value;
    option.append(element('span', choice.text), element('small', typeof choice.detail === 'string' ? choice.detail : choice.detail(this.amountOf(choice))));
    if (choice.says) option.append(element('small', choice.says, 'choice-says'));
    option.addEventListener('click', () => this.take(choice));
    return option;
  }

  private press(event: KeyboardEvent): void {
    const { length } = this.shown;
    const to: Record<string, number> = { ArrowDown: this.active + 1, ArrowUp: this.active - 1, PageDown: this.active + 8, PageUp: this.active - 8 };
    if (event.key === 'Enter') {
      event.preventDefault();
      if (length > 0) this.take(this.shown[this.active]);
    } else if (event.key === 'Escape') {
      event.preventDefault(); // which would only empty the field
      this.close();
    } else if (event.key in to && length > 0) {
      event.preventDefault();
      this.active = Math.abs(to[event.key] - this.active) === 1 ? (to[event.key] + length) % length : Math.min(Math.max(to[event.key], 0), length - 1);
      this.mark();
    }
  }

  private mark(): void {
    const { find, list, shown, active } = this;
    const options = list.querySelectorAll<HTMLElement>('[role=option]');
    options.forEach((option, i) => option.setAttribute('aria-selected', String(i === active)));
    const chosen = options[active];
    if (chosen) find.setAttribute('aria-activedescendant', chosen.id);
    else find.removeAttribute('aria-activedescendant');
    // The title of a group stays over its first choice.
    if (chosen && active > 0) chosen.scrollIntoView({ block: 'nearest' });
    else list.scrollTop = 0;
    this.says.textContent = shown.length === 0 ? words.chooserNone : shown[active].says ?? words.chooserSays;
  }

  private take(choice: Choice): void {
    const amount = this.amountOf(choice);
    this.close();
    choice.take(amount);
  }
}

export function fillChooser(sheet: HTMLElement, choices: Choice[], close: () => void): void {
  sheet.classList.add('what-if-sheet');
  new Chooser(sheet, choices, close);
}
