// SPDX-License-Identifier: GPL-3.0-or-later
// What the program writes into the page (src/hyperex/report/html_report.cpp). Lengths are metres and
// times seconds unless a name says otherwise; vectors are x, y, z after each other.

import type { Stretch } from './page_data';

export interface Manifest {
  version: 1;
  title: string;
  notes: string[];
  summary: Record<string, unknown>;
  /** Vertices from here on were made by the cut along the lips. */
  scan_vertices: number;
  skin: {
    points: Stretch;
    triangles: Stretch;
    /** RGBA, sRGB, a vertex. */
    colour?: Stretch;
    /** Vertices split at the picture's seams: each view vertex names its vertex of `points`. */
    texture?: { mime_type: string; image: Stretch; uv: Stretch; skin_vertex: Stretch; triangles: Stretch };
  };
  motion: {
    time_s: number[];
    peak_frame: number;
    /** Displacement of frame f = sum over modes of weights[f, k] * step_m * values. */
    modes: { step_m: number; values: Stretch }[];
    /** Frames x modes. */
    weights: Stretch;
    max_error_mm: number;
    max_displacement_mm: number;
  };
  /** Positions: samples x names x 3; NaN where a point has none. */
  landmarks: { names: string[]; time_s: number[]; positions: Stretch };
  driven: { names: string[]; points: [number, number, number][] };
  held: [number, number, number][];
  lip_cut: [number, number, number][];
  symmetry: {
    time_s: number[];
    xi_left: (number | null)[];
    xi_right: (number | null)[];
    s: (number | null)[];
    floor: number;
  } | null;
}
