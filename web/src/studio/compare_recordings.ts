// SPDX-License-Identifier: GPL-3.0-or-later
// The present recording against the one before, as two visits of one person: what has changed, and a page of it.
import { button, element, unbroken } from '../page/dom';
import { fileName } from '../page/save';
import { Refused, type Connection } from './connection';
import type { CompareVisitsRequest } from './protocol';
import type { StudioState } from './studio_state';
import { words } from './words';

type Expression = CompareVisitsRequest['expression'];

export class CompareRecordings {
  private readonly box = element('section', '', 'compare-recordings');
  private readonly title = element('p');
  private readonly expression = element('select');
  private readonly go: HTMLButtonElement;
  private readonly result = element('div', '', 'compare-result');
  private readonly problem = element('p', '', 'problem');
  /** The scene that the result is of. */
  private text = '';

  constructor(private readonly state: StudioState, private readonly connection: Connection, into: HTMLElement) {
    this.result.setAttribute('role', 'status');
    this.problem.setAttribute('role', 'alert');
    this.problem.hidden = true;
    for (const [name, shown] of Object.entries(words.expressions)) {
      const option = element('option', shown);
      option.value = name;
      this.expression.append(option);
    }
    this.expression.setAttribute('aria-label', words.comparePerformed);
    this.go = button(words.compareGo, 'quiet', () => void this.compare());
    const row = element('div', '', 'compare-row');
    row.append(this.expression, this.go);
    this.box.append(this.title, row, this.result, this.problem);
    into.append(this.box);
    state.sceneChanged.add(() => this.show());
    this.show();
  }

  private show(): void {
    const earlier = this.state.scene?.earlier ?? '';
    this.box.hidden = earlier === '';
    this.title.textContent = words.compareTitle(earlier);
    if (this.state.scene?.text === this.text) return;
    this.result.replaceChildren();
    this.problem.hidden = true;
  }

  private async compare(): Promise<void> {
    const text = this.state.scene?.text ?? '';
    this.go.disabled = true;
    this.problem.hidden = true;
    this.result.replaceChildren();
    try {
      const wanted = fileName(`visits ${this.expression.value}`, '').replace(/\.$/, '');
      const { name } = await this.connection.request('free_name', { name: wanted });
      const { path, sentences } = await this.connection.request('compare_visits', { expression: this.expression.value as Expression, name });
      this.text = text;
      for (const sentence of sentences as string[]) {
        const line = element('p');
        line.append(...unbroken(sentence));
        this.result.append(line);
      }
      this.result.append(element('p', words.compareSaved(path), 'why'));
    } catch (error) {
      this.problem.hidden = false;
      this.problem.textContent = error instanceof Refused ? error.message : words.lost;
    } finally {
      this.go.disabled = false;
    }
  }
}
