// SPDX-License-Identifier: GPL-3.0-or-later
// Words and numbers as people read them.

/** "−1.50": a true minus sign, as everywhere on the pages. */
export const signed = (text: string): string => text.replace('-', '−');

export function number(value: number): string {
  if (!Number.isFinite(value)) return '–';
  if (Number.isInteger(value)) return value.toLocaleString('en');
  const magnitude = Math.abs(value);
  if (magnitude < 1e-3 || magnitude >= 1e6) return signed(value.toExponential(2));
  return signed(String(Number(value.toPrecision(4))));
}

const units: [string, string][] = [
  ['_pa_s', 'Pa s'], ['_kg_m3', 'kg/m³'], ['_kpa_per_mm', 'kPa/mm'], ['_mm_s', 'mm/s'], ['_kpa', 'kPa'], ['_pa', 'Pa'], ['_mm', 'mm'], ['_deg', '°'],
  ['_hz', 'Hz'], ['_ms', 'ms'], ['_m', 'm'], ['_s', 's'],
];

/** "max_displacement_mm" is "max displacement" in "mm". */
export function nameAndUnit(key: string): { name: string; unit: string } {
  for (const [suffix, unit] of units)
    if (key.endsWith(suffix) && key.length > suffix.length)
      return { name: words(key.slice(0, -suffix.length)), unit };
  return { name: words(key), unit: '' };
}

export const words = (key: string): string => key.replaceAll('_', ' ');

let pointWords: Record<string, string> = {};

/** Sets the plain names of points (src/hyperex/face/point_words.hpp). */
export function usePointWords(given: Record<string, string>): void {
  pointWords = given;
}

/** "ibug68_54" is "corner of the mouth, left"; unknown points keep their names. */
export const landmarkName = (name: string): string => pointWords[name] ?? words(name.replace(/^ibug68_/, 'iBUG '));

/** The words of a known point; any other text as it is. */
export const pointOrText = (text: string): string => pointWords[text] ?? text;

/** Sorts numbers in names by value: 2 before 10. */
export const naturally = new Intl.Collator('en', { numeric: true }).compare;

export const upper = (text: string): string => text.charAt(0).toUpperCase() + text.slice(1);

/** Base is the scene without a variant. */
export const faceWords = (faces: { name: string }[], i: number): string => faces[i].name;

/** "−0.3"; what rounds to nothing has no sign. */
export function fixed(value: number, digits: number): string {
  const text = value.toFixed(digits);
  return signed(Number(text) === 0 ? (0).toFixed(digits) : text);
}
