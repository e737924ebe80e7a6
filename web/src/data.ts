// SPDX-License-Identifier: GPL-3.0-or-later
// The replay's data as the other parts use them.
import type { Manifest } from './manifest';
import { readPageData } from './page_data';

export type Vec3 = [number, number, number];

export interface Replay {
  title: string;
  notes: string[];
  summary: Record<string, unknown>;
  scanVertices: number;
  points: Float32Array;
  triangles: Int32Array;
  colour: Uint8Array | null;
  texture: { image: Blob; uv: Float32Array; skinVertex: Int32Array; triangles: Int32Array } | null;
  timeS: number[];
  peakFrame: number;
  modes: { stepM: number; values: Int16Array }[];
  weights: Float32Array;
  maxErrorMm: number;
  maxDisplacementMm: number;
  landmarks: { names: string[]; timeS: number[]; positions: Float32Array };
  driven: { names: string[]; points: Vec3[] };
  held: Vec3[];
  lipCut: Vec3[];
  symmetry: Manifest['symmetry'];
}

export function readReplay(): Replay {
  const { manifest, block } = readPageData<Manifest>();
  const { float32, int32, int16, uint8 } = block;
  const { skin, motion } = manifest;
  return {
    title: manifest.title,
    notes: manifest.notes,
    summary: manifest.summary,
    scanVertices: manifest.scan_vertices,
    points: float32(skin.points),
    triangles: int32(skin.triangles),
    colour: skin.colour ? uint8(skin.colour) : null,
    texture: skin.texture
      ? {
          image: new Blob([uint8(skin.texture.image)], { type: skin.texture.mime_type }),
          uv: float32(skin.texture.uv),
          skinVertex: int32(skin.texture.skin_vertex),
          triangles: int32(skin.texture.triangles),
        }
      : null,
    timeS: motion.time_s,
    peakFrame: motion.peak_frame,
    modes: motion.modes.map((m) => ({ stepM: m.step_m, values: int16(m.values) })),
    weights: float32(motion.weights),
    maxErrorMm: motion.max_error_mm,
    maxDisplacementMm: motion.max_displacement_mm,
    landmarks: {
      names: manifest.landmarks.names,
      timeS: manifest.landmarks.time_s,
      positions: float32(manifest.landmarks.positions),
    },
    driven: manifest.driven,
    held: manifest.held,
    lipCut: manifest.lip_cut,
    symmetry: manifest.symmetry,
  };
}

/** Distance of each landmark from its first sample, mm: one array a landmark, null where unknown. */
export function landmarkTracksMm(replay: Replay): (number | null)[][] {
  const { names, timeS, positions } = replay.landmarks;
  const stride = 3 * names.length;
  return names.map((_, p) =>
    timeS.map((_t, f) => {
      const a = 3 * p;
      const b = f * stride + 3 * p;
      const d = Math.hypot(
        positions[b] - positions[a],
        positions[b + 1] - positions[a + 1],
        positions[b + 2] - positions[a + 2],
      );
      return Number.isFinite(d) ? 1e3 * d : null;
    }),
  );
}
