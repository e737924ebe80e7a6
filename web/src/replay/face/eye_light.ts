// SPDX-License-Identifier: GPL-3.0-or-later
// The light that passes between the lids onto an eyeball. It stays with the head while the ball turns.
import { type Quaternion, Vector3 } from 'three';
import { linearOf } from './colour';

/** The share of an interval from `from` to `to` at which `at` lies, 0 where it has no length. */
const shareOf = (at: number, from: number, to: number) => (to > from ? (at - from) / (to - from) : 0);

export class EyeLight {
  /** Linear, per point at rest. */
  private readonly light: Float32Array;
  /** Points of each ring about +z. The rings follow each other, the first one all at the pole. */
  private readonly sectors: number;
  /** Of each ring from +z, radians. */
  private readonly angles: number[] = [];
  private readonly at = new Vector3();

  /** `points`: the eye model's, radius 1. `light`: a byte for each. */
  constructor(private readonly points: Float32Array, light: Uint8Array) {
    this.light = Float32Array.from(light, linearOf);
    let sectors = 1;
    while (3 * sectors < points.length && points[3 * sectors + 2] === points[2]) ++sectors;
    this.sectors = sectors;
    for (let z = 2; z < points.length; z += 3 * sectors) this.angles.push(Math.acos(Math.max(-1, Math.min(1, points[z]))));
  }

  /** Light from 0 to 1 on each point after a turn of the ball from rest, in the model's own axes. */
  after(turn: Quaternion, out: Float32Array): void {
    for (let v = 0; v < out.length; ++v) out[v] = this.from(this.at.fromArray(this.points, 3 * v).applyQuaternion(turn));
  }

  private from({ x, y, z }: Vector3): number {
    const { angles, light, sectors } = this;
    const angle = Math.acos(Math.max(-1, Math.min(1, z)));
    let ring = 0;
    while (ring + 2 < angles.length && angles[ring + 1] < angle) ++ring;
    const out = Math.min(1, shareOf(angle, angles[ring], angles[ring + 1]));
    const around = ((Math.atan2(y, x) / (2 * Math.PI) + 1) % 1) * sectors;
    const first = Math.floor(around) % sectors;
    const second = (first + 1) % sectors;
    const on = (r: number) => {
      const [a, b] = [light[r * sectors + first], light[r * sectors + second]];
      return a + (b - a) * (around - Math.floor(around));
    };
    return on(ring) + (on(ring + 1) - on(ring)) * out;
  }
}
