// SPDX-License-Identifier: GPL-3.0-or-later
// How far, how fast and how much alike each pair of points moves (summary.symmetry.excursions), in
// the words of docs/symmetry.md.
import type { Replay } from '../data';
import { button, element } from '../../page/dom';
import type { Undoing } from '../../page/listeners';
import { columnNotes, figureCard, figureCell, headCell, isNumber, type Column } from './figure_table';
import { faceWords, landmarkName, upper } from '../../page/format';
import type { Shown } from '../shown';
import { variantsOf } from '../variants';

interface Sides {
  L: number | null;
  R: number | null;
}
export interface Excursion {
  point: string;
  excursion_mm: Sides;
  path_mm: Sides;
  peak_speed_mm_s: Sides;
  speed_correlation: number | null;
  /** Null: the sides differ by more than the floor, but the recording's jitter is not known and may make that. */
  undecided: boolean | null;
  /** What |L - R| of the excursions must exceed to stand out from jitter and mesh. */
  floor_mm?: number | null;
  /** False: simulated, and not in the recording. Of one side alone nothing compares the two. */
  recorded?: { L: boolean; R: boolean };
  [ratio: string]: unknown;
}

const groups: { key: 'excursion' | 'path' | 'peak_speed'; unit: string; head: string; digits: number; says: string }[] = [
  { key: 'excursion', unit: 'mm', head: 'Excursion', digits: 2, says: 'largest distance, smoothed, from the place in the first sample.' },
  { key: 'path', unit: 'mm', head: 'Path', digits: 2, says: 'length of the whole way, from sample to sample; jitter lengthens it.' },
  { key: 'peak_speed', unit: 'mm/s', head: 'Peak speed', digits: 1, says: 'largest speed on the way.' },
];
const ratio = {
  head: 'R/L',
  says: 'right over left, the subject’s own sides; which side is affected the program does not know.',
};
const correlation: Column = {
  key: 'speed_correlation', head: 'Correlation', unit: 'of speeds', digits: 3,
  says: 'Pearson’s, of both speeds over time: 1 where they rise and fall together, however far they go.',
};
const undecided = {
  head: 'Undecided',
  says: 'the sides differ by less than jitter, the mesh and the head’s pose together make of a symmetric motion.',
};

const cannotTell = {
  head: 'Cannot tell',
  says: 'the sides differ by more than what is known of the noise, but the recording shows no jitter and none is stated: it may be exact or smoothed.',
};

const unitKey = { excursion: 'excursion_mm', path: 'path_mm', peak_speed: 'peak_speed_mm_s' } as const;

/** The excursions of face i: those of base are in summary.symmetry, a variant's in its row of the comparison. */
export function excursionsOf(replay: Replay, face: number): Excursion[] {
  const holder = face === 0
    ? replay.summary.symmetry
    : variantsOf(replay)?.table.find(({ name }) => name === replay.faces[face].name);
  const given = (holder as { excursions?: unknown } | null | undefined)?.excursions;
  return Array.isArray(given) ? (given as Excursion[]).filter((e) => typeof e?.point === 'string' && e.excursion_mm) : [];
}

const largest = ({ excursion_mm: { L, R } }: Excursion): number => Math.max(L ?? 0, R ?? 0);

/** Points that have anatomical names come first. */
const isNumbered = ({ point }: Excursion): boolean => point.startsWith('ibug68_');

function headOf(table: HTMLTableElement): void {
  const [upper, lower] = [table.createTHead().insertRow(), table.tHead!.insertRow()];
  const cell = (text: string, scope: 'col' | 'colgroup', span: [number, number], title: string) => {
    const th = element('th', text);
    [th.scope, th.title, th.colSpan, th.rowSpan] = [scope, title, ...span];
    return th;
  };
  upper.append(cell('Point', 'col', [1, 2], ''));
  upper.append(cell('Right | left', 'col', [1, 2], 'Excursion of either side, to one scale'));
  for (const group of groups) {
    upper.append(cell(`${group.head} (${group.unit})`, 'colgroup', [3, 1], group.says));
    lower.append(cell('right', 'col', [1, 1], ''), cell('left', 'col', [1, 1], ''), cell(ratio.head, 'col', [1, 1], ratio.says));
  }
  const last = headCell(correlation);
  last.rowSpan = 2;
  upper.append(last);
}

/** A bar to either side, to the table's scale. */
function balance({ L, R }: Sides): HTMLElement {
  const cell = element('td');
  const bars = element('span', '', 'balance');
  bars.setAttribute('aria-hidden', 'true');
  for (const side of [R, L]) {
    const bar = element('i');
    bar.style.setProperty('--mm', String(side ?? 0));
    bars.append(bar);
  }
  cell.append(bars);
  return cell;
}

const floorKey = { excursion: 'floor_mm', path: 'path_floor_mm', peak_speed: 'peak_speed_floor_mm_s' } as const;
const floorOf = (pair: Excursion, key: keyof typeof floorKey): number => Number(pair[floorKey[key]] ?? NaN);

/** Where it is not decided in grey, with the word and the floor instead of a figure that would be read as a finding.
 *  `verdict`: true, undecided; null, cannot tell. */
function judgedCell(cell: HTMLTableCellElement, verdict: unknown, floor: number, unit: string): HTMLTableCellElement {
  if (verdict !== true && verdict !== null) return cell;
  const known = Number.isFinite(floor) && floor > 0;
  const text = verdict === null ? 'cannot tell' : known ? `undecided (below ${floor.toFixed(1)} ${unit})` : 'undecided';
  const words = element('span', text, 'undecided');
  words.title = `${cell.textContent}: ${(verdict === null ? cannotTell : undecided).says}`;
  cell.replaceChildren(words);
  return cell;
}

function addRow(body: HTMLTableSectionElement, pair: Excursion): void {
  const oneSided = pair.recorded !== undefined && pair.recorded.L !== pair.recorded.R;
  const verdictOf = (key: string): unknown => (oneSided ? undefined : pair[key]);
  const row = body.insertRow();
  const name = element('th', upper(landmarkName(pair.point)));
  name.scope = 'row';
  row.append(name, balance(pair.excursion_mm));
  for (const { key, unit, head, digits, says } of groups) {
    const column = { key, head, unit, digits, says };
    const sides = pair[unitKey[key]];
    row.append(figureCell(sides.R, column), figureCell(sides.L, column));
    const over = figureCell(pair[`${key}_ratio_R_L`], { ...column, unit: '', digits: 3 });
    row.append(judgedCell(over, verdictOf(key === 'excursion' ? 'undecided' : `${key}_undecided`), floorOf(pair, key), unit));
  }
  const together = figureCell(pair.speed_correlation, correlation);
  row.append(judgedCell(together, verdictOf('speed_correlation_undecided'), NaN, ''));
}

const csvRows = (pairs: Excursion[]): (string | number | null)[][] => [
  ['point', ...groups.flatMap(({ head, unit }) => [`${head} right (${unit})`, `${head} left (${unit})`, `${head} R/L`]),
    'correlation of speeds', 'undecided'],
  ...pairs.map((pair) => [
    pair.point,
    ...groups.flatMap(({ key }) => {
      const over = pair[`${key}_ratio_R_L`];
      return [pair[unitKey[key]].R, pair[unitKey[key]].L, isNumber(over) ? over : null];
    }),
    pair.speed_correlation, pair.undecided === null ? 'cannot tell' : pair.undecided ? 'yes' : 'no',
  ]),
];

/** Null where the run measured none. Named points first, numbered ones on demand; of the face that is
 * shown, of two the second, which the first is compared with. */
export function excursionTable(replay: Replay, shown: Shown, undoing: Undoing): HTMLElement | null {
  if (excursionsOf(replay, 0).length === 0) return null;
  const table = element('table');
  headOf(table);
  const body = table.createTBody();
  const hidden = table.createTBody();
  hidden.hidden = true;
  let pairs: Excursion[] = [];
  let first: Excursion[] = [];
  const whose = element('p', '', 'whose');
  const fold = button('', 'quiet more', () => {
    hidden.hidden = !hidden.hidden;
    label();
  });
  const leftOut = element('p', '', 'left-out');
  const label = () => {
    fold.hidden = first.length === pairs.length;
    fold.textContent = hidden.hidden ? `Show ${pairs.length - first.length} more points` : 'Show fewer points';
    const others = pairs.length - first.length;
    leftOut.textContent = others === 0 || !hidden.hidden ? ''
      : others === 1 ? '1 more point stands on the page itself; if it is shown there, it is printed, too.'
      : `${others} more points stand on the page itself; if they are shown there, they are printed, too.`;
    fold.setAttribute('aria-expanded', String(!hidden.hidden));
    const scale = Math.max(...(hidden.hidden ? first : pairs).map(largest), 1e-9);
    table.style.setProperty('--most', String(scale));
  };
  const fill = () => {
    const face = shown.visible[shown.visible.length - 1];
    pairs = excursionsOf(replay, face).sort((a, b) => largest(b) - largest(a));
    const named = pairs.filter((pair) => !isNumbered(pair));
    first = named.length > 0 ? named : pairs;
    body.replaceChildren();
    hidden.replaceChildren();
    for (const pair of pairs) addRow(first.includes(pair) ? body : hidden, pair);
    whose.textContent = replay.faces.length > 1 ? `These are the figures of ${faceWords(replay.faces, face)}.` : '';
    label();
  };
  fill();
  undoing.add(shown.onChange(fill));
  const { card, body: folding } = figureCard('Excursion of either side', [
    'Each point against that of the other side, those that move farthest first. The figures describe a motion and diagnose nothing.',
  ], table, () => csvRows(pairs));
  card.classList.add('excursions');
  card.querySelector('.scroller')!.before(whose);
  const any = (verdict: true | null) => replay.faces.some((_, i) => excursionsOf(replay, i).some((pair) => Object.entries(pair)
    .some(([key, value]) => key.endsWith('undecided') && value === verdict)));
  folding.append(fold, leftOut, columnNotes([...groups, ratio, correlation, ...(any(true) ? [undecided] : []), ...(any(null) ? [cannotTell] : [])]));
  return card;
}
