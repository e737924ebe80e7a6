// SPDX-License-Identifier: GPL-3.0-or-later
// What was recorded at each visit, and how the table is read.
import { element } from '../page/dom';
import type { Manifest, Measure, Visit } from './manifest';

const mm = (value: number | null): string => (value === null ? 'not known' : `${value.toFixed(1)} mm`);

function recordedWords({ recordings, peak_s, jitter_mm, head_fit_mm, eye_distance_mm }: Visit): string {
  return (
    `${recordings.join(', ')}; peak at ${peak_s.toFixed(2)} s; ${eye_distance_mm === null ? 'outer eye corners not recorded' : `outer eye corners ${mm(eye_distance_mm)} apart`}; ` +
    `${head_fit_mm === null ? '' : `head fitted within ${mm(head_fit_mm)}; `}tracking jitter ${mm(jitter_mm)}.`
  );
}

/** A table of more visits has no column for measurement alone, nor has paper. */
const changeWords = (count: number): (string | HTMLElement)[] => [
  'Change: the later visit less the first. ',
  ...(count <= 3 ? [element('span', 'By measurement alone: its interval without repetition. ', 'measured')] : []),
  'Yes: measurement and repetition together do not make such a change. No: they can. Cannot tell: it is beyond repetition and the known errors of measurement, but another of its errors is not known. Without that there is no interval. ' +
    'What an interval mostly comes from is the largest of its parts. ',
];

const isDoubted = (measures: Measure[]): boolean => measures.some(({ changes }) => changes.some((change) => change?.doubtful));

export function explain(host: HTMLElement, { visits, repetition, peak_by, measures, choices }: Manifest): void {
  const how = element('p');
  how.append(
    `Each visit’s column has the value at the peak (by the ${peak_by}) and in brackets its 95 % interval by measurement alone. `,
    ...(visits.length > 1 ? changeWords(visits.length) : []),
    ...(isDoubted(measures) ? ['Doubtful: something said above or in the notes doubts the figures of one of both visits. '] : []),
    `Of ${measures.length} measures that did not change, one in 20 is outside its interval by chance. Curves begin to count where half of the way to the peak is reached. R and L are the person’s own sides.`,
  );
  const list = element('ul');
  for (const visit of visits) {
    const item = element('li');
    item.append(element('b', visit.label), ` ${recordedWords(visit)}`);
    list.append(item);
  }
  host.append(element('p', repetition.text), how, ...choices.map((choice) => element('p', choice, 'choice')), element('h2', 'What was recorded'), list);
}
