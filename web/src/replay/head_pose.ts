// SPDX-License-Identifier: GPL-3.0-or-later
// How uncertain the pose of the head is, which the limit of "undecided" includes.
import { cornersOf, mm, sameMm } from './corners';
import type { Replay } from './data';
import { isNumber } from './tables/figure_table';

export interface HeadPose {
  /** 95 % bounds, at the face. */
  shiftMm: number;
  turnDeg: number;
}

/** Null where it is not known, or smaller than the floor of the corners' difference: then other errors are larger. */
export function headUncertainty(replay: Replay): HeadPose | null {
  const { head_shift_uncertainty_mm: shiftMm, head_turn_uncertainty_deg: turnDeg } = replay.summary;
  if (!isNumber(shiftMm) || !isNumber(turnDeg) || shiftMm < sameMm) return null;
  return shiftMm > (cornersOf(replay, 0)?.floorMm ?? 0) ? { shiftMm, turnDeg } : null;
}

const atMost = ({ shiftMm, turnDeg }: HeadPose): string => `up to ${mm(shiftMm)} and ${turnDeg.toFixed(1)}° (95 %)`;

/** Below the figures. */
export const headWords = (pose: HeadPose): string =>
  `The head’s pose is uncertain by ${atMost(pose)}. The limit of “undecided” includes this. The ± of a change does not need to, since both runs share the pose.`;

/** In a picture, where there is less room. */
export const headCaption = (pose: HeadPose): string =>
  `Head’s pose uncertain by ${atMost(pose)}; “undecided” includes this.`;
