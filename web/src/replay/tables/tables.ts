// SPDX-License-Identifier: GPL-3.0-or-later
// All tables of figures that a run has.
import type { Replay } from '../data';
import { excursionTable } from './excursion_table';
import type { Shown } from '../shown';
import { variantsTable } from './variants_table';

/** `into` stays hidden where there are none. */
export function fillTables(replay: Replay, shown: Shown, into: HTMLElement): void {
  const tables = [variantsTable(replay, shown), excursionTable(replay, shown)].filter((card) => card !== null);
  into.append(...tables);
  into.hidden = tables.length === 0;
}
