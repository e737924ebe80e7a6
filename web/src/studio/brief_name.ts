// SPDX-License-Identifier: GPL-3.0-or-later
// A short name of a face from its changes: {"muscles.gain": {"side_R": 0.4}} is "right side 40 %". Names given by the
// user are kept. No DOM here.
import { boneWords, volumeWords } from '../replay/surgery';
import { isRecord, type MuscleInfo, type Values } from './messages';
import { words } from './words';

/** Greatest number of changes named. */
const mostParts = 2;
const longest = 56; // a number may follow

const percent = (share: unknown): string => `${Number((100 * Number(share)).toPrecision(3))} %`;
const times = (factor: unknown): string => `${Number(Number(factor).toPrecision(3))} x`;
const lower = (text: string): string => text.charAt(0).toLowerCase() + text.slice(1);

/** "side_R" is "right side". */
function gainName(name: string, muscles: MuscleInfo[]): string {
  const [, stem, side] = /^(\w+)_([LR])$/.exec(name) ?? [null, name, ''];
  if (!side) return stem.replaceAll('_', ' ');
  const sideName = words.sideNames[side as 'L' | 'R'];
  if (stem === 'side') return lower(words.weakerSide(sideName));
  const latin = muscles.find((muscle) => muscle.name === stem)?.latin;
  return lower(words.ofSide(latin ?? words.branchNames[stem] ?? stem.replaceAll('_', ' '), sideName));
}

/** The same in a sentence: "zygomatic_R" is "right zygomatic branch". */
function gainPhrase(name: string, muscles: MuscleInfo[]): string {
  const [, stem, side] = /^(\w+)_([LR])$/.exec(name) ?? [null, name, ''];
  const latin = muscles.find((muscle) => muscle.name === stem)?.latin;
  const branch = !latin && words.branchNames[stem];
  if (!side || (!latin && !branch)) return gainName(name, muscles);
  return words.sideFirst(lower(latin ?? words.weakerBranch(branch || stem)), words.sideNames[side as 'L' | 'R']);
}

/** A part of the face whose tissue differs: "cheek, right 5 x", "cheek, left: 2 ml added". */
function regionName(row: Record<string, unknown>): string {
  const [, stem, side] = /^(\w+?)(?:_([LR]))?$/.exec(String(row.name ?? '')) ?? [null, '', ''];
  const part = stem.replaceAll('_', ' ');
  const place = row.scar ? words.paintScar
    : row.painted ? words.nameOfPatch
      : side ? words.ofSide(part, words.sideNames[side as 'L' | 'R']) : part;
  const factor = row.young_factor ?? row.viscosity_factor;
  const stiffness = factor === undefined ? '' : times(factor);
  const { volume_ml: ml } = row;
  if (!ml) return [lower(place), stiffness].filter(Boolean).join(' ');
  return `${lower(place)}: ${[stiffness, volumeWords(Number(ml))].filter(Boolean).join(', ')}`;
}

/** One change of a face: a part of its name, and of the question that it asks. */
export interface NamedChange {
  key: string;
  text: string;
  /** For a change of muscles.gain: the key of the side, branch or muscle whose strength changed, as "side_R". */
  gain?: string;
  /** The same in plain words. */
  of?: string;
  /** Of tissue.region and surgery.bone: its place in the list. */
  row?: number;
}

function changesOfKey(key: string, value: unknown, base: unknown, muscles: MuscleInfo[]): NamedChange[] {
  if (value === null || value === undefined || JSON.stringify(value) === JSON.stringify(base)) return [];
  if (key === 'muscles.gain' && isRecord(value))
    return Object.entries(value)
      .filter(([name, gain]) => gain !== (isRecord(base) ? (base[name] ?? 1) : 1))
      .map(([gain, share]) => ({ key, gain, of: gainPhrase(gain, muscles), text: `${gainName(gain, muscles)} ${percent(share)}` }));
  if (key === 'tissue.region' && Array.isArray(value)) return value.filter(isRecord).map((one, row) => ({ key, row, text: regionName(one) }));
  if (key === 'surgery.bone' && Array.isArray(value)) return value.filter(isRecord).map((one, row) => ({ key, row, text: boneWords(one) }));
  if (key === 'motion.gain') return [{ key, text: `${lower(words.keyNames[key])} ${percent(value)}` }];
  if (typeof value === 'object') return [{ key, text: key.replace(/^.*\./, '').replaceAll('_', ' ') }];
  const unit = words.nameUnits[key] ?? '';
  const shown = typeof value === 'number' ? String(Number(value.toPrecision(4))) : String(value);
  return [{ key, text: [words.briefNames[key] ?? key.replace(/^.*\./, '').replaceAll('_', ' '), shown, unit].filter(Boolean).join(' ') }];
}

/** The changes of a face, one by one. */
export const namedChanges = (changes: Values, base: Values, muscles: MuscleInfo[]): NamedChange[] =>
  Object.entries(changes).flatMap(([key, value]) => changesOfKey(key, value, base[key], muscles));

/** Contains only characters allowed in a face's name; empty where nothing is changed. */
export function briefName(changes: Values, base: Values, muscles: MuscleInfo[]): string {
  const all = namedChanges(changes, base, muscles).map(({ text }) => text);
  const more = all.length - mostParts;
  const name = [...all.slice(0, mostParts), ...(more > 0 ? [words.nameMore(more)] : [])].join('; ');
  return name.normalize('NFD').replace(/[^A-Za-z0-9 \-_.,;:+=%&'()[\]]/g, '').slice(0, longest).trim();
}

/** Whether a name was made from the changes, or is the first default: "What if 2", "right side 40 % 2". */
export function isBriefName(name: string, changes: Values, base: Values, muscles: MuscleInfo[]): boolean {
  const own = briefName(changes, base, muscles) || words.newVariant;
  return [own, words.newVariant].some((one) => name === one || (name.startsWith(`${one} `) && /^\d+$/.test(name.slice(one.length + 1))));
}
