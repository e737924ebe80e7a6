// SPDX-License-Identifier: GPL-3.0-or-later
// What protocol.json calls "json", as the server writes it (apps/studio/session*.cpp).
import type { Stretch } from '../page/page_data';
import type { Vec3 } from '../replay/data';

/** A column of a key's tables. */
export interface SceneColumn {
  /** "tissue.young_kpa"; of a column "young_factor". */
  name: string;
  kind: string;
  unit: string;
  /** Absent where there is no range. */
  low?: number;
  high?: number;
  above_low?: boolean;
  or_zero?: boolean;
  choices: string[];
  description: string;
}

/** A key of a scene, as docs/scene.md lists them. */
export interface SceneKey extends SceneColumn {
  default: unknown;
  /** Of keys whose value is a list of tables. */
  columns?: SceneColumn[];
}

export interface Preset {
  name: string;
  summary: string;
  source: string;
  assumed: string;
  /** As a variant would have them: sections with keys. */
  changes: Record<string, unknown>;
}

/** A published stiffness of another tissue, as a factor. */
export interface StifferTissue {
  name: string;
  summary: string;
  source: string;
  young_factor: number;
}

/** Of the face: "cheek", also as "cheek_L" and "cheek_R". */
export interface Region {
  name: string;
  meaning: string;
}

export interface Places {
  started: string | null;
  /** A camera that the command named. */
  device: string | null;
  /** The unsaved work of an ended session, and its time. */
  autosave: { title: string; seconds_ago: number } | null;
  /** Where "save" writes. */
  folder: string;
  /** Whether a face is open already, as after the page was loaded again. */
  open: boolean;
}

/** A row of the event budget. */
export interface BudgetFigure {
  /** Absent for base. */
  variant?: string;
  figure: 'excursion' | 'difference' | 'change';
  /** Absent for a difference, which is left less right. */
  side?: 'R' | 'L';
  value_mm: number | null;
  /** As it is printed: a change or a difference agrees with the printed distances. */
  shown_mm?: number | null;
  /** Null where a part is not known: the interval is wider than the known parts make it. */
  half_width_95_mm: number | null;
  /** Of the parts that are known. */
  known_half_width_95_mm: number;
  /** Of a difference or a change: whether its interval excludes 0. Null: cannot tell, as a part is not known. */
  decided?: boolean | null;
  /** Empty where a part is not known. */
  largest_part: string;
}

export type Values = Record<string, unknown>;

export interface SceneFace {
  name: string;
  preset?: string;
  changes: Values;
}

/** Of the muscles over time, in the events "face" and "motion". */
export interface Activations {
  names: string[];
  time_s: number[];
  /** Names x times, one array per face; null where unknown. */
  faces: (Stretch | null)[];
  /** Of each name: "mostly the prior's choice" where that is so in base, where the muscle acts most; else empty. */
  notes: string[];
}

/** The event "scene". */
export interface SceneNow {
  title: string;
  /** Of each face: every key. */
  values: Values[];
  faces: SceneFace[];
  /** Of the recording; motion.rigid_points may name them. */
  points: string[];
  drive: string;
  drive_why: string;
  /** The recording before the present one; "": none. */
  earlier: string;
  can_undo: boolean;
  can_redo: boolean;
  saved: boolean;
  text: string;
}

export interface MuscleInfo {
  /** Without side: "zyg_major". */
  name: string;
  latin: string;
  group: string;
  branch: string;
}

export interface LandmarkInfo {
  name: string;
  /** That of the other side; its own in the middle. */
  other: string;
  position: Vec3;
  found: boolean;
}

export const isRecord = (v: unknown): v is Record<string, unknown> => typeof v === 'object' && v !== null && !Array.isArray(v);
