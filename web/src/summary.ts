// SPDX-License-Identifier: GPL-3.0-or-later
// The run's summary (any JSON object) as tables: single values first, a table a nested object.
import { nameAndUnit, number, words } from './format';

type Json = Record<string, unknown>;
const isObject = (v: unknown): v is Json => typeof v === 'object' && v !== null && !Array.isArray(v);

function textOf(value: unknown): string {
  if (typeof value === 'number') return number(value);
  if (typeof value === 'boolean') return value ? 'yes' : 'no';
  if (value === null) return '–';
  if (Array.isArray(value)) return value.map(textOf).join(', ');
  return String(value);
}

function rowsOf(object: Json, prefix = ''): [string, unknown][] {
  return Object.entries(object).flatMap(([key, value]) =>
    isObject(value) ? rowsOf(value, `${prefix}${key}.`) : [[prefix + key, value] as [string, unknown]],
  );
}

function table(caption: string, rows: [string, unknown][], unitOfAll = ''): HTMLElement {
  const card = document.createElement('div');
  card.className = 'table-card';
  const element = document.createElement('table');
  element.createCaption().textContent = caption;
  const body = element.createTBody();
  for (const [key, value] of rows) {
    const row = body.insertRow();
    const head = document.createElement('th');
    head.scope = 'row';
    const { name, unit } = nameAndUnit(key.replaceAll('.', ' · '));
    head.textContent = name;
    head.title = key;
    const shown = typeof value === 'number' || Array.isArray(value) ? unit || unitOfAll : '';
    const cell = row.appendChild(head).parentElement!.appendChild(document.createElement('td'));
    cell.textContent = textOf(value) + (shown ? (shown === '°' ? '°' : ` ${shown}`) : '');
    if (typeof value === 'string') cell.className = 'text';
  }
  card.append(element);
  return card;
}

export function fillSummary(summary: Json, into: HTMLElement): void {
  const single = Object.entries(summary).filter(([, value]) => !isObject(value));
  if (single.length > 0) into.append(table('run', single));
  for (const [key, value] of Object.entries(summary)) {
    if (!isObject(value)) continue;
    const { name, unit } = nameAndUnit(key);
    into.append(table(words(name), rowsOf(value), key === 'seconds' ? 's' : unit));
  }
}
