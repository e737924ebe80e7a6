// SPDX-License-Identifier: GPL-3.0-or-later
// Downloads of files that the page makes.
import { button } from './dom';

/** The name of what the page shows, for pictures and files: its title, or a name set instead. */
export const subject = (): string => document.documentElement.dataset.subject ?? document.title;

/** "Smile, left", "Point tracks", "csv" is "smile-left-point-tracks.csv". */
export function fileName(...parts: string[]): string {
  const ending = parts.pop()!;
  const name = parts.join(' ').toLowerCase().replace(/[^\p{L}\p{N}]+/gu, '-').replace(/^-+|-+$/g, '');
  return `${name}.${ending}`;
}

export function save(content: Blob, name: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  // The browser has read it by then.
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** `what`: name of the file's contents, for screen readers. */
export function saveButton(name: string, says: string, what: string, press: () => void): HTMLButtonElement {
  const made = button(name, 'quiet', press);
  made.title = says;
  made.setAttribute('aria-label', `${name}: ${says} (${what})`);
  return made;
}

/** One row of a CSV file (RFC 4180). */
const csvRow = (cells: (string | number | null)[]): string =>
  cells.map((cell) => {
    const text = cell === null ? '' : String(cell);
    return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  }).join(',');

/** Empty where there is no number. */
export const csvFile = (rows: (string | number | null)[][]): Blob =>
  new Blob([`${rows.map(csvRow).join('\r\n')}\r\n`], { type: 'text/csv' });
