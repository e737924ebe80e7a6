// SPDX-License-Identifier: GPL-3.0-or-later
// How far one corner of the mouth is from rest, in base and in each of its variants, so that their losses can be
// compared.
import type { Chart } from '../../charts/chart_options';
import { cornersOf, type Corners } from '../corners';
import type { Replay } from '../data';
import { element } from '../../page/dom';
import { faceHue } from '../../page/face_colour';
import { faceWords } from '../../page/format';
import { sides, type Side } from '../../page/side_words';
import type { Shown } from '../shown';

/** How far apart two curves are at most, mm. */
const apartMm = (a: (number | null)[], b: (number | null)[]): number =>
  Math.max(0, ...a.map((v, f) => (v === null || b[f] == null ? 0 : Math.abs(v - b[f]))));

/** Until the reader chooses a side: the side whose curve the variants shown (for base, all variants) change most. */
export class ExcursionCurves {
  private chosen: Side | null = null;

  private constructor(private readonly replay: Replay, private readonly shown: Shown, private readonly faces: Corners[]) {}

  get side(): Side {
    if (this.chosen) return this.chosen;
    const variants = this.shown.visible.filter((i) => i > 0);
    const of = variants.length > 0 ? variants.map((i) => this.faces[i]) : this.faces;
    const change = (side: Side) => Math.max(...of.map((own) => apartMm(own[side], this.faces[0][side])));
    return change('left') > change('right') ? 'left' : 'right';
  }

  choose(side: Side): void {
    this.chosen = side;
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
        label: faceWords(this.replay.faces, i), column: `${this.replay.faces[i].name}: ${this.side} corner (mm)`,
        values: own[this.side], hue: faceHue(i), strong: this.shown.visible.includes(i),
      })),
    };
  }
}

/** `changed` is called after each choice. The second function shows the side of the curves. */
export function sideChooser(curves: ExcursionCurves, changed: () => void): { box: HTMLElement; show: () => void } {
  const label = element('label', '', 'one-of-chooser');
  const select = document.createElement('select');
  for (const side of sides) {
    const option = element('option', side);
    option.setAttribute('value', side);
    select.append(option);
  }
  const show = () => void (select.value = curves.side);
  show();
  select.addEventListener('change', () => {
    curves.choose(select.value as Side);
    changed();
  });
  label.append(element('span', 'Corner'), select);
  return { box: label, show };
}
