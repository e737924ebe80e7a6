// SPDX-License-Identifier: GPL-3.0-or-later
// The first figures of the page: both corners of the mouth in words and over time, and a line for each variant.
import type { Chart } from '../../charts/chart_options';
import {
  apartAgainstFloor, asideMm, bandClauseWords, bandWords, bothRecorded, changeSentence, cornerChange, cornersOf, differenceWords, directionMeaning, directionWords, farthestMm, mm, sameMm,
  type CornerChange, type Corners,
} from '../corners';
import type { Replay } from '../data';
import { button, element, unbroken } from '../../page/dom';
import type { Undo } from '../../page/listeners';
import { faceColour, leftHue, rightHue } from '../../page/face_colour';
import { faceWords } from '../../page/format';
import { letterOf, sides, type Side } from '../../page/side_words';
import { chooseFace } from '../face/face_chooser';
import { farthestSentences } from '../farthest';
import { headUncertainty, headWords } from '../head_pose';
import type { Shown } from '../shown';
import { isNumber } from '../tables/figure_table';
import { changesOf, variantsOf, type VariantRow } from '../variants';

/** Of a difference with the interval of the error budget. */
function budgetFloorWords({ undecided, cannotTell, lowerBound }: Corners, limit: string): string {
  const all = `what all errors of the error budget together make (95 %), ${lowerBound ? `at least ${limit}` : limit}`;
  if (undecided) return `Undecided: the difference of the sides cannot be told from ${all}.`;
  return `The sides differ by more than ${all}.${cannotTell ? ' The jitter of the recording is not known and is missing in it.' : ''}`;
}

/** Where the floor comes from, in words. */
function floorWords(replay: Replay, corners: Corners): string {
  if (!bothRecorded(corners)) return 'The recording shows one corner alone: what the run makes of the other is no measurement, and no figure of it is given.';
  const { floorMm, undecided, cannotTell } = corners;
  const jitter = replay.symmetry?.jitter_mm ?? 0;
  const noJitter = 'The jitter of the recording is not known: none is stated, and none shows. It may make a difference of the sides.';
  if (!(floorMm > 0)) return [meshFloorWhy(replay), cannotTell ? noJitter : ''].filter(Boolean).join(' ') || 'No floor is known: the recording is exact.';
  const { limit } = apartAgainstFloor(corners);
  if (corners.budgeted) return budgetFloorWords(corners, limit);
  const made = jitter > 0 ? 'what jitter and the mesh make' : 'what the mesh makes';
  const why = jitter > 0 ? `Jitter of the recorded points: ${jitter.toFixed(2)} mm; the notes say where it comes from.` : cannotTell ? noJitter : 'No jitter of the recording was weighed: none is stated, and none shows.';
  const verdict = undecided ? `Undecided: a difference of the sides below ${limit} cannot be told from ${made}.`
    : `The sides differ by more than ${made}, ${limit}. Repeated smiles of one person differ, too: by how much this floor does not say.`;
  return [verdict, why].join(' ');
}

/** The cut-off of the filter that figures are of and the curve is not; 0: both are of the same path. */
export const filterHz = (replay: Replay): number =>
  (replay.symmetry?.jitter_mm ?? 0) > 0 ? (replay.summary.symmetry as { lowpass_hz?: number } | undefined)?.lowpass_hz ?? 0 : 0;

/** Figures are of filtered paths, the curve is not. */
function filterWords(replay: Replay): string {
  const hz = filterHz(replay);
  return hz > 0 ? `The figures above are of paths without what is faster than ${hz} Hz; the curve is unfiltered. Its highest point may lie above them, by jitter, or below, as the filter goes a little past the end of a motion.` : '';
}

function meshFloorWhy(replay: Replay): string {
  const floor = (replay.summary.symmetry as { mesh_floor?: { known?: boolean; why?: string } } | undefined)?.mesh_floor;
  return (floor?.known === false && floor.why) || '';
}

function sideWords(side: Side, valueMm: number): HTMLElement {
  const words = element('span', '', side);
  words.append(element('i'), `${side} `, element('b', mm(valueMm)));
  return words;
}

/** The change of the corner that a variant changes more. */
function mostChanged(replay: Replay, face: number): CornerChange | null {
  const changes = sides.flatMap((side) => cornerChange(replay, face, side) ?? []);
  const size = (change: CornerChange) => Math.max(Math.abs(change.byMm), Math.abs(asideMm(change)));
  return changes.sort((a, b) => size(b) - size(a))[0] ?? null;
}

interface Verdict {
  text: string;
  undecided: boolean;
}

const cannotTellWords = 'cannot tell, as the jitter of the recording is not known';

/** " (± 0.7 mm, undecided)"; empty where nothing is known. */
function bandClause(change: CornerChange): string {
  const parts = [change.bandMm === null ? '' : bandClauseWords(change), change.undecided ? 'undecided' : '', change.cannotTell ? cannotTellWords : ''].filter(Boolean);
  return parts.length > 0 ? ` (${parts.join(', ')})` : '';
}

/** The change by a variant, and its side. If a weak side is dragged farther, the other side must not appear to be the
 *  weak one. Null for base. */
function changeVerdict(replay: Replay, face: number): Verdict | null {
  const change = face > 0 ? mostChanged(replay, face) : null;
  if (!change) return null;
  const second = directionWords(change), aside = second && `; ${second}`;
  const text = `${change.side} ${changeSentence(change)}`;
  if (change.byMm === 0) return { text: aside ? `${text}${aside}` : 'both corners go as in base', undecided: false };
  if (change.undecided) return { text: `${text}: undecided${change.bandMm === null ? '' : ` (below ${bandWords(change)})`}${aside}`, undecided: true };
  const band = change.bandMm === null ? '' : ` (${bandClauseWords(change)})`;
  if (change.cannotTell) return { text: `${text}${band}: ${cannotTellWords}${aside}`, undecided: true };
  return { text: `${text}${band}${aside}`, undecided: false };
}

function strong({ text, undecided }: Verdict): HTMLElement {
  const made = element('strong');
  made.append(...unbroken(text));
  made.classList.toggle('undecided', undecided);
  return made;
}

/** The question that the figures answer: what the face shown changes. */
function questionLine(replay: Replay, face: number): HTMLElement {
  const line = element('p', '', 'asked');
  line.hidden = replay.faces.length < 2;
  line.style.setProperty('--face', faceColour(face));
  const changes = face > 0 ? changesOf(replay, face).join(', ') : '';
  const words = element('span');
  if (changes) words.append('What if: ', element('b', changes), '?');
  else words.append(element('b', faceWords(replay.faces, face)), face === 0 ? ', nothing changed' : '');
  line.append(element('i'), words);
  return line;
}

/** Both corners and, for base, their difference. A variant answers two questions, with a name for each:
 *  what it changes, and whether its sides differ. */
function headlines(replay: Replay, face: number, corners: Corners): HTMLElement[] {
  const line = element('p', '', 'headline');
  line.id = 'headline';
  const [right, left] = sides.map((side) => sideWords(side, farthestMm(corners, side)));
  line.append(right, ', ', left);
  const apart: Verdict = { text: differenceWords(corners), undecided: corners.undecided || corners.cannotTell };
  const change = changeVerdict(replay, face);
  if (!change) {
    line.append(': ', strong(apart));
    return [line];
  }
  const answers = element('dl', '', 'answers');
  for (const [question, verdict] of [['Change against base', change], ['Difference of the sides', apart]] as const) {
    const answer = element('dd');
    answer.append(strong(verdict));
    answers.append(element('dt', question), answer);
  }
  return [line, answers];
}

/** A sentence on what the figures above are. */
function whatWords(replay: Replay, face: number): string {
  const change = face > 0 ? mostChanged(replay, face) : null;
  const direction = change && !change.sameWay ? ` ${directionMeaning}` : '';
  return `These are the largest distances of both corners from rest${replay.faces.length > 1 ? ` in ${faceWords(replay.faces, face)}` : ''}.${direction}`;
}

/** Where the jaw alone would carry the corner; empty where it does not move, or is not known. */
function jawSentence(row: VariantRow | undefined, side: Side): string {
  const withJaw = row?.[`commissure_${letterOf[side]}_with_jaw_mm`];
  if (!isNumber(withJaw) || withJaw < sameMm) return '';
  return ` Fixed to the lower jaw it would go ${mm(withJaw)}. Skin follows the jaw in part.`;
}

/** Why a corner still moves on a side of which no muscle of this face pulls; empty where some do. */
function unpulledWords(row: VariantRow | undefined): string {
  const unpulled: unknown = row?.unpulled_sides;
  if (!Array.isArray(unpulled)) return '';
  return sides.filter((side) => unpulled.includes(letterOf[side])).map((side) => {
    return `No muscle pulls on the ${side}: its corner moves by no strength of its own, but by the jaw and the other side.${jawSentence(row, side)}`;
  }).join(' ');
}

/** "along the way right corner up to 3.7 mm from where it is in the unchanged face, at 1.93 s" of the side with the
 *  larger distance, which greatest excursions may hide. */
function onTheWay(row: VariantRow | undefined, changeMm: number): string {
  const [{ side, mm: far, s }] = sides.map((one) => ({
    side: one, mm: row?.[`commissure_${letterOf[one]}_from_base_mm`], s: row?.[`commissure_${letterOf[one]}_from_base_s`],
  })).sort((a, b) => (Number(b.mm) || 0) - (Number(a.mm) || 0));
  if (!isNumber(far) || !isNumber(s) || far < 0.3 || far < 1.5 * Math.abs(changeMm)) return '';
  return `along the way ${side} corner up to ${mm(far)} from where it is in the unchanged face, at ${s.toFixed(2)} s`;
}

/** "right corner 8.9 mm, is dragged 2.2 mm farther than in base (± 0.7 mm)" of the side that changes more; empty where
 *  neither does. */
function againstBase(replay: Replay, face: number, row: VariantRow | undefined): string {
  const change = mostChanged(replay, face);
  if (!change) return '';
  // One second figure at most: where the corner turns aside, or how far it is from base on the way.
  const second = directionWords(change) || onTheWay(row, change.byMm);
  if (Math.abs(change.byMm) < sameMm && change.sameWay) return second && `greatest excursions as in base; ${second}`;
  const band = change.byMm === 0 ? '' : bandClause(change);
  return `${change.side} corner ${mm(change.toMm)}, ${changeSentence(change)}${band}${second && `; ${second}`}`;
}

/** Where to see the effect of tissue if the corners are driven points. */
function elsewhere(replay: Replay, face: number, row: VariantRow): string {
  const [where] = farthestSentences(replay, face, row);
  return where ? `corners as base. ${where}` : 'moves as base';
}

function variantLines(replay: Replay, shown: Shown, base: Corners): HTMLElement | null {
  const variants = variantsOf(replay);
  if (!variants) return null;
  const rowOf = (name: string) => variants.table.find((r) => r.name === name);
  const words = replay.faces.map(({ name }, i) => (i > 0 ? againstBase(replay, i, rowOf(name)) : ''));
  const list = element('ul', '', 'variant-lines');
  replay.faces.forEach(({ name }, i) => {
    if (i === 0) return;
    const row = rowOf(name);
    const item = element('li');
    const face = button('', 'face-name', () => chooseFace(shown, i));
    const dot = element('i');
    dot.style.background = faceColour(i);
    face.append(dot, name);
    item.append(face, ': ', ...unbroken(words[i] || (row ? elsewhere(replay, i, row) : 'corners as base')));
    const still = unpulledWords(row);
    if (still) {
      const why = element('small');
      why.append(...unbroken(still));
      item.append(' ', why);
    }
    list.append(item);
  });
  const box = element('div');
  box.append(list);
  if (base.driven && words.every((text) => text === ''))
    box.prepend(element('p', 'Both corners are driven points: they go where the recording says, whatever the tissue.'));
  return box;
}

/** Curves of the faces shown; the second one is dashed. Empty where the run has no points at the corners. */
export function cornerCurves(replay: Replay, shown: Shown): Omit<Chart, 'title'>[] {
  const faces = [...new Set(shown.visible)];
  const base = cornersOf(replay, faces[0]);
  if (!base) return [];
  const several = replay.faces.length > 1;
  const unfiltered = filterHz(replay) > 0 ? ', unfiltered' : '';
  return [{
    caption: filterWords(replay), unit: ' mm', digits: 1, timeS: base.timeS, yLabel: 'from rest (mm)', heightPx: 165,
    curves: faces.flatMap((face, k) => {
      const own = cornersOf(replay, face)!;
      const whose = faces.length > 1 ? `${faceWords(replay.faces, face)}: ` : '';
      const file = several ? `${replay.faces[face].name}: ` : '';
      return [
        { label: `${whose}right corner${unfiltered}`, column: `${file}right corner${unfiltered} (mm)`, values: own.right, hue: rightHue(), broken: k > 0 },
        { label: `${whose}left corner${unfiltered}`, column: `${file}left corner${unfiltered} (mm)`, values: own.left, hue: leftHue(), broken: k > 0 },
      ];
    }),
  }];
}

/** Text above the chart, and below it the effects of the variants. Follows the face shown until the returned function
 *  is called. */
export function dressCornerCard(replay: Replay, shown: Shown, card: HTMLElement): Undo {
  card.classList.add('corners');
  const line = element('div', '', 'said');
  const floor = element('p', '', 'floor');
  const why = element('details', '', 'why-floor');
  why.append(element('summary', 'What these figures are'), floor);
  const pose = headUncertainty(replay);
  const head = element('p', '', 'head-pose');
  head.append(...unbroken(pose ? headWords(pose) : ''));
  head.hidden = !pose;
  const show = () => {
    const face = shown.visible[shown.visible.length - 1];
    const corners = cornersOf(replay, face)!;
    line.replaceChildren(questionLine(replay, face), ...headlines(replay, face, corners));
    floor.replaceChildren(...unbroken(`${whatWords(replay, face)} ${floorWords(replay, corners)}`));
  };
  show();
  const unfollow = shown.onChange(show);
  card.querySelector('.plot-head')!.after(line, head, why);
  const lines = variantLines(replay, shown, cornersOf(replay, 0)!);
  if (lines) card.append(lines);
  return unfollow;
}
