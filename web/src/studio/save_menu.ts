// SPDX-License-Identifier: GPL-3.0-or-later
// The menu of things to save: their name, and the path after saving.
import { at, button, element } from '../page/dom';
import { fileName } from '../page/save';
import { Refused, type Connection } from './connection';
import { menuOf, type Menu } from '../page/menu';
import type { SaveRequest } from './protocol';
import type { StudioState } from './studio_state';
import { words } from './words';

const kinds: { what: SaveRequest['what']; name: string; hint: string }[] = [
  { what: 'scene', name: words.saveScene, hint: words.saveSceneHint },
  { what: 'report', name: words.saveReport, hint: words.saveReportHint },
  { what: 'run', name: words.saveRun, hint: words.saveRunHint },
  { what: 'landmarks', name: words.saveLandmarks, hint: words.saveLandmarksHint },
  { what: 'landmarks_json', name: words.saveLandmarksJson, hint: words.saveLandmarksJsonHint },
];

export class SaveMenu {
  readonly menu: Menu;
  folder = '';
  private name = '';
  /** The scene for which the name was proposed. */
  private named = '';

  constructor(private readonly state: StudioState, private readonly connection: Connection, private readonly done: (text: string) => void) {
    this.menu = menuOf(at('save-menu'), words.save, (sheet) => this.fill(sheet));
  }

  private fill(sheet: HTMLElement): void {
    sheet.classList.add('save-sheet');
    const title = this.state.scene?.title ?? '';
    if (title !== this.named) this.name = '';
    this.named = title;
    const proposed = this.name === '';
    this.name ||= fileName(this.state.scene?.title || 'hyperex', '').replace(/\.$/, '');
    const field = element('input');
    Object.assign(field, { type: 'text', value: this.name, maxLength: 60, id: 'save-name' });
    field.addEventListener('input', () => (this.name = field.value));
    if (proposed) void this.propose(field);
    const label = element('label', '', 'save-name');
    label.append(element('span', words.saveName), field);
    const status = element('p', '', 'status');
    status.setAttribute('role', 'status');
    const problem = element('p', '', 'problem');
    problem.setAttribute('role', 'alert');
    problem.hidden = true;
    const buttons = kinds.map(({ what, name, hint }) => {
      const made = button('', 'entry', () => void this.save(what, buttons, status, problem));
      made.append(element('b', name), element('small', hint));
      made.dataset.save = what;
      return made;
    });
    sheet.append(label, element('p', words.saveInto(this.folder), 'why'), ...buttons, status, problem);
  }

  /** Replaces the name by a free one. */
  private async propose(field: HTMLInputElement): Promise<void> {
    const wanted = this.name;
    try {
      const { name } = await this.connection.request('free_name', { name: wanted });
      if (this.name !== wanted) return; // another one was typed meanwhile
      this.name = field.value = name;
    } catch {
      // Saving reports the error.
    }
  }

  private async save(what: SaveRequest['what'], buttons: HTMLButtonElement[], status: HTMLElement, problem: HTMLElement): Promise<void> {
    for (const one of buttons) one.disabled = true;
    problem.hidden = true;
    status.textContent = words.saving;
    try {
      const { path } = await this.connection.request('save', { what, name: this.name.trim() });
      status.textContent = words.saved(path);
      this.done(words.saved(path));
    } catch (error) {
      status.textContent = '';
      problem.hidden = false;
      problem.textContent = error instanceof Refused ? error.message : words.lost;
    } finally {
      for (const one of buttons) one.disabled = false;
    }
  }
}
