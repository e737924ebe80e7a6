// SPDX-License-Identifier: GPL-3.0-or-later
// What a face changes at a corner of the mouth, against base, with its error: a line of the answer and of the table.
import { element } from '../page/dom';
import { bandClauseWords, directionMeaning, directionWords, heldAgainst, mm, type CornerChange } from '../replay/corners';
import { words } from './words';

/** Until error bands are known, changes below this are shown as uncertain, mm. */
const unsureMm = 0.5;

export function changeLine(change: CornerChange): HTMLElement {
  const { byMm, exactMm, bandMm, bandIs, weaker, undecided, cannotTell } = change;
  const sure = !undecided && !cannotTell && (bandMm !== null || Math.abs(byMm) >= unsureMm);
  const by = bandMm === null ? mm(Math.abs(byMm)) : heldAgainst(byMm, exactMm, bandMm).own;
  const text = words.againstBase(by, byMm > 0);
  const how = sure && weaker && byMm > 0 ? words.dragged : '';
  const aside = directionWords(change);
  const band = [bandMm === null ? '' : words.band(bandClauseWords(change)), cannotTell ? words.changeCannotTell : ''].filter(Boolean).join(' ');
  const distance = byMm === 0 ? [aside ? words.asFarAsBase : words.asBase] : [undecided ? words.undecidedChange(text) : text, band, how];
  const parts = [...distance, aside].filter(Boolean);
  const small = element('small', '', (byMm !== 0 && sure) || aside ? 'change' : 'same');
  // A line breaks between the parts, not inside of them.
  parts.forEach((part, i) => small.append(...(i > 0 ? [' '] : []), element('span', part)));
  const hints = [bandMm === null ? '' : bandIs === 'band' ? words.bandHint : words.budgetHint, aside && directionMeaning].filter(Boolean);
  if (hints.length > 0) small.title = hints.join(' ');
  return small;
}
