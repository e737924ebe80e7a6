// SPDX-License-Identifier: GPL-3.0-or-later
// Base and its variants, one tab each, with a menu.
import { at, button, element } from '../page/dom';
import { faceColour } from '../page/face_colour';
import { chooseFace } from '../replay/face/face_chooser';
import type { Connection } from './connection';
import type { Edits } from './edits';
import { menuOf, type Menu } from '../page/menu';
import type { StudioState } from './studio_state';
import { tryChange } from './try_change';
import { words } from './words';

export class Tabs {
  private faceMenus: Menu[] = [];
  private built = '';

  constructor(private readonly state: StudioState, private readonly connection: Connection, private readonly edits: Edits) {
    state.sceneChanged.add(() => this.build());
    state.shown.onChange(() => this.show());
    // Colours come with the first face.
    state.source.onChange((change) => {
      if (change === 'face') this.built = '';
      this.build();
    });
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
    choose.title = name;
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
      entry(words.duplicate, () => tryChange(() => this.edits.addFace(words.copyOf(name), i)));
      entry(words.remove, () => tryChange(() => this.edits.removeFace(i)));
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
      if (i === this.state.edited) this.reveal(choose.parentElement!);
      choose.parentElement!.classList.toggle('beside', two && i === shown.first && i !== this.state.edited);
    }
  }

  /** Scrolls the row of faces, and nothing else. */
  private reveal(tab: HTMLElement): void {
    for (const row of [at('tabs'), at('faces-row')]) {
      const [own, around] = [tab.getBoundingClientRect(), row.getBoundingClientRect()];
      if (own.left < around.left) row.scrollLeft += own.left - around.left;
      else if (own.right > around.right) row.scrollLeft += Math.min(own.right - around.right, own.left - around.left);
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
      if (take && next && next !== name) tryChange(() => this.connection.request('rename_variant', { face: i, name: next }));
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
}
