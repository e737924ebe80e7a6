// SPDX-License-Identifier: GPL-3.0-or-later
// The text beside S(t): the millimetres of the corners, and a remark where S and the millimetres disagree about which
// of two faces differs less between its sides.
import { apartMm, bothRecorded, cornersOf, mm } from '../corners';
import type { Replay } from '../data';
import { faceWords, signed } from '../../page/format';
import type { Shown } from '../shown';

/** As pictures and the terminal have it (metrics/symmetry.hpp). */
export const whatSCompares =
  'S compares how much the distances from each corner of the mouth to eye, lid, nose and lip stretch; it does not say which face moves more evenly in mm ' +
  'and grades no palsy: the excursions say which side moves less.';

/** If one side hardly moves, the ratio of the sides is meaningless. */
const leastForRatioMm = 0.5;

/** "a difference of 0.5 mm, a ratio right/left of 0.95": of the corners' largest distances from rest. Empty where these
 *  are not known. No per cent, which elsewhere on the page is a confidence. */
function plainFigure(replay: Replay, face: number): string {
  const corners = cornersOf(replay, face);
  if (!corners || !bothRecorded(corners)) return '';
  const { leftMm, rightMm } = corners;
  const ratio = Math.min(leftMm, rightMm) >= leastForRatioMm ? `, a ratio right/left of ${(rightMm / leftMm).toFixed(2)}` : '';
  return `a difference of ${mm(apartMm(corners))}${ratio}`;
}

/** Figures of the faces shown. Each face is named where the run has several. */
export function plainFigures(replay: Replay, shown: Shown): string {
  const faces = [...new Set(shown.visible)];
  const figures = faces.flatMap((face) => {
    const figure = plainFigure(replay, face);
    return figure ? [replay.faces.length > 1 ? `${faceWords(replay.faces, face)}: ${figure}` : figure] : [];
  });
  return figures.length > 0 ? `Corners of the mouth – ${figures.join('; ')}.` : '';
}

/** The largest S of a face's curve; null where it has none. */
function largestS(replay: Replay, face: number): number | null {
  const values = (replay.faces[face].symmetry?.s ?? []).filter((s) => s !== null);
  return values.length > 0 ? Math.max(...values) : null;
}

/** Whether the largest S of a face exceeds its floor at that time. Smaller values cannot be distinguished. */
function aboveFloor(replay: Replay, face: number): boolean {
  const curve = replay.faces[face].symmetry;
  if (!curve) return false;
  const { noise = [], floor } = curve;
  const most = largestS(replay, face);
  return curve.s.some((s, i) => s !== null && s === most && s > Math.log(Math.max(noise.length === curve.s.length ? noise[i] ?? 0 : 0, floor)));
}

/** S and the millimetres, as they are shown, order two faces differently. */
function disagree(replay: Replay, a: number, b: number): { lower: number; other: number } | null {
  const [sA, sB] = [largestS(replay, a), largestS(replay, b)];
  const [cornersA, cornersB] = [cornersOf(replay, a), cornersOf(replay, b)];
  if (sA === null || sB === null || !cornersA || !cornersB || !bothRecorded(cornersA) || !bothRecorded(cornersB)) return null;
  if (cornersA.undecided && cornersB.undecided) return null;
  if (!aboveFloor(replay, a) && !aboveFloor(replay, b)) return null;
  const byS = Number(sA.toFixed(2)) - Number(sB.toFixed(2));
  const byMm = Number((apartMm(cornersA) - apartMm(cornersB)).toFixed(1));
  if (byS * byMm >= 0) return null;
  return byS < 0 ? { lower: a, other: b } : { lower: b, other: a };
}

/** The two faces shown; of one, that and base; of base alone, the first variant that is ordered differently. */
function pairsOf(replay: Replay, shown: Shown): [number, number][] {
  const [first, second] = shown.visible;
  if (second !== undefined && second !== first) return [[first, second]];
  if (first > 0) return [[0, first]];
  return replay.faces.slice(1).map((_, i) => [0, i + 1]);
}

/** One sentence; empty where both say the same. */
export function disagreement(replay: Replay, shown: Shown): string {
  for (const [a, b] of pairsOf(replay, shown)) {
    const found = disagree(replay, a, b);
    if (!found) continue;
    const [one, other] = [found.lower, found.other].map((face) => ({
      name: faceWords(replay.faces, face), s: signed(largestS(replay, face)!.toFixed(2)), apart: mm(apartMm(cornersOf(replay, face)!)),
    }));
    return `The largest S of “${one.name}” is lower than that of “${other.name}” (${one.s}, not ${other.s}), but its corners of the mouth differ more ` +
      `(by ${one.apart}, not ${other.apart}): S compares stretches to eye, lid, nose and lip. For which side moves less, read the millimetres.`;
  }
  return '';
}
