// SPDX-License-Identifier: GPL-3.0-or-later
// A table of figures in its card: heading, lines above it, a button to save it, notes on its columns.
import './tables.css';
import { element } from '../../page/dom';
import { signed } from '../../page/format';
import { csvFile, fileName, save, saveButton, subject } from '../../page/save';

export interface Column {
  key: string;
  head: string;
  unit: string;
  /** Decimals, the same in a column, so that its figures are aligned. */
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
  const cell = element('td', figureText(value, column));
  if (isNumber(value)) cell.title = signed(`${Number((value * (column.factor ?? 1)).toPrecision(6))} ${column.unit}`.trim());
  else cell.title = 'not defined';
  return cell;
}

export function headCell({ head, unit, says }: Column): HTMLTableCellElement {
  const cell = element('th', head);
  cell.scope = 'col';
  cell.title = says;
  if (unit) cell.append(element('small', unit));
  return cell;
}

/** Explanations of the columns, on demand. */
export function columnNotes(columns: Pick<Column, 'head' | 'says'>[]): HTMLElement {
  const details = element('details', '', 'column-help');
  const list = element('dl', '', 'column-notes');
  for (const { head, says } of columns) {
    const pair = element('div');
    pair.append(element('dt', head), element('dd', says));
    list.append(pair);
  }
  details.append(element('summary', 'What the columns mean'), list);
  return details;
}

/** Where there is little room tables open on demand. */
const roomy = () => !window.matchMedia('(max-width: 700px)').matches;

/** The card and its foldable part; `rows` returns all figures, not rounded, with their names and units in the first
 *  row. */
export function figureCard(
  title: string, lines: (string | HTMLElement)[], table: HTMLTableElement, rows: () => (string | number | null)[][],
): { card: HTMLElement; body: HTMLElement } {
  const card = element('article', '', 'figures');
  const body = element('details');
  body.open = roomy();
  const head = element('summary');
  const tools = element('span', '', 'table-tools');
  const saveTable = () => save(csvFile(rows()), fileName(subject(), title, 'csv'));
  tools.append(saveButton('CSV', 'Save the table, figures not rounded', title, saveTable));
  head.append(element('h2', title));
  body.append(head, ...lines.map((line) => (typeof line === 'string' ? element('p', line) : line)));
  const caption = table.createCaption();
  caption.textContent = title;
  caption.className = 'unseen'; // the heading says the same
  // Wider than a telephone: it is scrolled in its card, also by keys.
  const scroller = element('div', '', 'scroller');
  scroller.tabIndex = 0;
  scroller.setAttribute('role', 'region');
  scroller.setAttribute('aria-label', title);
  scroller.append(table);
  body.append(element('p', 'More columns to the right: scroll the table, or use the arrow keys in it.', 'more-columns'), scroller);
  const sizes = new ResizeObserver(() => body.classList.toggle('wider', scroller.scrollWidth > scroller.clientWidth + 1));
  sizes.observe(scroller);
  sizes.observe(table);
  card.append(body, tools);
  return { card, body };
}
