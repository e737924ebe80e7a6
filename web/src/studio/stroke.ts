// SPDX-License-Identifier: GPL-3.0-or-later
// One stroke over the skin. It acts once on each place that the brush crosses, however slowly it moves.
import type { Replay } from '../replay/data';
import type { SkinHit } from '../replay/face/face_body';
import type { SkinWalk } from './skin_walk';

export interface Brush {
  /** Metres, to its rim. */
  radiusM: number;
  /** Share of the radius with full strength, 0 to 1. */
  hardness: number;
  /** 0 to 1. */
  strength: number;
  erases: boolean;
  /** Whether it also acts on the other side of the face. */
  mirrored: boolean;
}

/** Shares are rounded to this many steps of 1, so that the page shows what the file holds. */
const steps = 1e4;
export const rounded = (share: number): number => Math.round(share * steps) / steps;

/** From 1 in the middle to 0 at the rim, smooth as the borders of regions are (3 s^2 - 2 s^3). */
export function falloff(share: number, hardness: number): number {
  if (share >= 1) return 0;
  if (share <= hardness) return 1;
  const s = (1 - share) / (1 - hardness);
  return s * s * (3 - 2 * s);
}

/** Values of vertices at the mirror images of all; 0 where a vertex has none. */
export function mirrored(mirror: NonNullable<Replay['mirror']>, values: Float32Array, out: Float32Array): void {
  const { vertices, weights } = mirror;
  for (let v = 0, i = 0; v < out.length; ++v, i += 3) {
    let [sum, all] = [0, 0];
    for (let k = i; k < i + 3; ++k) {
      if (vertices[k] < 0) continue;
      sum += weights[k] * values[vertices[k]];
      all += weights[k];
    }
    out[v] = all > 0 ? sum / all : 0;
  }
}

export class Stroke {
  private readonly before: Float32Array;
  private readonly covered: Float32Array;
  private readonly other: Float32Array | null;

  /** Changes `shares` (0 to 1 per vertex) in place. */
  constructor(
    private readonly walk: SkinWalk, readonly shares: Float32Array, private readonly brush: Brush,
    private readonly mirror: Replay['mirror'],
  ) {
    this.before = shares.slice();
    this.covered = new Float32Array(shares.length);
    this.other = brush.mirrored && mirror ? new Float32Array(shares.length) : null;
  }

  dab(at: SkinHit): void {
    const { covered, other, mirror, brush, shares, before } = this;
    const { vertices, far } = this.walk.reach(at, brush.radiusM);
    for (let i = 0; i < vertices.length; ++i)
      covered[vertices[i]] = Math.max(covered[vertices[i]], falloff(far[i] / brush.radiusM, brush.hardness));
    if (other && mirror) mirrored(mirror, covered, other);
    const put = (v: number) => {
      const share = brush.strength * Math.max(covered[v], other?.[v] ?? 0);
      shares[v] = rounded(brush.erases ? before[v] * (1 - share) : before[v] + share * (1 - before[v]));
    };
    if (other) for (let v = 0; v < shares.length; ++v) put(v);
    else vertices.forEach(put);
  }

  /** Undoes the stroke. */
  undo(): void {
    this.shares.set(this.before);
  }
}
