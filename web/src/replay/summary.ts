// SPDX-License-Identifier: GPL-3.0-or-later
// The run's summary (any JSON object) as tables: single values first, a table a nested object.
import { element } from '../page/dom';
import { nameAndUnit, number } from '../page/format';

type Json = Record<string, unknown>;
const isObject = (v: unknown): v is Json => typeof v === 'object' && v !== null && !Array.isArray(v);

function textOf(value: unknown): string {
  if (typeof value === 'number') return number(value);
  if (typeof value === 'boolean') return value ? 'yes' : 'no';
  if (value === null) return '–';
  if (Array.isArray(value)) return value.map(textOf).join(', ');
  return String(value);
}

interface Row {
  key: string;
  name: string;
  unit: string;
  value: unknown;
}

/** A list of objects as one object: each under its name, or its place in the list. */
const byName = (list: unknown[]): Json =>
  Object.fromEntries(list.map((item, i) => {
    if (!isObject(item)) return [String(i + 1), item];
    const { name, point, landmark, ...rest } = item;
    const called = [name, point, landmark].find((v) => typeof v === 'string' && v !== '');
    return [`${i + 1}${called ? ` ${String(called)}` : ''}`, rest];
  }));

/** Nested objects row by row; a unit in an outer key ("distance_mm": {"mean": ...}) goes for the inner. */
function rowsOf(object: Json, outer: Omit<Row, 'value'> = { key: '', name: '', unit: '' }): Row[] {
  return Object.entries(object).flatMap(([key, value]) => {
    const own = nameAndUnit(key.replaceAll('.', ' · '));
    const row = {
      key: outer.key ? `${outer.key}.${key}` : key,
      name: outer.name ? `${outer.name} · ${own.name}` : own.name,
      unit: own.unit || outer.unit,
    };
    if (Array.isArray(value) && value.some(isObject)) return rowsOf(byName(value), row);
    return isObject(value) ? rowsOf(value, row) : [{ ...row, value }];
  });
}

function table(caption: string, rows: Row[]): HTMLElement {
  const card = element('div', '', 'table-card');
  const made = element('table');
  made.createCaption().textContent = caption;
  const body = made.createTBody();
  for (const { key, name, unit, value } of rows) {
    const row = body.insertRow();
    const head = element('th', name);
    head.scope = 'row';
    head.title = key;
    const shown = typeof value === 'number' || Array.isArray(value) ? unit : '';
    row.append(head);
    const cell = row.insertCell();
    cell.textContent = textOf(value) + (shown ? (shown === '°' ? '°' : ` ${shown}`) : '');
    if (typeof value === 'string') cell.className = 'text';
  }
  card.append(made);
  return card;
}

/** What stands elsewhere on the page is left out. */
function restOf({ variants: _variants, notes: _notes, ...summary }: Json): Json {
  if (!isObject(summary.symmetry)) return summary;
  const { excursions: _excursions, ...symmetry } = summary.symmetry;
  return { ...summary, symmetry };
}

export function fillSummary(whole: Json, into: HTMLElement): void {
  const summary = restOf(whole);
  const single = Object.fromEntries(Object.entries(summary).filter(([, value]) => !isObject(value)));
  if (Object.keys(single).length > 0) into.append(table('run', rowsOf(single)));
  for (const [key, value] of Object.entries(summary)) {
    if (!isObject(value)) continue;
    const { name, unit } = nameAndUnit(key);
    const outer = { key: '', name: '', unit: key === 'seconds' ? 's' : unit };
    into.append(table(name, rowsOf(value, outer)));
  }
}
