// SPDX-License-Identifier: GPL-3.0-or-later
// How far one corner of the mouth is from rest, in base and in each of its variants, so that their losses can be
// compared.
import type { Chart } from '../../charts/chart_options';
import { cornersOf, farthestMm, type Corners } from '../corners';
import type { Replay } from '../data';
import { element } from '../../page/dom';
import { faceHue } from '../../page/face_colour';
import { faceWords } from '../../page/format';
import { sides, type Side } from '../../page/side_words';
import type { Shown } from '../shown';


/** Begins with the side that variants change more. */
export class ExcursionCurves {
  side: Side;

  private constructor(private readonly replay: Replay, private readonly shown: Shown, private readonly faces: Corners[]) {
    const change = (side: Side) => Math.max(...faces.map((own) => Math.abs(farthestMm(own, side) - farthestMm(faces[0], side))));
    this.side = change('left') > change('right') ? 'left' : 'right';
  }

  /** Null without variants, and where the run has no points at the corners. */
  static of(replay: Replay, shown: Shown): ExcursionCurves | null {
    if (replay.faces.length < 2) return null;
    const faces = replay.faces.flatMap((_, i) => cornersOf(replay, i) ?? []);
    return faces.length === replay.faces.length ? new ExcursionCurves(replay, shown, faces) : null;
  }

  get now(): Omit<Chart, 'title'> {
    return {
      caption: `Distance of the ${this.side} corner from where it was in the first frame.`,
      unit: ' mm', digits: 1, timeS: this.faces[0].timeS, yLabel: 'from rest (mm)', heightPx: 210,
      curves: this.faces.map((own, i) => ({
        label: faceWords(this.replay.faces, i), column: `${this.side} corner of ${this.replay.faces[i].name} (mm)`,
        values: own[this.side], hue: faceHue(i), strong: this.shown.visible.includes(i),
      })),
    };
  }
}

/** `changed` is called after each choice. */
export function sideChooser(curves: ExcursionCurves, changed: () => void): HTMLElement {
  const label = element('label', '', 'one-of-chooser');
  const select = document.createElement('select');
  for (const side of sides) {
    const option = element('option', side);
    option.setAttribute('value', side);
    select.append(option);
  }
  select.value = curves.side;
  select.addEventListener('change', () => {
    curves.side = select.value as Side;
    changed();
  });
  label.append(element('span', 'Corner'), select);
  return label;
}
