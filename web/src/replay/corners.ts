// SPDX-License-Identifier: GPL-3.0-or-later
// How far the corners of the mouth go: the figures that a reader looks for first, in millimetres.
import type { Replay } from './data';
import { frameAt } from './face/deform';
import { excursionsOf } from './tables/excursion_table';
import { isNumber } from './tables/figure_table';
import { tracksMm } from './curves/track_chart';
import { variantsOf } from './variants';

export interface Corners {
  timeS: number[];
  /** Distance from rest, mm a sample; null where unknown. */
  left: (number | null)[];
  right: (number | null)[];
  /** The largest of each, mm. */
  leftMm: number;
  rightMm: number;
  /** Differences of the sides below this are undecided, mm; 0: no floor is known. */
  floorMm: number;
  undecided: boolean;
  /** Both are points that the recording drives: they go where it says in any tissue. */
  driven: boolean;
}

const names: [left: string, right: string, pair: string][] = [
  ['cheilion_L', 'cheilion_R', 'cheilion'], ['ibug68_54', 'ibug68_48', 'ibug68_48/54'],
];
const largest = (track: (number | null)[]): number => Math.max(0, ...track.map((v) => v ?? 0));

/** Two places a side, each known to the jitter a coordinate: 95 in 100 (metrics/excursion.hpp). */
export const jitterFloorMm = (jitterMm: number): number => 1.96 * 2 * jitterMm;

/** Null where the run has no points at the corners. */
export function cornersOf(replay: Replay, face: number): Corners | null {
  const { landmarks, driven } = replay;
  if (landmarks.timeS.length < 2) return null;
  for (const [leftName, rightName, pairName] of names) {
    const [l, r] = [landmarks.names.indexOf(leftName), landmarks.names.indexOf(rightName)];
    if (l < 0 || r < 0) continue;
    const tracks = tracksMm(replay, face);
    const [left, right] = [tracks[l], tracks[r]];
    const pair = excursionsOf(replay, face).find(({ point }) => point === pairName);
    const leftMm = pair?.excursion_mm.L ?? largest(left);
    const rightMm = pair?.excursion_mm.R ?? largest(right);
    const floorMm = pair?.floor_mm ?? jitterFloorMm(replay.faces[face].symmetry?.jitter_mm ?? 0);
    return {
      timeS: landmarks.timeS, left, right, leftMm, rightMm, floorMm,
      undecided: pair?.undecided ?? Math.abs(leftMm - rightMm) < floorMm,
      // The corner goes by either name.
      driven: names.some(([a, b]) => driven.names.includes(a) && driven.names.includes(b)),
    };
  }
  return null;
}

export const mm = (value: number): string => `${value.toFixed(1)} mm`;

/** A difference from base below this is none, mm: half of what a figure here shows. */
export const sameMm = 0.05;

/** Of a variant's change against base: what mesh and jitter make of it, mm; null: not known. */
export function changeBandMm(replay: Replay, face: number, side: 'left' | 'right'): number | null {
  const row = variantsOf(replay)?.table.find(({ name }) => name === replay.faces[face].name);
  const band = row?.[side === 'left' ? 'commissure_L_band_mm' : 'commissure_R_band_mm'];
  return isNumber(band) ? band : null;
}

/** The value at time t between samples; null where unknown. */
export function valueAt(timeS: number[], values: (number | null)[], t: number): number | null {
  const at = frameAt(timeS, t);
  const [i, share] = [Math.floor(at), at - Math.floor(at)];
  const [a, b] = [values[i], values[Math.min(i + 1, values.length - 1)]];
  return a === null || b === null ? null : a + share * (b - a);
}

const sides = ['right', 'left'] as const; // as one sees the face

/** "5.4 ± 0.2 mm less than base" */
function changeFigures(change: number, band: number | null): string {
  if (Math.abs(change) < sameMm) return 'as base';
  const size = Math.abs(change).toFixed(1);
  const than = change < 0 ? 'less than base' : 'more than base';
  if (band === null) return `${size} mm ${than}, ± not known`;
  return `${size} ± ${band.toFixed(1)} mm ${than}${Math.abs(change) < band ? ', undecided' : ''}`;
}

/** "sides differ by 1.2 ± 0.4 mm" */
function sidesFigures({ leftMm, rightMm, floorMm, undecided }: Corners): string {
  const band = floorMm > 0 ? ` ± ${floorMm.toFixed(1)}` : '';
  return `sides differ by ${Math.abs(leftMm - rightMm).toFixed(1)}${band} mm${undecided ? ', undecided' : ''}`;
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
  const base = face > 0 ? cornersOf(replay, 0) : null;
  const most = sides.map((side) => {
    const of = (corners: Corners) => (side === 'left' ? corners.leftMm : corners.rightMm);
    const change = base ? ` (${changeFigures(of(own) - of(base), changeBandMm(replay, face, side))})` : '';
    return `${side} ${mm(of(own))}${change}`;
  });
  const apart = base ? '' : ` (${sidesFigures(own)})`;
  return [
    ...(now.length > 0 ? [`Corners of the mouth at ${t.toFixed(3)} s: ${now.join(', ')}`] : []),
    `At most, whole motion: ${most.join(', ')}${apart}`,
  ];
}

/** "8.1 mm less on the right" */
export function differenceWords({ leftMm, rightMm, floorMm, undecided }: Corners): string {
  const apart = Math.abs(leftMm - rightMm);
  if (undecided) return `${mm(apart)} apart: undecided (below ${mm(floorMm)})`;
  if (apart < sameMm) return 'no difference';
  return `${mm(apart)} less on the ${leftMm < rightMm ? 'left' : 'right'}`;
}
