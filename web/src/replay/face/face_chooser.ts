// SPDX-License-Identifier: GPL-3.0-or-later
// The choice of one or two faces to show: a button per face in its colour, and their names over the picture.
import type { Face, Replay } from '../data';
import { at } from '../../page/dom';
import type { Undoing } from '../../page/listeners';
import { faceColour } from '../../page/face_colour';
import { faceWords } from '../../page/format';
import type { Mode, Shown } from '../shown';
import { changesOf } from '../variants';

const swatch = (i: number): HTMLElement => {
  const dot = document.createElement('i');
  dot.style.background = faceColour(i);
  return dot;
};

function fillChips(replay: Replay, group: HTMLElement, choose: (face: number) => void): HTMLButtonElement[] {
  group.replaceChildren();
  return replay.faces.map((_face, i) => {
    const chip = document.createElement('button');
    chip.type = 'button';
    chip.className = 'chip';
    chip.dataset.face = String(i);
    chip.append(swatch(i), faceWords(replay.faces, i));
    chip.title = changesOf(replay, i).join('\n');
    chip.style.setProperty('--face', faceColour(i));
    chip.addEventListener('click', () => choose(i));
    group.append(chip);
    return chip;
  });
}

/** A label over the picture: the face's name, which is also a menu of the others, and a remark on the face. */
class FaceLabel {
  private readonly dot = swatch(0);
  private readonly select = document.createElement('select');
  private readonly words = document.createElement('span');

  constructor(private readonly label: HTMLElement, private readonly replay: Replay, choose: (face: number) => void) {
    const name = document.createElement('div');
    name.className = 'name';
    replay.faces.forEach((_face, i) => this.select.add(new Option(faceWords(replay.faces, i), String(i))));
    this.select.addEventListener('change', () => choose(Number(this.select.value)));
    name.append(this.dot, this.select);
    this.words.className = 'words';
    label.replaceChildren(name, this.words);
  }

  show(i: number, side: string, note: string): void {
    this.label.hidden = false;
    this.dot.style.background = faceColour(i);
    this.select.value = String(i);
    this.select.setAttribute('aria-label', side);
    this.words.textContent = [changesOf(this.replay, i).join(', '), note].filter((text) => text).join(' \u00b7 ');
    this.words.title = this.words.textContent;
  }

  hide(): void {
    this.label.hidden = true;
  }
}

/** Two faces: base left, and right the one that was shown. Back to one: the right one. */
export function changeMode(shown: Shown, mode: Mode): void {
  if (mode === shown.mode) return;
  if (mode === 'single') shown.set({ mode, first: shown.second });
  else if (shown.mode === 'single') shown.set({ mode, first: 0, second: shown.first || shown.second || 1 });
  else shown.set({ mode });
}

/** The face shown; of two, the right one. */
export const chooseFace = (shown: Shown, face: number): void =>
  shown.set(shown.mode === 'single' ? { first: face } : { second: face });

/** Wires the controls around the stage until `undoing`; without variants they stay hidden. A page may have no chips
 *  and let the faces be chosen otherwise. Returns what says a word on each of the faces shown. */
export function wireFaces(replay: Replay, shown: Shown, undoing: Undoing): (note: (face: Face) => string) => void {
  const several = replay.faces.length > 1;
  const row = document.getElementById('faces');
  for (const part of [row, at('modes'), at('swap')]) if (part) part.hidden = !several;
  at('canvas-host').dataset.mode = shown.mode;
  if (!several) {
    for (const id of ['first-label', 'second-label']) at(id).hidden = true;
    return () => {};
  }
  const group = document.getElementById('chips');
  const chips = group ? fillChips(replay, group, (face) => chooseFace(shown, face)) : [];
  const first = new FaceLabel(at('first-label'), replay, (face) => shown.set({ first: face }));
  const second = new FaceLabel(at('second-label'), replay, (face) => shown.set({ second: face }));
  const modes = [...at('modes').querySelectorAll('button')];
  const { signal } = undoing;
  for (const button of modes) button.addEventListener('click', () => changeMode(shown, button.dataset.mode as Mode), { signal });
  at('swap').addEventListener('click', () => shown.set({ first: shown.second, second: shown.first }), { signal });

  let note: (face: Face) => string = () => '';
  const show = () => {
    const two = shown.mode !== 'single';
    for (const button of modes) button.setAttribute('aria-pressed', String(button.dataset.mode === shown.mode));
    chips.forEach((chip, i) => chip.setAttribute('aria-pressed', String(i === (two ? shown.second : shown.first))));
    group?.setAttribute('aria-label', two ? 'Face on the right' : 'Face');
    at<HTMLButtonElement>('swap').disabled = !two;
    at('canvas-host').dataset.mode = shown.mode;
    first.show(shown.first, two ? 'Face on the left' : 'Face', note(replay.faces[shown.first]));
    if (two) second.show(shown.second, 'Face on the right', note(replay.faces[shown.second]));
    else second.hide();
  };
  undoing.add(shown.onChange(show));
  show();
  return (next) => {
    note = next;
    show();
  };
}
