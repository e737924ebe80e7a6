// SPDX-License-Identifier: GPL-3.0-or-later
// The activations of the muscles of both sides over time, in base and in variants. Muscles that points on the skin
// cannot distinguish are summed in groups.
import type { Chart } from '../../charts/chart_options';
import type { Face, MuscleGroup, Muscles } from '../data';
import { element } from '../../page/dom';
import { leftHue, rightHue } from '../../page/face_colour';
import { faceWords, signed, upper } from '../../page/format';
import type { Shown } from '../shown';

/** Where it acts most, with its sign. */
const strongest = (values: number[]): number => values.reduce((most, v) => (Math.abs(v) > Math.abs(most) ? v : most), 0);
const pull = ({ left, right }: MuscleGroup): number => Math.max(...left, ...right);

/** A sentence from the notes of both sides, as "On both sides it is mostly the prior's choice. "; empty without notes. */
const noteOf = (right: string, left: string): string =>
  right && right === left ? `On both sides it is ${right}. `
    : (right && `On the right it is ${right}. `) + (left && `On the left it is ${left}. `);

/** The groups, sorted by activation in base; those that only relax are last. One of them is chosen. Curves are of the
 *  faces shown; those of the second face are dashed. */
export class MuscleCurves {
  readonly groups: MuscleGroup[];
  chosen = 0;
  private readonly order: number[];

  constructor(private readonly muscles: Muscles, private readonly faces: Face[], private readonly shown: Shown) {
    this.order = muscles.groups.map((_, i) => i).sort((a, b) => pull(muscles.groups[b]) - pull(muscles.groups[a]));
    this.groups = this.order.map((i) => muscles.groups[i]);
  }

  get now(): Omit<Chart, 'title'> {
    const { name, sigmaLeft, sigmaRight, noteLeft, noteRight } = this.groups[this.chosen];
    const known = [...new Set(this.shown.visible)].filter((face) => this.faces[face].muscles.length > 0);
    const visible = known.length > 0 ? known : [0];
    const several = this.faces.length > 1;
    const caption =
      'Sum over muscles that points on the skin can hardly tell apart; a muscle at 1 moves the skin by 10 mm where most, below 0 it relaxes. ' +
      (several ? `Of ${visible.map((face) => faceWords(this.faces, face)).join('; dashed: ')}: variants answer what was found in base, times what they change. ` : '') +
      `Where it acts most in base, right ± ${sigmaRight.toFixed(2)}, left ± ${sigmaLeft.toFixed(2)} (one sigma, of the points and the prior alone). ${noteOf(noteRight, noteLeft)}` +
      (this.muscles.fewPoints ? 'With so few points this is a means of moving the face, not a measurement of muscles.' : '');
    return {
      caption: caption.trim(), unit: '', digits: 2, timeS: this.muscles.timeS, yLabel: 'activation', heightPx: 200,
      curves: visible.flatMap((face, k) => {
        const { left, right } = this.faces[face].muscles[this.order[this.chosen]];
        const whose = visible.length > 1 ? `${faceWords(this.faces, face)}: ` : '';
        const file = `${several ? `${this.faces[face].name}: ` : ''}${name}`;
        return [
          { label: `${whose}right`, column: `${file}, right (1)`, values: right, hue: rightHue(), broken: k > 0 },
          { label: `${whose}left`, column: `${file}, left (1)`, values: left, hue: leftHue(), broken: k > 0 },
        ];
      }),
    };
  }
}

/** Names every group with its greatest activation on each side; `changed` is called after each choice. */
export function muscleChooser(curves: MuscleCurves, changed: () => void): HTMLElement {
  const label = element('label', '', 'one-of-chooser');
  const select = document.createElement('select');
  curves.groups.forEach(({ name, left, right }, i) => {
    const option = element('option', `${upper(name)} (right ${signed(strongest(right).toFixed(2))}, left ${signed(strongest(left).toFixed(2))})`);
    option.setAttribute('value', String(i));
    select.append(option);
  });
  select.addEventListener('change', () => {
    curves.chosen = Number(select.value);
    changed();
  });
  label.append(element('span', 'Group'), select);
  return label;
}
