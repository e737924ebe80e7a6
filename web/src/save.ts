// SPDX-License-Identifier: GPL-3.0-or-later
// Hands files that the page makes to the reader.

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
  // The browser has taken it by then.
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
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
