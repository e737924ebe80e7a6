// SPDX-License-Identifier: GPL-3.0-or-later
// A table of figures in its card: heading, lines above it, a way to take it along, notes on its columns.
import './tables.css';
import { signed } from './format';
import { csvFile, fileName, save } from './save';

export interface Column {
  key: string;
  head: string;
  unit: string;
  /** After the point: alike in a column, so that its figures stand under each other. */
  digits: number;
  /** Shown = value * factor. */
  factor?: number;
  /** What it is, a short sentence. */
  says: string;
}

export const isNumber = (v: unknown): v is number => typeof v === 'number' && Number.isFinite(v);

/** An en dash where there is none. */
export function figureText(value: unknown, { digits, factor = 1 }: Column): string {
  if (!isNumber(value)) return '–';
  const text = (value * factor).toFixed(digits);
  return Number(text) === 0 ? text.replace('-', '') : signed(text);
}

export function figureCell(value: unknown, column: Column): HTMLTableCellElement {
  const cell = document.createElement('td');
  cell.textContent = figureText(value, column);
  if (isNumber(value)) cell.title = signed(`${Number((value * (column.factor ?? 1)).toPrecision(6))} ${column.unit}`.trim());
  else cell.title = 'not defined';
  return cell;
}

export function headCell({ head, unit, says }: Column): HTMLTableCellElement {
  const cell = document.createElement('th');
  cell.scope = 'col';
  cell.title = says;
  cell.append(head);
  if (unit) {
    const small = document.createElement('small');
    small.textContent = unit;
    cell.append(small);
  }
  return cell;
}

/** What each column is, under the table. */
export function columnNotes(columns: Pick<Column, 'head' | 'says'>[]): HTMLElement {
  const list = document.createElement('dl');
  list.className = 'column-notes';
  for (const { head, says } of columns) {
    const pair = document.createElement('div');
    const name = document.createElement('dt');
    name.textContent = head;
    const text = document.createElement('dd');
    text.textContent = says;
    pair.append(name, text);
    list.append(pair);
  }
  return list;
}

/** The card; `rows` gives all figures, not rounded, with their names and units in the first row. */
export function figureCard(
  title: string, lines: string[], table: HTMLTableElement, rows: () => (string | number | null)[][],
): HTMLElement {
  const card = document.createElement('article');
  card.className = 'figures';
  const head = document.createElement('div');
  head.className = 'figures-head';
  const name = document.createElement('h2');
  name.textContent = title;
  const tools = document.createElement('span');
  tools.className = 'table-tools';
  const button = document.createElement('button');
  button.type = 'button';
  button.className = 'quiet';
  button.textContent = 'CSV';
  button.title = 'Save the table, figures not rounded';
  button.setAttribute('aria-label', `CSV: ${button.title} (${title})`);
  button.addEventListener('click', () => save(csvFile(rows()), fileName(document.title, title, 'csv')));
  tools.append(button);
  head.append(name, tools);
  card.append(head);
  for (const line of lines) {
    const text = document.createElement('p');
    text.textContent = line;
    card.append(text);
  }
  const caption = table.createCaption();
  caption.textContent = title;
  caption.className = 'unseen'; // the heading says the same
  // Wider than a telephone: it is scrolled in its card, also by keys.
  const scroller = document.createElement('div');
  scroller.className = 'scroller';
  scroller.tabIndex = 0;
  scroller.setAttribute('role', 'region');
  scroller.setAttribute('aria-label', title);
  scroller.append(table);
  card.append(scroller);
  return card;
}
