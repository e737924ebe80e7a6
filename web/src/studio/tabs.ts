// SPDX-License-Identifier: GPL-3.0-or-later
// Base and its variants, one tab each, with a menu for the edited one; "What if…" adds variants.
import { at, button, element } from '../page/dom';
import { faceColour } from '../page/face_colour';
import { upper } from '../page/format';
import { chooseFace } from '../replay/face/face_chooser';
import { briefName } from './brief_name';
import { Refused, type Connection } from './connection';
import type { Edits } from './edits';
import { menuOf, type Menu } from './menu';
import { isRecord, type Preset } from './messages';
import type { StudioState } from './studio_state';
import { words } from './words';

/** "palsy_complete_R" is "palsy_complete". */
const stemOf = (preset: string): string => preset.replace(/_[LR]$/, '');

export class Tabs {
  presets: Preset[] = [];
  readonly whatIf: Menu;
  private faceMenus: Menu[] = [];
  private built = '';

  /** `strengthChanged`: a face was made with another strength of what muscles.gain so names. */
  constructor(
    private readonly state: StudioState, private readonly connection: Connection, private readonly edits: Edits,
    private readonly strengthChanged: (gain: string) => void,
  ) {
    state.sceneChanged.add(() => this.build());
    state.shown.onChange(() => this.show());
    // Colours come with the first face.
    state.source.onChange((change) => {
      if (change === 'face') this.built = '';
      this.build();
    });
    this.whatIf = menuOf(at('what-if'), words.whatIf, (sheet, close) => this.fillWhatIf(sheet, close));
  }

  private build(): void {
    const faces = this.state.scene?.faces ?? [];
    const built = JSON.stringify(faces.map(({ name }) => name));
    if (built !== this.built) {
      this.built = built;
      for (const { sheet } of this.faceMenus) sheet.remove();
      this.faceMenus = [];
      at('tabs').replaceChildren(...faces.map(({ name }, i) => this.tab(name, i)));
    }
    this.show();
  }

  private tab(name: string, i: number): HTMLElement {
    const tab = element('div', '', 'tab');
    tab.style.setProperty('--face', faceColour(i));
    const choose = button('', 'tab-name', () => chooseFace(this.state.shown, i));
    choose.dataset.face = String(i);
    choose.append(element('i'), i === 0 ? words.base : name);
    tab.append(choose);
    if (i === 0) return tab;
    choose.addEventListener('dblclick', () => this.rename(tab, name, i));
    const more = button('⋯', 'tab-more', () => {});
    more.title = words.faceMenu(name);
    more.setAttribute('aria-label', words.faceMenu(name));
    tab.append(more);
    this.faceMenus.push(menuOf(more, words.faceMenu(name), (sheet, close) => {
      const entry = (text: string, act: () => void) => sheet.append(button(text, 'entry', () => {
        close();
        act();
      }));
      entry(words.rename, () => this.rename(tab, name, i));
      entry(words.duplicate, () => this.try(() => this.edits.addFace(words.copyOf(name), i)));
      entry(words.remove, () => this.try(() => this.remove(i)));
    }));
    return tab;
  }

  private show(): void {
    const { shown } = this.state;
    const two = shown.mode !== 'single';
    for (const choose of at('tabs').querySelectorAll<HTMLButtonElement>('.tab-name')) {
      const i = Number(choose.dataset.face);
      choose.setAttribute('aria-pressed', String(i === this.state.edited));
      choose.parentElement!.classList.toggle('chosen', i === this.state.edited);
      choose.parentElement!.classList.toggle('beside', two && i === shown.first && i !== this.state.edited);
    }
  }

  private rename(tab: HTMLElement, name: string, i: number): void {
    const field = element('input', '', 'tab-rename');
    Object.assign(field, { type: 'text', value: name, maxLength: 60 });
    field.setAttribute('aria-label', words.renameTo);
    let done = false;
    const finish = (take: boolean) => {
      if (done) return;
      done = true;
      this.built = '';
      const next = field.value.trim();
      if (take && next && next !== name) this.try(() => this.connection.request('rename_variant', { face: i, name: next }));
      this.build();
    };
    field.addEventListener('keydown', ({ key }) => {
      if (key === 'Enter' || key === 'Escape') finish(key === 'Enter');
    });
    field.addEventListener('blur', () => finish(true));
    tab.replaceChildren(element('i'), field);
    field.focus();
    field.select();
  }

  private async remove(i: number): Promise<void> {
    await this.connection.request('remove_variant', { face: i });
    if (this.state.source.replay.faces.length > (this.state.scene?.faces.length ?? 0)) this.state.without(i);
  }

  private fillWhatIf(sheet: HTMLElement, close: () => void): void {
    sheet.classList.add('what-if-sheet');
    sheet.append(element('h3', words.weakerTitle), this.weaker(close));
    sheet.append(element('h3', words.presetsTitle));
    const list = element('div', '', 'entries');
    // Those of a side in one row for both.
    for (const stem of new Set(this.presets.map(({ name }) => stemOf(name)))) {
      const own = this.presets.filter(({ name }) => stemOf(name) === stem);
      const row = element('div', '', 'preset');
      const title = element('div');
      title.append(element('b', upper(stem.replaceAll('_', ' '))), element('small', own[0].summary));
      row.title = words.presetSource(own[0].source, own[0].assumed);
      row.append(title, ...own.map((preset) => this.presetButton(preset, close)));
      list.append(row);
    }
    sheet.append(list, element('h3', words.emptyTitle), button(words.emptyAdd, 'entry', () => {
      close();
      this.try(async () => this.focus(await this.edits.addFace(words.newVariant, this.state.edited)));
    }));
  }

  /** Moves the keyboard focus to a face's tab. */
  private focus(face: number): void {
    at('tabs').querySelector<HTMLElement>(`.tab-name[data-face="${face}"]`)?.focus();
  }

  /** Of base: beside other changes, of the muscles for example, those of the preset would not hold. */
  private presetButton({ name }: Preset, close: () => void): HTMLButtonElement {
    const stem = stemOf(name);
    const side = name === stem ? null : words.sideNames[name.slice(-1) as 'L' | 'R'];
    const called = side ? words.ofSide(stem.replaceAll('_', ' '), side) : stem.replaceAll('_', ' ');
    const made = button(side ?? words.presetAdd, 'quiet', () => {
      close();
      this.try(async () => this.focus(await this.edits.addFace(called, 0, name)));
    });
    made.setAttribute('aria-label', side ? upper(called) : `${words.presetAdd}: ${called}`);
    made.dataset.preset = name;
    return made;
  }

  /** The most common change: a weaker side, branch of the facial nerve or muscle, with the words and percentages of the
   *  muscles' panel. */
  private weaker(close: () => void): HTMLElement {
    const form = element('form', '', 'weaker');
    const what = this.muscleChooser();
    const to = element('input');
    Object.assign(to, { type: 'number', min: '0', max: '200', step: '5', value: '70', required: true, title: words.weakerToHint });
    const field = (text: string, control: HTMLElement, unit = '') => {
      const label = element('label');
      label.append(element('span', text), control, unit);
      return label;
    };
    const add = element('button', words.weakerAdd, 'primary');
    add.type = 'submit';
    form.append(field(words.weakerWhat, what), field(words.weakerTo, to, ' %'), add);
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      close();
      const gain = what.value;
      const percent = Number(to.value);
      this.try(async () => {
        const values = this.state.valuesOf(0);
        const base = values['muscles.gain'];
        const changes = { 'muscles.gain': { ...(isRecord(base) ? base : {}), [gain]: Number((percent / 100).toFixed(3)) } };
        const face = await this.edits.addFace(briefName(changes, values, this.state.muscles) || words.newVariant, 0);
        this.focus(face);
        await this.edits.change(face, changes);
        this.strengthChanged(gain);
      });
    });
    return form;
  }

  /** What muscles.gain may name. */
  private muscleChooser(): HTMLSelectElement {
    const { muscles } = this.state;
    const select = element('select');
    const group = (title: string, names: [stem: string, called: (side: string) => string][]) => {
      const made = element('optgroup');
      made.label = title;
      for (const [stem, called] of names)
        for (const side of ['R', 'L'] as const) made.append(new Option(upper(called(words.sideNames[side])), `${stem}_${side}`));
      select.append(made);
    };
    group(words.wholeSide, [['side', words.weakerSide]]);
    group(words.branches, [...new Set(muscles.map(({ branch }) => branch))].map((branch) => {
      const brief = words.branchNames[branch] ?? upper(branch);
      return [branch, (side) => words.ofSide(words.weakerBranch(brief), side)];
    }));
    group(words.weakerMuscles, muscles.map(({ name, latin }) => [name, (side) => words.ofSide(latin, side)]));
    return select;
  }

  /** Shows refusals of the server beside the tabs. */
  private try(act: () => Promise<unknown>): void {
    const problem = at('tabs-problem');
    problem.hidden = true;
    act().catch((error: unknown) => {
      if (!(error instanceof Refused)) return;
      problem.textContent = error.message;
      problem.hidden = false;
    });
  }
}
