// SPDX-License-Identifier: GPL-3.0-or-later
// What the muscles of either side do over time, by groups that points on the skin can tell apart.
import type { Chart } from '../../charts/chart_options';
import type { MuscleGroup, Muscles } from '../data';
import { element } from '../../page/dom';
import { leftHue, rightHue } from '../../page/face_colour';
import { signed, upper } from '../../page/format';

/** Where it acts most, with its sign. */
const strongest = (values: number[]): number => values.reduce((most, v) => (Math.abs(v) > Math.abs(most) ? v : most), 0);
const pull = ({ left, right }: MuscleGroup): number => Math.max(...left, ...right);

/** The groups, those that pull most first and those that only relax last; one of them is chosen. */
export class MuscleCurves {
  readonly groups: MuscleGroup[];
  chosen = 0;

  constructor(private readonly muscles: Muscles, private readonly several: boolean) {
    this.groups = [...muscles.groups].sort((a, b) => pull(b) - pull(a));
  }

  get now(): Omit<Chart, 'title'> {
    const { name, left, right, sigmaLeft, sigmaRight } = this.groups[this.chosen];
    const caption =
      'Sum over muscles that points on the skin can hardly tell apart; a muscle at 1 moves the skin by 10 mm where most, below 0 it relaxes. ' +
      (this.several ? 'Of base: variants answer the same, times what they change. ' : '') +
      `Where it acts most, left ± ${sigmaLeft.toFixed(2)}, right ± ${sigmaRight.toFixed(2)} (one sigma, of the points and the prior alone). ` +
      (this.muscles.fewPoints ? 'With so few points this is a means of moving the face, not a measurement of muscles.' : '');
    return {
      caption: caption.trim(), unit: '', digits: 2, timeS: this.muscles.timeS, yLabel: 'activation', heightPx: 200,
      curves: [
        { label: 'left', column: `${name}, left (1)`, values: left, hue: leftHue() },
        { label: 'right', column: `${name}, right (1)`, values: right, hue: rightHue() },
      ],
    };
  }
}

/** Names every group with its greatest activation a side; `changed` is told after each choice. */
export function muscleChooser(curves: MuscleCurves, changed: () => void): HTMLElement {
  const label = element('label', '', 'muscle-chooser');
  const select = document.createElement('select');
  curves.groups.forEach(({ name, left, right }, i) => {
    const option = element('option', `${upper(name)} (left ${signed(strongest(left).toFixed(2))}, right ${signed(strongest(right).toFixed(2))})`);
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
