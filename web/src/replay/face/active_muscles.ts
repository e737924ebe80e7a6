// SPDX-License-Identifier: GPL-3.0-or-later
// Which muscles the recording shows to act: their activation differs from 0 by more than its 95 % interval.
import type { Face, Muscles } from '../data';
import { frameAt } from './deform';

/** The time of a frame, or between two frames. */
function timeOf(timeS: number[], frame: number): number {
  const first = Math.floor(frame);
  const second = Math.min(first + 1, timeS.length - 1);
  return timeS[first] + (frame - first) * (timeS[second] - timeS[first]);
}

/** For each of `muscles.lines`: whether it acts in a face in the frame shown (`frameTimeS[frame]`). The sample nearest in
 *  time counts. Where nothing is known of a muscle, it is taken to act. */
export function activeLines(muscles: Muscles, face: Face, frameTimeS: number[], frame: number): boolean[] {
  const sample = Math.round(frameAt(muscles.timeS, timeOf(frameTimeS, frame)));
  return muscles.lines.map((_, i) => face.activeMuscles[i]?.[sample] !== '0');
}
