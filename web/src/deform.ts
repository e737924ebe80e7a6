// SPDX-License-Identifier: GPL-3.0-or-later
// The skin at any time: modes times weights, and the normals that go with it.
import type { Replay } from './data';

/** The frame (with its fraction) at time t, clamped to the recording. */
export function frameAt(timeS: number[], t: number): number {
  let low = 0;
  let high = timeS.length - 1;
  if (high < 1 || t <= timeS[0]) return 0;
  if (t >= timeS[high]) return high;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (timeS[middle] <= t) low = middle;
    else high = middle;
  }
  return low + (t - timeS[low]) / (timeS[high] - timeS[low]);
}

export class Deformer {
  readonly displacement: Float32Array; // metres
  readonly position: Float32Array;
  readonly normal: Float32Array;

  constructor(private readonly replay: Replay) {
    this.displacement = new Float32Array(replay.points.length);
    this.position = new Float32Array(replay.points);
    this.normal = new Float32Array(replay.points.length);
    this.updateNormals();
  }

  /** Between frames the weights are interpolated linearly, as the animated glTF does. */
  moveTo(frame: number): void {
    const { modes, weights, points } = this.replay;
    const count = modes.length;
    const first = Math.floor(frame);
    const second = Math.min(first + 1, this.replay.timeS.length - 1);
    const share = frame - first;
    const { displacement, position } = this;
    displacement.fill(0);
    for (let k = 0; k < count; ++k) {
      const w = (1 - share) * weights[first * count + k] + share * weights[second * count + k];
      const factor = w * modes[k].stepM;
      if (factor === 0) continue;
      const values = modes[k].values;
      for (let i = 0; i < values.length; ++i) displacement[i] += factor * values[i];
    }
    for (let i = 0; i < position.length; ++i) position[i] = points[i] + displacement[i];
    this.updateNormals();
  }

  /** Area-weighted, not divided by their length: the vertex shader normalises. */
  private updateNormals(): void {
    const { position: p, normal: n } = this;
    const t = this.replay.triangles;
    n.fill(0);
    for (let i = 0; i < t.length; i += 3) {
      const a = 3 * t[i];
      const b = 3 * t[i + 1];
      const c = 3 * t[i + 2];
      const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
      const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
      // Scaled so that square millimetres stay well inside single precision.
      const x = 1e6 * (uy * vz - uz * vy);
      const y = 1e6 * (uz * vx - ux * vz);
      const z = 1e6 * (ux * vy - uy * vx);
      n[a] += x; n[a + 1] += y; n[a + 2] += z;
      n[b] += x; n[b + 1] += y; n[b + 2] += z;
      n[c] += x; n[c + 1] += y; n[c + 2] += z;
    }
  }
}

/** Index of the vertex in [from, to) closest to a point, and its distance. */
export function nearestVertex(
  points: Float32Array, at: ArrayLike<number>, from = 0, to = points.length / 3,
): { vertex: number; distance: number } {
  let vertex = -1;
  let least = Infinity;
  for (let v = from; v < to; ++v) {
    const x = points[3 * v] - at[0];
    const y = points[3 * v + 1] - at[1];
    const z = points[3 * v + 2] - at[2];
    const d = x * x + y * y + z * z;
    if (d < least) {
      least = d;
      vertex = v;
    }
  }
  return { vertex, distance: Math.sqrt(least) };
}
