// SPDX-License-Identifier: GPL-3.0-or-later
// The table of measures: each visit's value, then the change of the chosen visit against the first.
import { element } from '../page/dom';
import { sideHint, sideLetter } from '../page/side_words';
import type { Choice } from './choice';
import { changeFigure, grouped, valueFigure, type Figure } from './figures';
import type { Change, Manifest, Measure, Part } from './manifest';

const partWords: Record<Part, string> = {
  repetition: 'repetition', jitter: 'tracking jitter', 'head pose': 'head pose', axes: 'axes of the face', landmarks: 'landmarks on the scan',
};

function head(text: string | Node[], className = ''): HTMLTableCellElement {
  const cell = element('th', '', className);
  cell.append(...(typeof text === 'string' ? [text] : text));
  cell.scope = 'col';
  return cell;
}

/** A date is not broken at its hyphens; a long label is. */
const labelOf = (label: string): HTMLElement => element('span', label, label.length <= 14 ? 'unbroken' : '');

function figureCell(figure: Figure | null, className: string, without = 'not measured'): HTMLTableCellElement {
  if (!figure) {
    const cell = element('td', '', className);
    cell.append(element('span', without, 'undecided'));
    return cell;
  }
  const cell = element('td', '', className);
  cell.append(element('span', figure.value, 'value'), ' ', element('span', `(${figure.interval})`, 'interval'));
  return cell;
}

/** Words over both sides, and the side. */
function rowHeads(measure: Measure, group: Measure[], place: number): HTMLTableCellElement[] {
  const cells: HTMLTableCellElement[] = [];
  if (place === 0) {
    const name = element('th', measure.words, 'name');
    name.append(' ', element('span', `(${measure.unit})`, 'unit'));
    name.scope = group.length > 1 ? 'rowgroup' : 'row';
    name.rowSpan = group.length;
    if (!measure.side) name.colSpan = 2;
    cells.push(name);
  }
  if (measure.side) {
    const side = element('th', '', `side ${measure.side === 'R' ? 'right' : 'left'}`);
    side.scope = 'row';
    side.title = sideHint(measure.side);
    side.append(element('i'), sideLetter(measure.side));
    cells.push(side);
  }
  return cells;
}

/** Beside two values that are not compared their change is missing, too; the notes say why. */
function changeCells(change: Change | null, { unit, values }: Measure, visit: number): HTMLTableCellElement[] {
  if (!change) return [figureCell(null, 'change', values[0] && values[visit] ? 'not compared' : 'not measured'), element('td', '', 'measured'), element('td', '', 'verdict'), element('td', '', 'part')];
  const figure = changeFigure(change, unit);
  const verdict = element('td', change.doubtful ? `${change.beyond}, doubtful` : change.beyond, 'verdict');
  verdict.dataset.beyond = change.doubtful ? 'doubtful' : change.beyond;
  const over = figureCell(figure, 'change');
  over.title = `By measurement alone: ${figure.measured}`;
  return [over, element('td', figure.measured, 'measured'), verdict, element('td', partWords[change.largest] ?? change.largest, 'part')];
}

/** The part that all intervals of a visit's changes mostly come from; null: they differ, or there is one alone. */
function onlyPart(measures: Measure[], visit: number): Part | null {
  const parts = measures.flatMap(({ changes }) => changes[visit]?.largest ?? []);
  return parts.length > 1 && parts.every((part) => part === parts[0]) ? parts[0] : null;
}

/** As in the style sheet. */
const narrow = window.matchMedia('(max-width: 600px)');

/** A telephone shows the answer first: the change and its verdict, then the values. One visit has no changes. */
function inOrder(values: HTMLElement[], changes: HTMLElement[]): HTMLElement[] {
  const [change, measured, verdict, ...part] = changes;
  return narrow.matches && change ? [change, verdict, ...values, measured, ...part] : [...values, ...changes];
}

export class MeasureTable {
  private readonly box = element('div', '', 'table-box');

  constructor(host: HTMLElement, private readonly manifest: Manifest, private readonly choice: Choice) {
    const top = element('div', '', 'measures-head');
    top.append(element('h2', 'Measures at the peak'));
    if (manifest.visits.length > 2) top.append(this.chooser());
    this.box.tabIndex = 0;
    this.box.setAttribute('role', 'group');
    this.box.setAttribute('aria-label', 'Table of measures');
    host.append(top, this.box);
    choice.onChange(() => this.show());
    narrow.addEventListener('change', () => this.show());
  }

  private chooser(): HTMLElement {
    const label = element('label', `Compared with ${this.manifest.visits[0].label}: `, 'compared');
    const select = element('select');
    select.id = 'compared';
    this.manifest.visits.forEach((visit, i) => {
      if (i > 0) select.append(new Option(visit.label, String(i), false, i === this.choice.visit));
    });
    select.addEventListener('change', () => this.choice.choose(Number(select.value)));
    label.append(select);
    return label;
  }

  /** On paper and in narrow windows more than three visits have no room: the first and the chosen one stand there. */
  private columnClass(visit: number): string {
    const { length } = this.manifest.visits;
    return length > 3 && visit > 0 && visit !== this.choice.visit ? 'set-aside' : '';
  }

  private onlyPart(): Part | null {
    return onlyPart(this.manifest.measures, this.choice.visit);
  }

  private heads(): HTMLTableRowElement {
    const { visits } = this.manifest;
    const row = element('tr');
    const name = head('Measure', 'name');
    name.colSpan = 2;
    const values = visits.map(({ label }, visit) => head([labelOf(label)], this.columnClass(visit)));
    const changes = visits.length > 1 ? [
      head([new Text('Change, '), labelOf(visits[this.choice.visit].label), new Text(' against '), labelOf(visits[0].label)], 'change'), head('By measurement alone', 'measured'),
      head('Beyond what measurement and repetition make', 'verdict'), ...(this.onlyPart() ? [] : [head('Interval mostly from', 'part')]),
    ] : [];
    row.append(name, ...inOrder(values, changes));
    return row;
  }

  private row(measure: Measure, group: Measure[], place: number): HTMLTableRowElement {
    const { visits } = this.manifest;
    const change = measure.changes[this.choice.visit] ?? null;
    const row = element('tr', '', change?.beyond === 'yes' && !change.doubtful ? 'beyond' : '');
    const values = visits.map((_, visit) => {
      const value = measure.values[visit] ?? null;
      return figureCell(value && valueFigure(value, measure.unit), this.columnClass(visit));
    });
    const changes = visits.length > 1 ? changeCells(change, measure, this.choice.visit) : [];
    if (this.onlyPart()) changes.splice(3);
    row.append(...rowHeads(measure, group, place), ...inOrder(values, changes));
    return row;
  }

  show(): void {
    const table = element('table', '', this.manifest.visits.length > 3 ? 'many' : '');
    const top = element('thead');
    top.append(this.heads());
    table.append(top, ...grouped(this.manifest.measures).map((group) => {
      const body = element('tbody');
      body.append(...group.map((measure, place) => this.row(measure, group, place)));
      return body;
    }));
    const only = this.onlyPart();
    this.box.replaceChildren(table, ...(only ? [element('p', `All intervals of the changes come mostly from ${partWords[only] ?? only}.`, 'all-from')] : []));
  }
}
