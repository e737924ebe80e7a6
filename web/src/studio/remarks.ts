// SPDX-License-Identifier: GPL-3.0-or-later
// Remarks of the program on a run, as values with an id (src/hyperex/core/note.hpp). No DOM here.
import { isRecord } from './messages';

export interface Remark {
  /** Stable, for tests and translations: "variant.muscle_hardly_used". */
  id: string;
  severity: 'note' | 'warning';
  /** One English sentence. */
  text: string;
  /** The scene's key that it is about; empty: none. */
  key: string;
  /** The variant that it is about; empty: the scene itself. */
  variant: string;
}

const text = (value: unknown): string => (typeof value === 'string' ? value : '');

/** The remarks of a replay's summary. Older programs send none. */
export function remarksOf(summary: Record<string, unknown>): Remark[] {
  const all = Array.isArray(summary.remarks) ? summary.remarks.filter(isRecord) : [];
  return all.map((one): Remark => ({
    id: text(one.id), severity: one.severity === 'note' ? 'note' : 'warning', text: text(one.text), key: text(one.key), variant: text(one.variant),
  })).filter((remark) => remark.text !== '');
}

/** The sentence in the reader's language, by id; else the program's own. */
export const sentenceOf = (remark: Remark, sentences: Record<string, string>): string => sentences[remark.id] ?? remark.text;

/** The remarks that apply to a face: those on the scene and, for a variant, its own. */
export const holdingFor = (variant: string, remarks: Remark[]): Remark[] =>
  remarks.filter((remark) => remark.variant === '' || remark.variant === variant);

/** The names of muscles.gain whose strengths differ; a missing name means 1. */
export const differingGains = (own: Record<string, number>, base: Record<string, number>): string[] =>
  [...new Set([...Object.keys(own), ...Object.keys(base)])].filter((name) => (own[name] ?? 1) !== (base[name] ?? 1));
