// SPDX-License-Identifier: GPL-3.0-or-later
// What the program writes into the page (src/hyperex/report/tracking_page.cpp). N frames, in the
// order of time.
import type { Stretch } from '../page/page_data';

export interface Manifest {
  version: 1;
  recording: string;
  model: { name: string; vertices: number; units: number };
  /** Lengths come from depth; false: from `eye_distance_mm` between the outer eye corners. */
  metric: boolean;
  eye_distance_mm: number;
  notes: string[];
  /** Frames of the recording; more than N where the time of some frame did not increase. */
  frames: number;
  valid: number;
  /** The recording's clock at time_s = 0. */
  start_s: number;
  time_s: number[];
  /** The frames' numbers in the recording, N int32. */
  index: Stretch;
  /** The first valid frame, which turn and shift are relative to; -1: none. */
  reference: number;
  /** Frames first to last (0 to N - 1) are not valid. */
  faults: { first: number; last: number; fault: string }[];
  channels: {
    group: 'turn' | 'shift' | 'distance' | 'unit' | 'residual';
    name: string;
    facs: string;
    unit: string;
    /** Value = step * int16; −32768 where there is none. */
    step: number;
    values: Stretch;
  }[];
}
