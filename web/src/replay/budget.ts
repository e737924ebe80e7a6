// SPDX-License-Identifier: GPL-3.0-or-later
// What the error budget of a run says of the corners of the mouth (summary.error_budget).
import type { Replay } from './data';
import { isNumber } from './tables/figure_table';

export interface BudgetedCorner {
  /** Absent for base. */
  variant?: string;
  figure: 'excursion' | 'difference' | 'change';
  /** Absent for a difference. */
  side?: 'R' | 'L';
  /** Null where a part is not known. */
  half_width_95_mm: number | null;
  /** Of the parts that are known. */
  known_half_width_95_mm: number;
  /** Whether the interval excludes 0; null: cannot tell, as a part is not known. */
  decided?: boolean | null;
}

const isCorner = (value: unknown): value is BudgetedCorner =>
  typeof value === 'object' && value !== null && isNumber((value as BudgetedCorner).known_half_width_95_mm);

/** The interval of a variant's change of a side, or of the difference of base's sides; null: the run has no budget. */
export function budgetOf(replay: Replay, wanted: Pick<BudgetedCorner, 'figure' | 'variant' | 'side'>): BudgetedCorner | null {
  const figures: unknown = (replay.summary.error_budget as { corners_of_the_mouth?: unknown } | undefined)?.corners_of_the_mouth;
  if (!Array.isArray(figures)) return null;
  return figures.filter(isCorner).find(({ figure, variant, side }) =>
    figure === wanted.figure && (variant ?? '') === (wanted.variant ?? '') && (side ?? '') === (wanted.side ?? '')) ?? null;
}
