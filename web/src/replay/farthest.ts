// SPDX-License-Identifier: GPL-3.0-or-later
// Where the skin of a variant differs most from base: a vertex, which is not the landmark that it lies near.
import { mm } from './corners';
import type { Face, Replay } from './data';
import { differenceAt, nearestVertex } from './face/deform';
import { landmarkName } from '../page/format';
import { isNumber } from './tables/figure_table';
import type { VariantRow } from './variants';

/** Valid until the next motion, for which the faces are made anew. */
const known = new WeakMap<Face, number>();

/** The vertex that is farthest from base in the frame where the face differs most. */
function farthestVertex(replay: Replay, face: Face): number {
  const before = known.get(face);
  if (before !== undefined) return before;
  const difference = differenceAt(replay, face, face.maxDifferenceFrame);
  let [vertex, most] = [-1, 0];
  for (let v = 0; v < difference.length / 3; ++v) {
    const far = Math.hypot(difference[3 * v], difference[3 * v + 1], difference[3 * v + 2]);
    if (far > most) [vertex, most] = [v, far];
  }
  known.set(face, vertex);
  return vertex;
}

/** "6 mm from corner of the mouth (cheilion), right"; "near …" where the distance at rest is not known. Empty where the
 *  run names no landmark. */
export function placeWords(replay: Replay, i: number, row: VariantRow | undefined): string {
  const name = row?.farthest_near;
  if (typeof name !== 'string' || name === '') return '';
  const { names, positions } = replay.landmarks;
  const [at, vertex] = [names.indexOf(name), farthestVertex(replay, replay.faces[i])];
  if (at < 0 || vertex < 0) return `near ${landmarkName(name)}`;
  const { points } = replay;
  const distanceMm = 1e3 * nearestVertex(points, positions.subarray(3 * at, 3 * at + 3), vertex, vertex + 1).distance;
  if (!Number.isFinite(distanceMm)) return `near ${landmarkName(name)}`;
  return `${distanceMm < 0.5 ? 'less than 1' : distanceMm.toFixed(0)} mm from ${landmarkName(name)}`;
}

const isCorner = (name: unknown): boolean => typeof name === 'string' && /^(cheilion_[LR]|ibug68_(48|54))$/.test(name);

/** Where and when the skin differs most, and how far that vertex moves at the peak: one sentence each. The last one
 *  must not be mistaken for the figures of the nearby corner of the mouth. */
export function farthestSentences(replay: Replay, i: number, row: VariantRow): string[] {
  const place = placeWords(replay, i, row);
  const { displacement_there_mm: here, base_displacement_there_mm: there, farthest_near: near } = row;
  if (place === '' || !isNumber(here) || !isNumber(there)) return [];
  const { maxDifferenceMm, maxDifferenceFrame } = replay.faces[i];
  const when = (frame: number) => `${(replay.timeS[frame] ?? 0).toFixed(3)} s`;
  return [
    `Differs most at a vertex of the skin ${place}: by ${mm(maxDifferenceMm)} at ${when(maxDifferenceFrame)}.`,
    `At the peak, ${when(replay.peakFrame)}, that vertex moves ${here.toFixed(2)} instead of ${there.toFixed(2)} mm.` +
      (isCorner(near) ? ' The corner’s own figures are those above, under “Corners of the mouth”.' : ''),
  ];
}
