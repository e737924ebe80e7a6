// SPDX-License-Identifier: GPL-3.0-or-later
// The action units, one chart each with left and right together: those that move, strongest first, and the rest on
// demand.
import type { Chart } from '../charts/chart_options';
import { button, element, memberBox } from '../page/dom';
import { upper, words } from '../page/format';
import type { Channel, Tracking } from './data';
import { facsName } from './facs';

export interface UnitPair {
  /** "mouth smile" */
  name: string;
  facs: string;
  /** One, or the left and the right one. */
  channels: Channel[];
  /** Range of its weight on the side where it is larger; single frames do not count. */
  travel: number;
}

/** Weights that stay within this are taken to be at rest. */
const moves = 0.1;
const shownAtFirst = 8;

/** Between the 2nd and the 98th percentile. */
function travelOf(channel: Channel): number {
  const sorted = channel.values.filter((v) => v !== null).sort((a, b) => a - b);
  if (sorted.length === 0) return 0;
  const at = (share: number) => sorted[Math.round(share * (sorted.length - 1))];
  return at(0.98) - at(0.02);
}

const side = (name: string): string | null => /_([LR])$/.exec(name)?.[1] ?? null;

/** "mouthSmile_L" is "mouth smile", "Lip corner depressor" stays. */
const plainName = (name: string): string =>
  words(name.replace(/_[LR]$/, '').replace(/([a-z])([A-Z])/g, (_m, a: string, b: string) => `${a} ${b.toLowerCase()}`));

/** Strongest first. */
export function unitPairs({ channels }: Tracking): UnitPair[] {
  const pairs = new Map<string, UnitPair>();
  for (const channel of channels.filter((c) => c.group === 'unit')) {
    const name = plainName(channel.name);
    const pair = pairs.get(name) ?? { name, facs: channel.facs, channels: [], travel: 0 };
    pair.channels.push(channel);
    pair.travel = Math.max(pair.travel, travelOf(channel));
    pairs.set(name, pair);
  }
  return [...pairs.values()].sort((a, b) => b.travel - a.travel);
}

export function firstPairs(pairs: UnitPair[]): Set<UnitPair> {
  const moving = pairs.filter((pair) => pair.travel >= moves);
  return new Set((moving.length > 0 ? moving : pairs.slice(0, 3)).slice(0, shownAtFirst));
}

export const firstCaption = (pairs: UnitPair[]): string =>
  pairs[0].travel >= moves ? 'Those that move, strongest first' : `None moves by ${moves} or more; the strongest`;

export const pairTitle = ({ name, facs }: UnitPair): string =>
  [upper(name), facs && `${facs.replaceAll('+', ' + ')} ${facsName(facs)}`]
    .filter(Boolean).join(' · ');

/** All on one scale, so that charts compare. */
export function commonRange(pairs: UnitPair[]): [number, number] {
  const all = pairs.flatMap((pair) => pair.channels);
  const least = Math.min(0, ...all.map((c) => c.least));
  const most = Math.max(0.5, ...all.map((c) => c.most));
  const margin = 0.04 * (most - least);
  return [least - margin, most + margin];
}

export function unitChart(pair: UnitPair, timeS: number[], range: [number, number]): Chart {
  const hues = { L: 0, R: 1 };
  return {
    title: pairTitle(pair), caption: '', unit: '', digits: 3, timeS, range, heightPx: 156,
    yLabel: 'weight (1 = full)',
    curves: pair.channels.map((channel) => {
      const which = side(channel.name) as 'L' | 'R' | null;
      const label = which === 'L' ? 'left' : which === 'R' ? 'right' : 'weight';
      return { label, values: channel.values, hue: which ? hues[which] : 2, broken: which === 'R' };
    }),
  };
}

/** Search field and check boxes; `changed` is called after each change of `chosen`. */
export function unitChooser(pairs: UnitPair[], chosen: Set<UnitPair>, changed: () => void): HTMLElement {
  const details = element('details', '', 'chooser');
  const summary = element('summary');
  const units = pairs.reduce((sum, pair) => sum + pair.channels.length, 0);
  const update = () => {
    const shown = pairs.filter((p) => chosen.has(p)).reduce((sum, pair) => sum + pair.channels.length, 0);
    summary.textContent = `Choose units (${shown} of ${units} shown)`;
  };
  const search = document.createElement('input');
  search.type = 'search';
  search.placeholder = 'Name or AU';
  search.setAttribute('aria-label', 'Search units');
  const list = document.createElement('div');
  const boxes: HTMLInputElement[] = [];
  const labels = pairs.map((pair) => {
    const label = document.createElement('label');
    const box = memberBox(chosen, pair, () => {
      update();
      changed();
    });
    boxes.push(box);
    const travel = element('small', pair.travel.toFixed(2));
    travel.title = 'How far its weight goes';
    label.append(box, pairTitle(pair), travel);
    list.append(label);
    return label;
  });
  search.addEventListener('input', () => {
    const wanted = search.value.trim().toLowerCase();
    labels.forEach((label, i) => (label.hidden = !pairTitle(pairs[i]).toLowerCase().includes(wanted)));
  });
  const all = (label: string, wanted: (pair: UnitPair) => boolean) =>
    button(label, 'quiet', () => {
      pairs.forEach((pair, i) => {
        boxes[i].checked = wanted(pair);
        if (boxes[i].checked) chosen.add(pair);
        else chosen.delete(pair);
      });
      update();
      changed();
    });
  const first = new Set(chosen);
  const tools = document.createElement('p');
  tools.append(search, all('Those that move', (p) => first.has(p)), all('All', () => true), all('None', () => false));
  update();
  details.append(summary, tools, list);
  return details;
}
