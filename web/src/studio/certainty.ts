// SPDX-License-Identifier: GPL-3.0-or-later
// How certain the answer is with all errors: asked for, as it takes a while, and shown as intervals.
import { button, element, unbroken } from '../page/dom';
import { fixed } from '../page/format';
import type { Connection } from './connection';
import type { BudgetFigure } from './messages';
import type { StudioState } from './studio_state';
import { words } from './words';

interface Budget {
  figures: BudgetFigure[];
  missing: string[];
  jitterKnown: boolean;
  /** The scene that it is of. */
  text: string;
}

export class Certainty {
  private budget: Budget | null = null;
  /** The text of the scene for which intervals were requested; null: no request is waiting for an answer. */
  private askedText: string | null = null;
  private readonly ask: HTMLButtonElement;
  private readonly lines = element('ul', '', 'certainty-lines');

  constructor(private readonly state: StudioState, private readonly connection: Connection, into: HTMLElement, private readonly problem: (text: string) => void) {
    this.ask = button(words.certaintyAsk, 'certainty-ask quiet', () => void this.request());
    this.ask.title = words.certaintyHint;
    this.lines.setAttribute('aria-label', words.certaintyTitle);
    into.append(this.ask, this.lines);
    state.sceneChanged.add(() => this.show());
    state.shown.onChange(() => this.show());
    this.show();
  }

  /** The event budget; null: the work has ended without one. */
  take(budget: Budget | null): void {
    this.budget = budget;
    this.askedText = null;
    this.show();
  }

  /** The figures of the corners of the mouth for the present scene, as a run's summary has them; null: none. */
  figuresOf(text: string | null): BudgetFigure[] | null {
    return this.budget !== null && this.budget.text === text ? this.budget.figures : null;
  }

  /** Whether the server is at work on it. */
  get waiting(): boolean {
    return this.askedText !== null && this.askedText === this.state.scene?.text;
  }

  private async request(): Promise<void> {
    this.askedText = this.state.scene?.text ?? null;
    this.show();
    try {
      await this.connection.request('error_budget', {});
    } catch (error) {
      this.problem(String(error));
      this.take(null);
    }
  }

  private show(): void {
    const { state, budget } = this;
    // The server drops the work with every change.
    if (this.askedText !== null && this.askedText !== state.scene?.text) this.askedText = null;
    const known = budget !== null && budget.text === state.scene?.text;
    this.ask.hidden = known || !state.scene;
    this.ask.disabled = this.waiting;
    this.ask.textContent = this.waiting ? words.certaintyWaiting : words.certaintyAsk;
    this.lines.hidden = !known;
    this.lines.replaceChildren(...(known ? this.sentences(budget).map((text) => {
      const line = element('li');
      line.append(...unbroken(text));
      return line;
    }) : []));
  }

  private sentences({ figures, missing, jitterKnown }: Budget): string[] {
    const { edited } = this.state;
    const variant = edited === 0 ? undefined : this.state.nameOf(edited);
    const own = figures.filter((figure) => figure.variant === variant && figure.value_mm !== null);
    if (own.length === 0) return [words.noCorners];
    return [
      ...own.map(sentence),
      ...(missing.length > 0 ? [words.certaintyMissing(missing.length)] : []),
      ...(jitterKnown ? [] : [words.certaintyNoJitter]),
    ];
  }
}

function sentence({ figure, side, value_mm, shown_mm, half_width_95_mm, known_half_width_95_mm, decided, largest_part }: BudgetFigure): string {
  const value = value_mm ?? 0, shown = shown_mm ?? value;
  const what = figure === 'difference' ? words.certaintyApart : words.certaintyOf(words.sideNames[side ?? 'R'], figure === 'change');
  const interval = half_width_95_mm === null ? words.certaintyAtLeast(fixed(shown, 1), fixed(known_half_width_95_mm, 1))
    : words.certaintyInterval(fixed(shown, 1), fixed(Math.min(value - half_width_95_mm, shown), 1), fixed(Math.max(value + half_width_95_mm, shown), 1), largest_part);
  const verdict = decided === false ? words.certaintyUndecided : decided === null ? words.certaintyCannotTell : '';
  return [`${what} ${interval}`, verdict].filter(Boolean).join(', ');
}
