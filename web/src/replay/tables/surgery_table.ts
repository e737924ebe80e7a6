// SPDX-License-Identifier: GPL-3.0-or-later
// What surgery does to the landmarks that planners use: at rest, beside published ratios, and to the expression.
import type { Replay, Vec3 } from '../data';
import { element } from '../../page/dom';
import { faceColour } from '../../page/face_colour';
import { fixed, landmarkName, upper } from '../../page/format';
import { directionWords, lengthOf, shownMoves, softTissueMoves, volumeSentence, type SoftTissueMove } from '../surgery';
import { variantsOf } from '../variants';
import { columnNotes, figureCard, figureCell, headCell, type Column } from './figure_table';

const atRest: Column = {
  key: 'at_rest', head: 'At rest', unit: 'mm', digits: 1, says: 'how far surgery moves it, the face at rest.',
};
const ratio: Column = {
  key: 'soft_per_bone', head: 'Of the bone', unit: '1', digits: 2,
  says: 'how far the skin moves in the bone’s direction, divided by how far the bone moves; given where a ratio is published.',
};
const published: Column = {
  key: 'published', head: 'Published', unit: 'usual, range', digits: 2,
  says: 'the same ratio of patients: the usual one, and the range over studies, not over patients. Sources: docs/surgery.md.',
};
const before: Column = {
  key: 'before', head: 'Expression before', unit: 'mm', digits: 1, says: 'how far the expression moves it from rest at the peak of base.',
};
const after: Column = {
  key: 'after', head: 'Expression after', unit: 'mm', digits: 1, says: 'the same after surgery, from the new face at rest.',
};
const columns = [atRest, ratio, published, before, after];

function movedCell(move: Vec3, column: Column): HTMLTableCellElement {
  const cell = figureCell(lengthOf(move), column);
  cell.append(element('small', directionWords(move)));
  return cell;
}

function rowOf(body: HTMLTableSectionElement, move: SoftTissueMove): void {
  const row = body.insertRow();
  const name = element('th', upper(landmarkName(move.landmark)));
  name.scope = 'row';
  const range = element('td', move.published ? fixed(move.published.usual, 2) : '–');
  if (move.published) {
    range.title = move.published.source;
    range.append(element('small', `${fixed(move.published.low, 2)} to ${fixed(move.published.high, 2)}`));
  }
  row.append(
    name, movedCell(move.at_rest_mm, atRest), figureCell(move.soft_per_bone, ratio), range,
    movedCell(move.expression_before_mm, before), movedCell(move.expression_after_mm, after),
  );
}

interface Operated {
  name: string;
  face: number;
  moves: SoftTissueMove[];
  shown: SoftTissueMove[];
  /** What becomes of added volume; empty: none is added. */
  volume: string;
}

/** The variants that change the face at rest. */
function operatedOf(replay: Replay): Operated[] {
  return replay.faces.flatMap(({ name }, face) => {
    const row = variantsOf(replay)?.table.find((one) => one.name === name);
    const [moves, volume] = [softTissueMoves(row), volumeSentence(row)];
    return moves.length > 0 || volume ? [{ name, face, moves, volume, shown: shownMoves(row) }] : [];
  });
}

/** Null where no variant moves bones or adds volume. */
export function surgeryTable(replay: Replay): HTMLElement | null {
  const operated = operatedOf(replay);
  if (operated.length === 0) return null;
  const table = element('table');
  const head = table.createTHead().insertRow();
  head.append(headCell({ key: 'landmark', head: 'Landmark', unit: '', digits: 0, says: '' }), ...columns.map(headCell));
  for (const { name, face, shown, volume } of operated) {
    const body = table.createTBody();
    body.style.setProperty('--face', faceColour(face));
    const title = element('th', name);
    title.scope = 'rowgroup';
    title.colSpan = columns.length + 1;
    if (volume) title.append(element('small', volume));
    body.insertRow().append(title);
    for (const move of shown) rowOf(body, move);
  }
  const axes = ['left', 'up', 'forward'];
  const { card, body: folding } = figureCard('Surgery', [
    'The soft tissue after bones were moved or volume was added. No patient’s operation was compared with it; this is no medical device.',
  ], table, () => [
    ['face', 'landmark', ...[atRest, before, after].flatMap(({ head: what }) => axes.map((axis) => `${what}, ${axis} (mm)`)),
      'of the bone (1)', 'published, usual (1)', 'published, low (1)', 'published, high (1)'],
    ...operated.flatMap(({ name, moves }) => moves.map((move) => [
      name, move.landmark, ...move.at_rest_mm, ...move.expression_before_mm, ...move.expression_after_mm,
      move.soft_per_bone ?? null, move.published?.usual ?? null, move.published?.low ?? null, move.published?.high ?? null,
    ])),
  ]);
  card.classList.add('surgery');
  folding.append(columnNotes(columns));
  return card;
}
