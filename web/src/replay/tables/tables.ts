// SPDX-License-Identifier: GPL-3.0-or-later
// All tables of figures that a run has.
import { Undoing, type Undo } from '../../page/listeners';
import type { Replay } from '../data';
import { excursionTable } from './excursion_table';
import type { Shown } from '../shown';
import { surgeryTable } from './surgery_table';
import { variantsTable } from './variants_table';

/** `into` stays hidden where there are none. The tables follow what is shown until the returned function is called. */
export function fillTables(replay: Replay, shown: Shown, into: HTMLElement): Undo {
  const undoing = new Undoing();
  const tables = [variantsTable(replay, shown, undoing), surgeryTable(replay), excursionTable(replay, shown, undoing)].filter((card) => card !== null);
  into.replaceChildren(...tables);
  into.hidden = tables.length === 0;
  return () => {
    undoing.undo();
    into.replaceChildren();
  };
}
