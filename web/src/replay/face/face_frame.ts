// SPDX-License-Identifier: GPL-3.0-or-later
// The orientation of a face: scans have any pose, views should not.
import { Matrix4, Quaternion, Vector3 } from 'three';
import type { Replay } from '../data';

function landmark(replay: Replay, ...names: string[]): Vector3 | null {
  for (const name of names) {
    const i = replay.landmarks.names.indexOf(name);
    if (i < 0 || replay.landmarks.timeS.length === 0) continue;
    const at = new Vector3().fromArray(replay.landmarks.positions, 3 * i);
    if (Number.isFinite(at.x + at.y + at.z)) return at;
  }
  return null;
}

/**
 * Rotation that takes the scan's axes to x = the subject's left, y = up, z = forward. From the outer eye
 * corners and the mouth corners where they are known; else the scan is taken to stand so already.
 */
export function uprightFromScan(replay: Replay): Quaternion {
  const eyeL = landmark(replay, 'exocanthion_L', 'ibug68_45');
  const eyeR = landmark(replay, 'exocanthion_R', 'ibug68_36');
  const mouthL = landmark(replay, 'cheilion_L', 'ibug68_54');
  const mouthR = landmark(replay, 'cheilion_R', 'ibug68_48');
  if (!eyeL || !eyeR || !mouthL || !mouthR) return new Quaternion();
  const x = eyeL.clone().sub(eyeR).normalize();
  // In a head held upright the mouth corners lie before the outer eye corners: the line between them
  // leans by some 12 degrees.
  const up = eyeL.clone().add(eyeR).sub(mouthL).sub(mouthR).applyAxisAngle(x, (12 * Math.PI) / 180);
  const z = x.clone().cross(up).normalize();
  const y = z.clone().cross(x);
  return new Quaternion().setFromRotationMatrix(new Matrix4().makeBasis(x, y, z)).invert();
}
