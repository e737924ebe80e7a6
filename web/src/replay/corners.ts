// SPDX-License-Identifier: GPL-3.0-or-later
// How far the corners of the mouth go: the figures that a reader looks for first, in millimetres.
import { budgetOf, type BudgetedCorner } from './budget';
import type { Replay } from './data';
import { frameAt } from './face/deform';
import { excursionsOf } from './tables/excursion_table';
import { isNumber } from './tables/figure_table';
import { letterOf, sides, type Side } from '../page/side_words';
import { tracksMm } from './curves/track_chart';
import { variantsOf, type VariantRow } from './variants';

export interface Corners {
  timeS: number[];
  /** Distance from rest, mm a sample; null where unknown, as of a corner that is not recorded. */
  left: (number | null)[];
  right: (number | null)[];
  /** The largest of each, mm; NaN: the recording does not show it. */
  leftMm: number;
  rightMm: number;
  /** Differences of the sides below this are undecided, mm; 0: no floor is known. */
  floorMm: number;
  undecided: boolean;
  /** The sides differ by more than the floor, but the recording's jitter is not known and may make that. */
  cannotTell: boolean;
  /** floorMm, undecided and cannotTell are those of the error budget. */
  budgeted: boolean;
  /** A part of the error budget is not known, and floorMm is that of the others. */
  lowerBound: boolean;
  /** Both are driven points: they follow the recording in any tissue. */
  driven: boolean;
}

const names: [left: string, right: string, pair: string][] = [
  ['cheilion_L', 'cheilion_R', 'cheilion'], ['ibug68_54', 'ibug68_48', 'ibug68_48/54'],
];
const largest = (track: (number | null)[]): number => Math.max(0, ...track.map((v) => v ?? 0));

/** A floor that would be shown as 0.000 mm, as that of points without any noise, is none. */
const shownFloorMm = (mm: number): number => (mm < 5e-4 ? 0 : mm);

/** 95 % bound of a difference of two positions per side with this jitter per coordinate, for a page that states no floor. */
export const jitterFloorMm = (jitterMm: number): number => 1.96 * 2 * jitterMm;

/** Not decided, as a part of the budget is not known. */
const isOpen = ({ decided }: BudgetedCorner): boolean => typeof decided !== 'boolean';

/** Null where the run has no points at the corners. */
export function cornersOf(replay: Replay, face: number): Corners | null {
  const { landmarks, driven } = replay;
  if (landmarks.timeS.length < 2) return null;
  for (const [leftName, rightName, pairName] of names) {
    const [l, r] = [landmarks.names.indexOf(leftName), landmarks.names.indexOf(rightName)];
    if (l < 0 || r < 0) continue;
    const tracks = tracksMm(replay, face);
    const pair = excursionsOf(replay, face).find(({ point }) => point === pairName);
    const isRecorded = (side: 'L' | 'R') => pair?.recorded?.[side] !== false;
    const trackOf = (side: 'L' | 'R', track: (number | null)[]) => (isRecorded(side) ? track : track.map(() => null));
    const [left, right] = [trackOf('L', tracks[l]), trackOf('R', tracks[r])];
    const leftMm = isRecorded('L') ? pair?.excursion_mm.L ?? largest(left) : NaN;
    const rightMm = isRecorded('R') ? pair?.excursion_mm.R ?? largest(right) : NaN;
    const budget = face === 0 && isRecorded('L') && isRecorded('R') ? budgetOf(replay, { figure: 'difference' }) : null;
    const floorMm = shownFloorMm(budget?.known_half_width_95_mm ?? pair?.floor_mm ?? jitterFloorMm(replay.faces[face].symmetry?.jitter_mm ?? 0));
    return {
      timeS: landmarks.timeS, left, right, leftMm, rightMm, floorMm,
      undecided: budget ? budget.decided === false : pair?.undecided ?? Math.abs(leftMm - rightMm) < floorMm,
      cannotTell: budget ? isOpen(budget) : pair?.undecided === null && isRecorded('L') && isRecorded('R'),
      budgeted: budget !== null,
      lowerBound: budget !== null && budget.half_width_95_mm === null,
      // The corner has either name.
      driven: names.some(([a, b]) => driven.names.includes(a) && driven.names.includes(b)),
    };
  }
  return null;
}

/** Of a corner that the recording does not show there is no figure. */
export const mm = (value: number): string => (Number.isNaN(value) ? 'not recorded' : `${roundedMm(value).toFixed(1)} mm`);

/** Decimals with which two lengths do not print alike, so that "0.1 mm, below 0.1 mm" is not written: one, where that
 *  will do. `aMm` is as it is shown with one decimal, `exactMm` is not rounded. The terminal follows the same rule
 *  (core/held_against.hpp). */
function digitsApart(aMm: number, exactMm: number, bMm: number): number {
  const less = Math.abs(exactMm) < bMm;
  const agrees = (digits: number) => {
    const [a, b] = [Math.abs(digits === 1 ? aMm : exactMm).toFixed(digits), bMm.toFixed(digits)].map(Number);
    return (less ? a < b : a > b) && (b > 0 || bMm === 0);
  };
  return [1, 2, 3].find(agrees) ?? 3;
}

/** A length and what it is held against, "0.07 mm" and "0.14 mm": with as many decimals as distinguish them. */
export function heldAgainst(shownMm: number, exactMm: number, limitMm: number): { own: string; limit: string } {
  const digits = digitsApart(shownMm, exactMm, limitMm);
  const own = digits === 1 ? shownMm : exactMm;
  return { own: `${Math.abs(own).toFixed(digits)} mm`, limit: `${limitMm.toFixed(digits)} mm` };
}

/** A difference from base below this counts as none, mm: half of the last digit shown. */
export const sameMm = 0.05;

/** Rounded as it is shown, so that the difference in words agrees with the figures shown. */
export const roundedMm = (value: number): number => Math.round(10 * value) / 10;

export const farthestMm = (corners: Corners, side: Side): number => (side === 'left' ? corners.leftMm : corners.rightMm);

const rowOf = (replay: Replay, face: number): VariantRow | undefined =>
  variantsOf(replay)?.table.find(({ name }) => name === replay.faces[face].name);

/** Whether a face's band stays unknown, as the recording's jitter is. */
export const jitterUnknown = (replay: Replay, face: number): boolean => rowOf(replay, face)?.jitter_known === false;

/** The error of a variant's change against base due to mesh and jitter, mm; null: unknown. */
export function changeBandMm(replay: Replay, face: number, side: Side): number | null {
  const band = rowOf(replay, face)?.[`commissure_${letterOf[side]}_band_mm`];
  return isNumber(band) ? band : null;
}

/** The interval of the error budget in place of a band, which leaves most errors out; nothing where the run has none. */
function judgedByBudget(replay: Replay, face: number, side: Side): Partial<CornerChange> {
  const budget = budgetOf(replay, { figure: 'change', variant: replay.faces[face].name, side: letterOf[side] });
  if (!budget) return {};
  return {
    bandMm: budget.known_half_width_95_mm, undecided: budget.decided === false, cannotTell: isOpen(budget),
    bandIs: budget.half_width_95_mm === null ? 'lower bound' : 'budget',
  };
}

/** A change held against its band in the row of a variant; `name` stands before _band_mm and _decided there. */
function judged(row: VariantRow | undefined, name: string, exactMm: number): CornerChange['along'] {
  const band = row?.[`${name}_band_mm`];
  const bandMm = isNumber(band) ? band : null;
  const undecided = bandMm === null ? row?.[`${name}_decided`] === 0 : Math.abs(exactMm) < bandMm;
  return { exactMm, bandMm, undecided, cannotTell: bandMm === null && !undecided && row?.jitter_known === false };
}

/** The effect of a variant on a corner of the mouth. */
export interface CornerChange {
  side: Side;
  /** Greatest distances from rest in base and in the variant, as they are shown. */
  fromMm: number;
  toMm: number;
  /** How much farther from rest it goes than in base: the change that `bandMm` belongs to. */
  byMm: number;
  /** The same, not rounded: what `undecided` compares with the band. */
  exactMm: number;
  /** How far it moves in the unchanged direction, that of its displacement in base, signed. */
  alongMm: number;
  /** How much more that is than in base, not rounded, with a band of its own: as exactMm, bandMm, undecided and cannotTell. */
  along: { exactMm: number; bandMm: number | null; undecided: boolean; cannotTell: boolean };
  /** It moves in that direction about as far as from rest, so that the figures above are complete. */
  sameWay: boolean;
  /** Some muscle of that side pulls less than in base. */
  weaker: boolean;
  bandMm: number | null;
  /** Of one other mesh and the jitter; of all errors of the error budget; of those of them that are known. */
  bandIs: 'band' | 'budget' | 'lower bound';
  undecided: boolean;
  /** The recording's jitter is not known, nor is the band then, and the change is larger than what is known of it. */
  cannotTell: boolean;
}

/** A distance from rest has no direction, and so the part in the unchanged direction is a second figure
 *  (metrics/variant_comparison.hpp, along_base_mm). Null where the corners are not known. */
export function cornerChange(replay: Replay, face: number, side: Side): CornerChange | null {
  const [base, own] = [cornersOf(replay, 0), cornersOf(replay, face)];
  if (!base || !own) return null;
  const row = rowOf(replay, face);
  const [from, to] = [farthestMm(base, side), farthestMm(own, side)];
  if (Number.isNaN(from) || Number.isNaN(to)) return null;
  const measured = row?.[`commissure_${letterOf[side]}_along_base_mm`];
  const alongMm = isNumber(measured) ? measured : to;
  const sameWay = Math.abs(to - alongMm) <= Math.max(0.25, 0.1 * to);
  const [fromMm, toMm] = [roundedMm(from), roundedMm(to)];
  const unchanged = Math.abs(to - from) < sameMm;
  const byMm = unchanged ? 0 : roundedMm(toMm - fromMm);
  const weak = row?.weaker_sides;
  const corner = `commissure_${letterOf[side]}`;
  const budget = judgedByBudget(replay, face, side);
  const along = judged(row, `${corner}_along_base`, alongMm - from);
  return {
    side, fromMm, toMm: unchanged ? fromMm : toMm, byMm, bandIs: 'band', ...judged(row, corner, to - from), ...budget, alongMm: roundedMm(alongMm), sameWay,
    // The error budget has no interval for it, and a band that leaves most errors out would look like one.
    along: budget.bandIs ? { ...along, bandMm: null, undecided: budget.undecided ?? false, cannotTell: budget.cannotTell ?? false } : along,
    weaker: Array.isArray(weak) && weak.includes(letterOf[side]),
  };
}

/** The value at time t between samples; null where unknown. */
export function valueAt(timeS: number[], values: (number | null)[], t: number): number | null {
  const at = frameAt(timeS, t);
  const [i, share] = [Math.floor(at), at - Math.floor(at)];
  const [a, b] = [values[i], values[Math.min(i + 1, values.length - 1)]];
  return a === null || b === null ? null : a + share * (b - a);
}

/** "is dragged 2.1 mm farther than in base": farther against its muscles, where these are weaker; less than others of
 *  its tissue make it follow. */
export function changeSentence({ byMm, exactMm, bandMm, sameWay, weaker }: CornerChange): string {
  if (byMm === 0) return sameWay ? 'goes as in base' : 'goes as far as in base';
  const by = bandMm === null ? mm(Math.abs(byMm)) : heldAgainst(byMm, exactMm, bandMm).own;
  const how = byMm < 0 ? `${weaker ? 'moves' : 'follows'} ${by} less` : `${weaker ? 'is dragged' : 'moves'} ${by} farther`;
  return `${how} than in base`;
}

/** How much less, or more, it moves in the unchanged direction, where it turns aside; else 0, mm. */
export const asideMm = ({ fromMm, alongMm, sameWay }: CornerChange): number => (sameWay ? 0 : roundedMm(alongMm - fromMm));

/** "5.9 ± 0.8 mm less", "undecided: 0.4 ± 0.8 mm less": the change in the unchanged direction with its band. */
function alongWords(change: CornerChange): string {
  const { exactMm, bandMm, undecided, cannotTell } = change.along;
  const by = asideMm(change);
  const { own, limit } = heldAgainst(by, exactMm, bandMm ?? 0);
  const figure = bandMm === null ? mm(Math.abs(by)) : `${own.replace(' mm', '')} ± ${limit}`;
  return `${undecided ? 'undecided: ' : ''}${figure} ${by < 0 ? 'less' : 'more'}${cannotTell ? ', cannot tell' : ''}`;
}

/** "in the unchanged direction 5.9 ± 0.8 mm less", where the corner turns aside; else empty. */
export function directionWords(change: CornerChange): string {
  const { alongMm, sameWay, bandIs, along: { bandMm, undecided, cannotTell } } = change;
  if (sameWay) return '';
  const judged = bandMm !== null || bandIs !== 'band' || undecided || cannotTell;
  if (alongMm < 0) return `${mm(-alongMm)} against the unchanged direction${judged ? `, ${alongWords(change)}` : ''}`;
  return `in the unchanged direction ${asideMm(change) === 0 ? 'as far as there' : alongWords(change)}`;
}

/** What that direction is, for readers. */
export const directionMeaning =
  'The unchanged direction is where the corner goes in base; motion aside of it counts in the distance from rest, not in it. ' +
  'Quote the distance from rest, the excursion.';

/** The error of a change as it is shown beside it, "0.6 mm"; empty where it is not known. */
export const bandWords = ({ byMm, exactMm, bandMm }: CornerChange): string =>
  bandMm === null ? '' : heldAgainst(byMm, exactMm, bandMm).limit;

/** "± 0.7 mm"; with an error budget "95 %: ± 2.9 mm", or "at least ± 1.4 mm". */
export const bandClauseWords = (change: CornerChange): string =>
  `${{ band: '', budget: '95 %: ', 'lower bound': 'at least ' }[change.bandIs]}± ${bandWords(change)}`;

/** "is dragged 2.1 ± 0.4 mm farther than in base" */
function changeFigures(change: CornerChange): string {
  const { byMm, exactMm, bandMm, undecided, cannotTell } = change;
  const aside = directionWords(change) && `, ${directionWords(change)}`;
  if (byMm === 0) return aside ? `as far as base${aside}` : 'as base';
  if (undecided) {
    const { own, limit } = heldAgainst(byMm, exactMm, bandMm ?? 0);
    if (change.bandIs !== 'band') return `undecided: ${own} ${byMm < 0 ? 'less' : 'more'} than base, ${bandClauseWords(change)}${aside}`;
    const figure = bandMm === null ? mm(Math.abs(byMm)) : `${own.replace(' mm', '')} ± ${limit}`;
    return `undecided: ${figure} ${byMm < 0 ? 'less' : 'more'} than base${aside}`;
  }
  const open = bandMm !== null && cannotTell ? ', cannot tell' : '';
  const band = bandMm !== null ? `${bandClauseWords(change)}${open}` : cannotTell ? 'cannot tell: the recording’s jitter is not known' : '± not known';
  return `${changeSentence(change)}, ${band}${aside}`;
}

/** "sides differ by 1.2 ± 0.4 mm" */
function sidesFigures(corners: Corners): string {
  if (!bothRecorded(corners)) return notComparedWords;
  const { own, limit } = apartAgainstFloor(corners);
  if (corners.budgeted) {
    const verdict = corners.undecided ? ', undecided' : corners.cannotTell ? ', jitter not known' : '';
    return `sides differ by ${own}, ${corners.lowerBound ? 'at least' : '95 %:'} ± ${limit}${verdict}`;
  }
  const band = corners.floorMm > 0 ? ` ± ${limit.replace(' mm', '')}` : '';
  return `sides differ by ${own.replace(' mm', '')}${band} mm${corners.undecided ? ', undecided' : corners.cannotTell ? ', jitter not known' : ''}`;
}

/** How far the corners of the mouth are from rest at the time shown, and at most in the whole motion, with what is
 *  uncertain: a sentence each; none where that is not known. */
export function cornerFigures(replay: Replay, face: number, t: number): string[] {
  const own = cornersOf(replay, face);
  if (!own) return [];
  const now = sides.flatMap((side) => {
    const value = valueAt(own.timeS, own[side], t);
    return value === null ? [] : `${side} ${mm(value)}`;
  });
  const most = sides.map((side) => {
    const change = face > 0 ? cornerChange(replay, face, side) : null;
    return change ? `${side} ${mm(change.toMm)} (${changeFigures(change)})` : `${side} ${mm(farthestMm(own, side))}`;
  });
  const apart = face > 0 ? '' : ` (${sidesFigures(own)})`;
  return [
    ...(now.length > 0 ? [`Corners of the mouth at ${t.toFixed(3)} s: ${now.join(', ')}`] : []),
    `At most, whole motion: ${most.join(', ')}${apart}`,
  ];
}

/** The difference between the figures as they are shown, rounded. */
export const apartMm = ({ leftMm, rightMm }: Corners): number => Math.abs(roundedMm(leftMm) - roundedMm(rightMm));

/** Whether the recording shows both corners. */
export const bothRecorded = ({ leftMm, rightMm }: Corners): boolean => !Number.isNaN(leftMm) && !Number.isNaN(rightMm);

const notComparedWords = 'a difference of the sides is not known';

/** "a difference of 8.1 mm": the figures do not show which side is the healthy one. */
export function differenceWords(corners: Corners): string {
  if (!bothRecorded(corners)) return notComparedWords;
  const { own, limit } = apartAgainstFloor(corners);
  if (corners.undecided) return `a difference of ${own}: undecided (below ${limit})`;
  if (apartMm(corners) < sameMm) return 'no difference';
  return corners.cannotTell ? `a difference of ${own}: cannot tell (jitter not known)` : `a difference of ${own}`;
}

/** How far the sides are apart, and the floor of that, so that the two do not print alike. */
export function apartAgainstFloor(corners: Corners): { own: string; limit: string } {
  const { leftMm, rightMm, floorMm } = corners;
  if (!bothRecorded(corners)) return { own: 'not known', limit: mm(floorMm) };
  if (!(floorMm > 0)) return { own: mm(apartMm(corners)), limit: mm(floorMm) };
  return heldAgainst(apartMm(corners), leftMm - rightMm, floorMm);
}
