// SPDX-License-Identifier: GPL-3.0-or-later
// What the program writes into the page (src/hyperex/report/html_report.cpp). Lengths are metres and
// times seconds unless a name says otherwise; vectors are x, y, z after each other.

import type { Stretch } from '../page/page_data';

/** Displacements of all vertices: step_m * values. */
export interface ModeData {
  step_m: number;
  values: Stretch;
}

/** A quantity on the skin, as a parameter of the tissue. */
export interface SkinMapData {
  key: string;
  /** In plain words: "Young's modulus". */
  name: string;
  unit: string;
  /** Over all maps of this key in the page, so that one colour bar serves all. */
  least: number;
  greatest: number;
  /** One byte per vertex: value = least + byte / 255 * (greatest - least). */
  values: Stretch;
}

export interface SymmetryCurve {
  time_s: number[];
  xi_left: (number | null)[];
  xi_right: (number | null)[];
  s: (number | null)[];
  /** The lower limit of S, since perfect symmetry is minus infinity: the least |xi_left - xi_right| that counts. */
  floor: number;
  /** Bound of |xi_left - xi_right| of a symmetric motion due to jitter alone; [] for an exact motion. */
  noise?: (number | null)[];
  /** The part of `noise` that is due to the mesh; [] where unknown. */
  mesh_noise?: (number | null)[];
  /** Standard deviation of a point's coordinate; 0 for an exact motion. */
  jitter_mm?: number;
}

/** Activations and places of the muscles that drive the scene's own run. */
export interface MuscleData {
  time_s: number[];
  /** Few points drive, so that the prior decides most activations. */
  few_points: boolean;
  /** Sums over muscles that points can hardly distinguish. Where the group acts most: sigma, and a note on what the
   *  prior decides ("": none). */
  groups: {
    name: string; left: number[]; right: number[]; sigma_left: number; sigma_right: number; note_left?: string; note_right?: string;
  }[];
  /** From origin to insertion, at rest. A muscle that ends along the fold from nose to mouth has a sheet, a fan: its tip,
   *  then points along the fold. */
  lines: { name: string; latin: string; points: [number, number, number][]; sheet?: [number, number, number][] }[];
  /** Of each line, a character per sample: 1 where the activation differs from 0 (95 %), else 0. "": not known. */
  active?: string[];
}

/** Other tissue on the same mesh, moved by the same motion at the same times. */
export interface VariantData {
  name: string;
  /** Differences from base, one sentence each. */
  changes: string[];
  /** Displacement in frame f = the scene's own + sum over modes of weights[f, k] * step_m * values. */
  difference: { modes: ModeData[]; weights: Stretch; max_error_mm: number };
  max_displacement_mm: number;
  /** Greatest distance from the scene's own run, over all vertices and frames. */
  max_difference_mm: number;
  /** Where that is; 0 where there is none. */
  max_difference_frame: number;
  symmetry: SymmetryCurve | null;
  /** Samples x names x 3, of the names and times of the scene's landmarks. */
  landmarks: Stretch;
  tissue: SkinMapData[];
  /** Activations of the groups of the scene's own muscles; [] where unknown. */
  muscles?: { left: number[]; right: number[] }[];
  /** As MuscleData.active; [] where unknown. */
  active_muscles?: string[];
  /** See motion.jaw. */
  jaw?: Stretch;
  /** See motion.upper_teeth. */
  upper_teeth?: number[] | null;
}

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
    /** RGBA, sRGB, per vertex. */
    colour?: Stretch;
    /** Ambient occlusion at rest: the share of light that reaches each vertex, one byte. */
    light: Stretch;
    /** Opacity of the skin at each vertex, one byte: 0 at the border of the scan, 255 from 12 mm on. */
    fade: Stretch;
    /** Vertices split at the picture's seams: each view vertex names its vertex of `points`. */
    texture?: { mime_type: string; image: Stretch; uv: Stretch; skin_vertex: Stretch; triangles: Stretch };
  };
  motion: {
    time_s: number[];
    peak_frame: number;
    /** Displacement of frame f = sum over modes of weights[f, k] * step_m * values. */
    modes: ModeData[];
    /** Frames x modes. */
    weights: Stretch;
    max_error_mm: number;
    max_displacement_mm: number;
    /** Where there are teeth: frames x 7, the jaw's quaternion x y z w and translation since rest. */
    jaw?: Stretch;
    /** The pose that surgery gave the upper teeth: quaternion x y z w and translation. */
    upper_teeth?: number[] | null;
    /** Where the recording has it: frames x 8, quaternions x y z w of the right and the left eye since looking ahead. */
    gaze?: Stretch;
  };
  /** Positions: samples x names x 3; NaN where a point has none. */
  landmarks: { names: string[]; time_s: number[]; positions: Stretch };
  driven: { names: string[]; points: [number, number, number][] };
  held: [number, number, number][];
  lip_cut: [number, number, number][];
  symmetry: SymmetryCurve | null;
  /** Where each vertex's mirror image lies on the skin at rest: three vertices each (-1: nowhere) and their
   *  weights (they sum to about 255). The plane's normal is of unit length. */
  mirror?: { normal: [number, number, number]; vertices: Stretch; weights: Stretch };
  /** Plain names of points. */
  point_words: Record<string, string>;
  /** Holes of the skin, and the pockets behind them: rings and a point, attached to the edge. Points at rest
   *  (middle + step_m * values) begin with the edge. */
  openings: {
    loop: Stretch;
    middle: [number, number, number];
    points: ModeData;
    /** For each ring behind the edge, and for the point: shares of the motion of the edge's vertex before it, of the
     *  edge's middle, and of the jaw. */
    rings: [number, number, number][];
    /** Per vertex of the loop: its share of the jaw's motion; the point takes a half. */
    jaw: Stretch;
    /** sRGB, three bytes per point. */
    colours: Stretch;
  }[];
  eyeballs: { centre: [number, number, number]; gaze: [number, number, number]; radius_m: number; light: Stretch }[];
  /** An eyeball of radius 1 with its gaze along +z; three bytes of colour a vertex. Where there are eyeballs. */
  eye_model?: { middle: [number, number, number]; points: ModeData; triangles: Stretch; colours: Stretch };
  /** Teeth, gums and tongue at rest: points are middle + step_m * values. */
  teeth?: {
    jaw: 'upper' | 'lower';
    part: 'crowns' | 'gum' | 'tongue';
    /** sRGB, bytes. */
    colour: [number, number, number];
    middle: [number, number, number];
    points: ModeData;
    triangles: Stretch;
    /** One byte per vertex: how much light reaches it behind the lips. */
    light: Stretch;
  }[];
  variants?: VariantData[];
  muscles?: MuscleData;
  /** How far the scene's own skin is expected to be from the true one; absent where that is not known. */
  uncertainty?: SkinMapData;
  /** What differs from place to place in the scene or a variant: the same keys for all of them. */
  tissue?: SkinMapData[];
}
