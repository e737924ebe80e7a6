// SPDX-License-Identifier: GPL-3.0-or-later
// Which of the recording's points move with the skull alone, so that the head's pose is found from them.
import { button, element } from '../page/dom';
import type { Edits } from './edits';
import type { StudioState } from './studio_state';
import { words } from './words';

const key = 'motion.rigid_points';
/** Least number of points for a pose. */
const fewest = 3;

export class RigidPoints {
  readonly element = element('details', '', 'rigid-points');
  private readonly summary = element('summary');
  private readonly list = element('ul');
  private readonly apply: HTMLButtonElement;
  private readonly hint = element('p', '', 'hint');
  private shown = '';

  constructor(private readonly state: StudioState, edits: Edits) {
    this.apply = button(words.rigidApply, 'quiet', () => void edits.ofBase({ [key]: this.chosen() }));
    this.hint.setAttribute('role', 'status');
    this.element.append(this.summary, element('p', words.rigidWhy), this.list, this.hint, this.apply);
    this.list.addEventListener('change', () => this.judge());
    state.sceneChanged.add(() => this.show());
  }

  private show(): void {
    const { scene } = this.state;
    const values = this.state.valuesOf(0);
    const file = values['motion.file'];
    this.element.hidden = !scene || typeof file !== 'string' || file === '' || file === 'embedded';
    if (!scene || this.element.hidden) return;
    const named = (values[key] as string[] | undefined) ?? [];
    this.summary.textContent = named.length > 0 ? words.rigidNamed(named.length) : words.rigidFound;
    const shown = JSON.stringify([scene.points, named]);
    if (shown === this.shown) return;
    this.shown = shown;
    this.list.replaceChildren(...scene.points.map((name) => {
      const box = element('input');
      Object.assign(box, { type: 'checkbox', value: name, checked: named.includes(name) });
      const label = element('label');
      label.append(box, name);
      const item = element('li');
      item.append(label);
      return item;
    }));
    this.judge();
  }

  private chosen(): string[] {
    return [...this.list.querySelectorAll('input')].filter(({ checked }) => checked).map(({ value }) => value);
  }

  private judge(): void {
    const few = this.chosen().length < fewest;
    this.apply.disabled = few;
    this.hint.textContent = few ? words.rigidFew(fewest) : '';
  }
}
