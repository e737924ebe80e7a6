// SPDX-License-Identifier: GPL-3.0-or-later
// Which face is looked at, or which two: a button each in the face's colour, and their names over the picture.
import type { Face, Replay } from './data';
import { faceColour } from './face_colour';
import type { Mode, Shown } from './shown';

/** As people read it. */
export const faceTitle = (face: Face): string => (face.difference ? face.name : 'The scene itself');

const swatch = (i: number): HTMLElement => {
  const dot = document.createElement('i');
  dot.style.background = faceColour(i);
  return dot;
};

function chipsOf(replay: Replay, group: HTMLElement, choose: (face: number) => void): HTMLButtonElement[] {
  return replay.faces.map((face, i) => {
    const chip = document.createElement('button');
    chip.type = 'button';
    chip.className = 'chip';
    chip.dataset.face = String(i);
    chip.append(swatch(i), faceTitle(face));
    chip.title = face.changes.join('\n');
    chip.style.setProperty('--face', faceColour(i));
    chip.addEventListener('click', () => choose(i));
    group.append(chip);
    return chip;
  });
}

/** Fills a label over the picture: the face's name, and what differs in it. */
function fillLabel(label: HTMLElement, face: Face, i: number): void {
  const name = document.createElement('b');
  name.append(swatch(i), faceTitle(face));
  const changes = document.createElement('span');
  changes.textContent = face.changes.join(', ');
  label.replaceChildren(name, ...(face.changes.length > 0 ? [changes] : []));
}

/** `host` holds the elements named below; without variants all stay hidden. */
export function wireFaces(replay: Replay, shown: Shown, at: (id: string) => HTMLElement): void {
  if (replay.faces.length < 2) return;
  at('faces').hidden = false;
  const first = chipsOf(replay, at('first-faces'), (face) => shown.set({ first: face }));
  const second = chipsOf(replay, at('second-faces'), (face) => shown.set({ second: face }));
  const modes = [...at('modes').querySelectorAll('button')];
  for (const button of modes)
    button.addEventListener('click', () => shown.set({ mode: button.dataset.mode as Mode }));
  at('swap').addEventListener('click', () => shown.set({ first: shown.second, second: shown.first }));

  const show = () => {
    const two = shown.mode !== 'single';
    for (const button of modes) button.setAttribute('aria-pressed', String(button.dataset.mode === shown.mode));
    first.forEach((chip, i) => chip.setAttribute('aria-pressed', String(i === shown.first)));
    second.forEach((chip, i) => chip.setAttribute('aria-pressed', String(i === shown.second)));
    at('first-faces').setAttribute('aria-label', two ? 'Face on the left' : 'Face');
    for (const id of ['first-side', 'second-row', 'swap', 'second-label']) at(id).hidden = !two;
    at('first-label').hidden = false;
    at('canvas-host').dataset.mode = shown.mode;
    fillLabel(at('first-label'), replay.faces[shown.first], shown.first);
    fillLabel(at('second-label'), replay.faces[shown.second], shown.second);
  };
  shown.onChange(show);
  show();
}
