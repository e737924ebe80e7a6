// SPDX-License-Identifier: GPL-3.0-or-later
// The variants side by side in figures (summary.variants); pressing a name shows that face.
import type { Replay } from '../data';
import { button, element, unbroken } from '../../page/dom';
import type { Undoing } from '../../page/listeners';
import { chooseFace } from '../face/face_chooser';
import { faceColour } from '../../page/face_colour';
import { columnNotes, figureCard, figureCell, figureText, headCell, isNumber, type Column } from './figure_table';
import { landmarkName } from '../../page/format';
import { farthestSentences } from '../farthest';
import type { Shown } from '../shown';
import { changesOf, variantsOf, type VariantRow, type Variants } from '../variants';

const columns: Column[] = [
  {
    key: 'greatest_displacement_mm', head: 'Greatest displacement', unit: 'mm', digits: 2,
    says: 'how far the skin goes from rest at most, anywhere and at any time.',
  },
  {
    key: 'greatest_distance_mm', head: 'Greatest distance', unit: 'mm', digits: 2,
    says: 'from the unchanged face: how far the same point of the skin is from where it is there at the same time, at most.',
  },
  {
    key: 'rms_distance_at_peak_mm', head: 'Distance at peak', unit: 'mm, rms', digits: 3,
    says: 'root mean square of that distance over the skin, in the frame of the peak.',
  },
  {
    key: 'mean_displacement_R_mm', head: 'Right side', unit: 'mm, mean', digits: 2,
    says: 'how far the face right of the middle has moved in that frame, on average over its area; the subject’s own right.',
  },
  {
    key: 'mean_displacement_L_mm', head: 'Left side', unit: 'mm, mean', digits: 2,
    says: 'the same left of the middle.',
  },
  {
    key: 'asymmetry_rms_mm', head: 'Asymmetry', unit: 'mm, rms', digits: 2,
    says: 'the face against its own reflection in that frame, asymmetry at rest taken out, root mean square over the face.',
  },
  {
    key: 'added_xi_difference', head: 'Added ξL − ξR', unit: '1', digits: 4,
    says: 'what the variant adds to ξL − ξR where it adds most: the tissue alone. Below its floor, which is what the mesh alone can make of it, it is undecided.',
  },
  {
    key: 'share_within_25_mm_of_mouth', head: 'Near the mouth', unit: '%', digits: 1, factor: 100,
    says: 'share of the summed squared distance, weighted by area, within 25 mm of the outline of the lips.',
  },
  {
    key: 'lag_ms', head: 'Lag', unit: 'ms', digits: 2,
    says: 'time by which the response trails the input, where both correlate best; found to fractions of a step. What base has comes from the way the skin takes; the tissue makes the difference between rows.',
  },
  {
    key: 'hysteresis', head: 'Hysteresis', unit: '1', digits: 4,
    says: 'area enclosed by the curve of response over input, over that of its bounding box; 0 where the response depends on the input alone.',
  },
  {
    key: 'symmetry_integral_s', head: 'Symmetry integral', unit: 's', digits: 4,
    says: '|ξL − ξR| summed over time; smaller where both sides stretch more alike. As S it does not say which face moves more evenly in mm, and grades no palsy.',
  },
];
const insideOut: Column = {
  key: 'inverted_tets', head: 'Inside out', unit: 'elements', digits: 0,
  says: 'tetrahedra turned inside out in some frame: there the motion is too large for the model.',
};

function linesOf({ driven_point, response_point, table }: Variants): (string | HTMLElement)[] {
  const points = driven_point && response_point
    ? [`Input of lag and hysteresis: ${landmarkName(driven_point)}, the driven point that moves most; response: ` +
       `${landmarkName(response_point)}, which moves most of those off the driven patches.`]
    : [];
  const decided = table.some((row) => isNumber(row.added_xi_floor))
    ? 'What a variant adds to ξL − ξR is undecided below its floor, which is what the mesh alone can make of it; jitter is not in that floor.'
    : 'What the mesh alone adds to ξL − ξR is not known, so a small added difference is undecided.';
  const jitter = 'All faces follow the same recording, and so they share its jitter. A changed face scales it: the ± of a change of the corners holds that part' +
    (table.some((row) => row.jitter_known === false) ? '. Here the jitter is not known, and the program cannot tell whether it makes such a change.' : '.');
  const first = element('p', 'Each variant against the unchanged face, base.');
  first.append(element('span', ' Press a name to see that face.', 'not-printed'));
  return [first, ...points, jitter, decided];
}

/** Enough decimals for two significant digits of the column's largest figure. */
function fitted(column: Column, rows: VariantRow[]): Column {
  const most = Math.max(...rows.map((row) => Math.abs(Number(row[column.key] ?? 0)) * (column.factor ?? 1)));
  if (!(most > 0) || column.digits === 0) return column;
  return { ...column, digits: Math.min(Math.max(column.digits, 1 - Math.floor(Math.log10(most))), 9) };
}

/** Stands below what a variant adds to ξL − ξR. */
function floorOf({ added_xi_floor: floor, added_xi_decided: decided }: VariantRow, column: Column): HTMLElement {
  const text = `floor ${figureText(floor, column)}`;
  return decided === 0 ? element('small', `undecided, ${text}`, 'undecided') : element('small', text);
}

function nameCell(
  replay: Replay, row: VariantRow, i: number, press: () => void,
): { cell: HTMLElement; face: HTMLButtonElement } {
  const cell = element('th');
  cell.scope = 'row';
  const face = button('', 'face', press);
  face.title = 'Show this face';
  face.append(element('i'), replay.faces[i].name);
  const changes = i === 0 ? ['the scene without a variant'] : [...changesOf(replay, i), ...farthestSentences(replay, i, row)];
  cell.append(face, ...changes.map((change) => {
    const line = element('small');
    line.append(...unbroken(change));
    return line;
  }));
  return { cell, face };
}

/** Null without variants. */
export function variantsTable(replay: Replay, shown: Shown, undoing: Undoing): HTMLElement | null {
  const variants = variantsOf(replay);
  if (!variants) return null;
  const rows: VariantRow[] = replay.faces.flatMap(({ name }, i) => {
    const row = variants.table.find((r) => r.name === name);
    return row ? [i === 0 ? { inverted_tets: replay.summary.inverted_tets as number, ...row } : row] : [];
  });
  if (rows.length < replay.faces.length) return null;
  const turned = rows.some((row) => (row.inverted_tets ?? 0) > 0) ? [insideOut] : [];
  const used = [...columns, ...turned].map((column) => fitted(column, rows));

  const table = element('table');
  const head = table.createTHead().insertRow();
  head.append(headCell({ key: 'name', head: 'Face', unit: '', digits: 0, says: 'Press a name to see that face' }));
  head.append(...used.map(headCell));
  const body = table.createTBody();
  const most = used.map(({ key }) => Math.max(...rows.map((row) => Math.abs(Number(row[key] ?? 0)))));
  const buttons = rows.map((row, i) => {
    const line = body.insertRow();
    line.style.setProperty('--face', faceColour(i));
    const { cell, face } = nameCell(replay, row, i, () => chooseFace(shown, i));
    line.append(cell);
    used.forEach((column, c) => {
      const made = figureCell(row[column.key], column);
      const value = row[column.key];
      if (column.key === 'added_xi_difference' && i > 0 && isNumber(row.added_xi_floor)) {
        made.append(floorOf(row, column));
        if (row.added_xi_decided === 0) {
          line.append(made);
          return;
        }
      }
      if (column !== insideOut) made.className = 'quantity';
      if (isNumber(value) && most[c] > 0) made.style.setProperty('--share', String(Math.abs(value) / most[c]));
      line.append(made);
    });
    return face;
  });
  const show = () => buttons.forEach((face, i) => {
    const visible = shown.visible.includes(i);
    face.setAttribute('aria-pressed', String(visible));
    face.closest('tr')!.classList.toggle('shown', visible);
  });
  undoing.add(shown.onChange(show));
  show();
  const { card, body: folding } = figureCard('Variants', linesOf(variants), table, () => [
    ['face', 'what differs', ...used.map(({ head: name, unit }) => `${name} (${unit})`), 'Floor of what is added to ξL − ξR (1)'],
    ...rows.map((row, i) => [
      row.name, changesOf(replay, i).join('; '),
      ...used.map(({ key, factor = 1 }) => (isNumber(row[key]) ? row[key] * factor : null)),
      isNumber(row.added_xi_floor) ? row.added_xi_floor : null,
    ]),
  ]);
  card.classList.add('variants');
  folding.append(columnNotes(used));
  return card;
}
