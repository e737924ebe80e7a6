// SPDX-License-Identifier: GPL-3.0-or-later
// The comparison of the variants as the run's summary holds it (summary.variants).
import { changeWords } from './change_words';
import type { Replay } from './data';

export interface VariantRow {
  name: string;
  changes?: Record<string, unknown> | string[];
  inverted_tets?: number;
  [figure: string]: unknown;
}

export interface Variants {
  driven_point?: string;
  response_point?: string;
  table: VariantRow[];
}

const isVariants = (v: unknown): v is Variants =>
  typeof v === 'object' && v !== null && Array.isArray((v as Variants).table);

/** The table of base and its variants, in the order of `Replay.faces`; null where the run has no variants. */
export function variantsOf(replay: Replay): Variants | null {
  const { variants } = replay.summary;
  return isVariants(variants) && variants.table.length > 1 ? variants : null;
}

/** The differences of a face from base, one sentence each; from the summary, which has numbers and names separately. */
export function changesOf(replay: Replay, i: number): string[] {
  const row = variantsOf(replay)?.table.find(({ name }) => name === replay.faces[i].name);
  if (Array.isArray(row?.changes)) return row.changes;
  if (!row?.changes) return replay.faces[i].changes;
  const lines = replay.muscles?.lines ?? [];
  const latinOf = (stem: string): string => lines.find(({ name }) => name.replace(/_[LR]$/, '') === stem)?.latin ?? '';
  return changeWords(row.changes, replay.summary.options, latinOf);
}
