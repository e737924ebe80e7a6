// SPDX-License-Identifier: GPL-3.0-or-later
// How unevenly the halves of a face move: per vertex, its displacement less the mirrored displacement of its
// counterpart, a = u - R u_c with R v = v - 2 (n . v) n.
import type { Replay } from '../data';
import { displace, SceneMotion } from './deform';

type Mirror = NonNullable<Replay['mirror']>;

/** Lengths of `a` times `factor` into `out`, NaN where a vertex has no counterpart. */
export function asymmetry(mirror: Mirror, u: Float32Array, factor: number, out: Float32Array): void {
  const { vertices, weights } = mirror;
  const [nx, ny, nz] = mirror.normal;
  for (let i = 0, v = 0; i < out.length; ++i, v += 3) {
    if (vertices[v] < 0) {
      out[i] = NaN;
      continue;
    }
    const [p, q, r] = [3 * vertices[v], 3 * vertices[v + 1], 3 * vertices[v + 2]];
    const all = weights[v] + weights[v + 1] + weights[v + 2];
    const [f, g, h] = [weights[v] / all, weights[v + 1] / all, weights[v + 2] / all];
    const cx = f * u[p] + g * u[q] + h * u[r];
    const cy = f * u[p + 1] + g * u[q + 1] + h * u[r + 1];
    const cz = f * u[p + 2] + g * u[q + 2] + h * u[r + 2];
    const twice = 2 * (nx * cx + ny * cy + nz * cz);
    const x = u[v] - cx + twice * nx;
    const y = u[v + 1] - cy + twice * ny;
    const z = u[v + 2] - cz + twice * nz;
    out[i] = factor * Math.sqrt(x * x + y * y + z * z);
  }
}

/** The 99.5 % quantile over vertices, of all faces where the scene moves most, mm. */
export function usualAsymmetryMm(replay: Replay, mirror: Mirror): number {
  const scene = new SceneMotion(replay);
  const displacement = new Float32Array(replay.points.length);
  const count = replay.points.length / 3;
  const all = new Float32Array(count * replay.faces.length);
  replay.faces.forEach((face, i) => {
    displace(replay, scene, face, replay.peakFrame, displacement);
    asymmetry(mirror, displacement, 1e3, all.subarray(i * count, (i + 1) * count));
  });
  const known = all.filter((a) => !Number.isNaN(a)).sort();
  return known.length > 0 ? known[Math.ceil(0.995 * known.length) - 1] : 0;
}
