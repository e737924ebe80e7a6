// SPDX-License-Identifier: GPL-3.0-or-later
// How far the corners of the mouth go: the figures that a reader looks for first, in millimetres.
import type { Replay } from './data';
import { excursionsOf } from './tables/excursion_table';
import { tracksMm } from './curves/track_chart';

export interface Corners {
  timeS: number[];
  /** Distance from rest, mm a sample; null where unknown. */
  left: (number | null)[];
  right: (number | null)[];
  /** The largest of each, mm. */
  leftMm: number;
  rightMm: number;
  /** Differences of the sides below this are not told apart, mm; 0: no floor is known. */
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

/** "corners right 8.2 mm, left 9.7 mm": how far they go; empty where that is not known. */
export function cornerFigures(replay: Replay, face: number): string {
  const corners = cornersOf(replay, face);
  return corners ? `corners right ${mm(corners.rightMm)}, left ${mm(corners.leftMm)}` : '';
}

/** "8.1 mm less on the right" */
export function differenceWords({ leftMm, rightMm, floorMm, undecided }: Corners): string {
  const apart = Math.abs(leftMm - rightMm);
  if (undecided) return `${mm(apart)} apart: undecided (below ${mm(floorMm)})`;
  if (apart < 0.05) return 'no difference';
  return `${mm(apart)} less on the ${leftMm < rightMm ? 'left' : 'right'}`;
}
