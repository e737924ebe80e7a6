// SPDX-License-Identifier: GPL-3.0-or-later
// The skin at any time: modes times weights, and the normals that go with it.
import type { Face, Mode, Replay } from '../data';

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

/** Smaller displacements are not added, metres. */
const negligibleM = 1e-7;

/** Adds weights times modes at a frame to `out`. Between frames weights are interpolated linearly, as the animated glTF
 *  does. Four modes per pass, since writing `out` dominates the time. */
function addModes(modes: Mode[], weights: Float32Array, frame: number, frames: number, out: Float32Array): void {
  const count = modes.length;
  const first = Math.floor(frame);
  const second = Math.min(first + 1, frames - 1);
  const share = frame - first;
  const factors: number[] = [];
  const values: Int16Array[] = [];
  for (let k = 0; k < count; ++k) {
    const w = (1 - share) * weights[first * count + k] + share * weights[second * count + k];
    const factor = w * modes[k].stepM;
    if (Math.abs(factor) * 32767 < negligibleM) continue;
    factors.push(factor);
    values.push(modes[k].values);
  }
  let k = 0;
  for (; k + 4 <= factors.length; k += 4) {
    const [fa, fb, fc, fd] = factors.slice(k, k + 4);
    const [a, b, c, d] = values.slice(k, k + 4);
    for (let i = 0; i < out.length; ++i) out[i] += fa * a[i] + fb * b[i] + fc * c[i] + fd * d[i];
  }
  for (; k < factors.length; ++k) {
    const f = factors[k];
    const a = values[k];
    for (let i = 0; i < out.length; ++i) out[i] += f * a[i];
  }
}

/** The motion of base, computed once per frame for all faces. */
export class SceneMotion {
  readonly displacement: Float32Array; // metres
  private frame = NaN;

  constructor(private readonly replay: Replay) {
    this.displacement = new Float32Array(replay.points.length);
  }

  moveTo(frame: number): void {
    if (frame === this.frame) return;
    this.frame = frame;
    this.displacement.fill(0);
    const { modes, weights, timeS } = this.replay;
    addModes(modes, weights, frame, timeS.length, this.displacement);
  }

  /** Call it after a new motion. */
  forget(): void {
    this.frame = NaN;
  }
}

/** Displacements of a face in a frame, metres, into `out`. */
export function displace(replay: Replay, scene: SceneMotion, face: Face, frame: number, out: Float32Array): void {
  scene.moveTo(frame);
  out.set(scene.displacement);
  if (!face.difference) return;
  addModes(face.difference.modes, face.difference.weights, frame, replay.timeS.length, out);
}

/** What a face's displacements in a frame are more than those of base, metres. */
export function differenceAt({ points, timeS }: Replay, { difference }: Face, frame: number): Float32Array {
  const out = new Float32Array(points.length);
  if (difference) addModes(difference.modes, difference.weights, frame, timeS.length, out);
  return out;
}

/** One face's skin at any time. */
export class FaceShape {
  readonly displacement: Float32Array; // metres
  readonly position: Float32Array;
  readonly normal: Float32Array;

  constructor(private readonly replay: Replay, readonly scene: SceneMotion, public face: Face) {
    this.displacement = new Float32Array(replay.points.length);
    this.position = new Float32Array(replay.points);
    this.normal = new Float32Array(replay.points.length);
  }

  /** `live`: displacements instead of those of the motion; null: the motion's own. `triangles`: those from which
   *  normals are computed, where fewer are drawn. */
  moveTo(frame: number, live: Float32Array | null = null, triangles: ArrayLike<number> = this.replay.triangles): void {
    const { displacement, position } = this;
    const { points } = this.replay;
    if (live) {
      this.scene.moveTo(frame);
      displacement.set(live);
    } else {
      displace(this.replay, this.scene, this.face, frame, displacement);
    }
    for (let i = 0; i < position.length; ++i) position[i] = points[i] + displacement[i];
    this.updateNormals(triangles);
  }

  /** Area-weighted, not divided by their length: the vertex shader normalises. */
  private updateNormals(t: ArrayLike<number>): void {
    const { position: p, normal: n } = this;
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
