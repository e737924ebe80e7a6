// SPDX-License-Identifier: GPL-3.0-or-later
// What a variant changes, in words: {"tissue.young_kpa": 1000} is "stiffness 1,000 instead of 192.4 kPa".
import { landmarkName, nameAndUnit, number, upper, words } from '../page/format';
import { boneWords, volumeWords } from './surgery';

type Json = Record<string, unknown>;
const isObject = (v: unknown): v is Json => typeof v === 'object' && v !== null && !Array.isArray(v);

const parameters: Record<string, string> = {
  young: 'stiffness', viscosity: 'viscosity', poisson: 'Poisson’s ratio', density: 'density',
};

function valueWords(value: unknown): string {
  if (typeof value === 'number') return number(value);
  if (typeof value === 'boolean') return value ? 'yes' : 'no';
  if (value === '' || value === null) return 'none';
  if (Array.isArray(value)) return value.length > 0 ? value.map(valueWords).join(', ') : 'none';
  return typeof value === 'string' ? landmarkName(value) : JSON.stringify(value);
}

/** The last part of a key, with its unit. "young_kpa" is "stiffness" in "kPa". */
function keyWords(key: string): { name: string; unit: string } {
  const { name, unit } = nameAndUnit(key);
  return { name: parameters[name] ?? name, unit };
}

const withUnit = (text: string, unit: string): string => (unit ? `${text} ${unit}` : text);

/** One change of one part of the face: {"name": "cheek_R", "young_factor": 10, "volume_ml": 2} is "cheek R: stiffness
 *  × 10, 2 ml added". */
function placeWords(entry: Json): string {
  const { name, landmark, point, side, scar, painted, ...rest } = entry;
  const place = Array.isArray(scar) && scar.length > 0
    ? `scar ${scar.map((at) => landmarkName(String(at))).join(' to ')}`
    : typeof painted === 'string' && painted !== '' ? 'painted patch'
    : [name, landmark, point, side].filter((v) => typeof v === 'string' && v !== '').map((v) => landmarkName(String(v))).join(' ');
  const what = Object.entries(rest).map(([key, value]) => {
    const factor = /^(\w+)_factor$/.exec(key)?.[1];
    if (key === 'volume_ml' && typeof value === 'number') return volumeWords(value);
    if (factor && parameters[factor]) return `${parameters[factor]} × ${valueWords(value)}`;
    const { name: word, unit } = keyWords(key);
    return `${word} ${withUnit(valueWords(value), unit)}`;
  });
  return [upper(place), what.join(', ')].filter(Boolean).join(': ');
}

const branches = new Set(['temporal', 'zygomatic', 'buccal', 'mandibular', 'cervical']);

/** The Latin name of a muscle without side: "zygomaticus major" for "zyg_major". "" for any other name. */
export type LatinOf = (stem: string) => string;

/** What a gain of muscles names: {"side_R": 0.3} is "muscles of the right side at 30 %". */
function gainWords([name, gain]: [string, unknown], latinOf: LatinOf): string {
  const [, stem, side] = /^(\w+)_([LR])$/.exec(name) ?? [null, name, ''];
  const of = side === 'R' ? 'right' : side === 'L' ? 'left' : '';
  const what = stem === 'side' ? `muscles of the ${of} side`
    : branches.has(stem) ? `${of} muscles of the ${stem} branch` : `${of} ${latinOf(stem) || words(stem)}`;
  return upper(`${what} at ${typeof gain === 'number' ? number(Number((100 * gain).toPrecision(4))) : String(gain)} %`.trim());
}

function baseValue(options: unknown, path: string[]): unknown {
  return path.reduce<unknown>((at, key) => (isObject(at) ? at[key] : undefined), options);
}

/** A sentence each. `changes`: dotted key and new value; `options`: those of base, nested. */
export function changeWords(changes: Json, options: unknown, latinOf: LatinOf): string[] {
  return Object.entries(changes).flatMap(([path, value]) => {
    const parts = path.split('.');
    const last = parts.pop()!;
    if (path === 'surgery.bone' && Array.isArray(value)) return value.filter(isObject).map((row) => upper(boneWords(row)));
    if (Array.isArray(value) && value.some(isObject)) return value.filter(isObject).map(placeWords);
    if (path === 'muscles.gain' && isObject(value)) return Object.entries(value).map((gain) => gainWords(gain, latinOf));
    const { name, unit } = keyWords(last);
    // The tissue's parameters need no section.
    const room = parts[0] === 'tissue' ? '' : `${parts.join(' ')}: `;
    const before = baseValue(options, [...parts, last]);
    if (before === value) return []; // changes nothing
    const instead = before === undefined || Array.isArray(before) ? '' : ` instead of ${valueWords(before)}`;
    return [upper(`${room}${name} ${withUnit(valueWords(value) + instead, unit)}`)];
  });
}
