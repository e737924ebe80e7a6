// SPDX-License-Identifier: GPL-3.0-or-later
// What the program writes into the page. V visits, in the order of time; changes are against the first.

export interface Visit {
  label: string;
  note: string;
  recordings: string[];
  /** Time of the peak by the first recording's own clock. */
  peak_s: number;
  /** null: not known. */
  jitter_mm: number | null;
  /** How well the head fits that of the first recording; null: it is the first. */
  head_fit_mm: number | null;
  /** null: not measured. */
  eye_distance_mm: number | null;
  /** The face at the peak, 3:4, with R and L drawn in it; empty: none. */
  picture: string;
  /** What the recording lacks for a picture; empty where there is one. */
  no_picture: string;
}

/** Distance of the corners of the mouth from rest; time 0 is where the movement first reaches half of
 * its peak, null is not measured. */
export interface VisitCurve {
  visit: number;
  recording: number;
  time_s: number[];
  right_mm: (number | null)[];
  left_mm: (number | null)[];
}

/** With its interval of 95 % by measurement alone; null: not known. Figures are exact: the page rounds them, once. */
export interface Value {
  value: number;
  low: number | null;
  high: number | null;
}

export type Beyond = 'yes' | 'no' | 'cannot tell';
export type Part = 'repetition' | 'jitter' | 'head pose' | 'axes' | 'landmarks';

export interface Change {
  value: number;
  /** The interval of 95 %, repetition included; null: not known, as the error of measurement is not. */
  low: number | null;
  high: number | null;
  /** The interval by measurement alone; null: not known. */
  low_measured: number | null;
  high_measured: number | null;
  beyond: Beyond;
  /** Whether something doubts the figures of this or of the first visit. */
  doubtful: boolean;
  /** The largest part of the interval. */
  largest: Part;
}

export interface Measure {
  key: string;
  words: string;
  side: 'R' | 'L' | '';
  unit: 'mm' | 'degrees' | '%';
  /** One for each visit; null: not measured. */
  values: (Value | null)[];
  /** One for each visit; the first is null, and so are those whose face has another scale than the first visit's. */
  changes: (Change | null)[];
}

export interface Manifest {
  version: 1;
  program: string;
  /** May be empty. */
  patient: string;
  expression: string;
  /** What the peak was found by: "corners of the mouth". */
  peak_by: string;
  repetition: { mm: number; source: 'default' | 'stated' | 'recordings'; text: string };
  visits: Visit[];
  curves: VisitCurve[];
  measures: Measure[];
  summary: string[];
  /** Remarks, which stand out. */
  notes: string[];
  /** What was chosen where the file leaves it open, as the points that hold the head. */
  choices: string[];
  caveat: string;
}
