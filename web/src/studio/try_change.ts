// SPDX-License-Identifier: GPL-3.0-or-later
// Changes of the faces that the server may refuse.
import { at } from '../page/dom';
import { Refused } from './connection';

/** Makes a change of base or of a variant, and shows why where the server refuses it. */
export function tryChange(act: () => Promise<unknown>): void {
  const problem = at('tabs-problem');
  problem.hidden = true;
  act().catch((error: unknown) => {
    if (!(error instanceof Refused)) return;
    problem.textContent = error.message;
    problem.hidden = false;
  });
}
