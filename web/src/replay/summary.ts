// SPDX-License-Identifier: GPL-3.0-or-later
// The run's summary: notes, warnings first; the main figures in groups; all others, and the options, on demand. Empty
// parts are left out.
import { element } from '../page/dom';
import { landmarkName, nameAndUnit, number, pointOrText, upper } from '../page/format';

type Json = Record<string, unknown>;
const isObject = (v: unknown): v is Json => typeof v === 'object' && v !== null && !Array.isArray(v);

interface Row {
  key: string;
  name: string;
  unit: string;
  value: unknown;
}

/** Dotted keys of the figures that matter, with names where the key's own words do not say it. */
const groups: [title: string, rows: [key: string, name: string, unit?: string][]][] = [
  ['Motion', [
    ['frames', 'Frames'],
    ['peak_time_s', 'Peak (driven points moved most)', 's'],
    ['max_displacement_mm', 'Largest displacement of the skin', 'mm'],
    ['lip_opening_mm', 'Lips open by', 'mm'],
    ['lip_overlap_mm', 'Lips pass through each other by', 'mm'],
    ['jaw_opening_deg', 'Jaw opens by', '°'],
    ['head_shift_uncertainty_mm', 'Head’s place known to (95 %)', 'mm'],
    ['head_turn_uncertainty_deg', 'Head’s turn known to (95 %)', '°'],
  ]],
  ['Symmetry', [
    ['symmetry.verdict', 'Verdict on ξ'],
    ['symmetry.lowpass_hz', 'Speeds low-pass filtered at', 'Hz'],
    ['symmetry.S_most', 'Largest S'],
    ['symmetry.S_most_at_s', 'at', 's'],
    ['symmetry.undecided_samples', 'Undecided samples'],
    ['symmetry.samples', 'of'],
    ['symmetry.asymmetry_map.worst_face_rms_mm', 'Asymmetry of the face at most (rms)', 'mm'],
    ['symmetry.asymmetry_map.mesh_floor_face_rms_mm', 'of which the mesh alone makes', 'mm'],
    ['symmetry.asymmetry_map.rest_rms_mm', 'Asymmetry at rest, taken out (rms)', 'mm'],
  ]],
  ['Tissue at the peak', [
    ['at_peak.von_mises_stress_kpa.median', 'Von Mises stress, median', 'kPa'],
    ['at_peak.von_mises_stress_kpa.p95', '95 % of the tissue below', 'kPa'],
    ['at_peak.von_mises_stress_kpa.p99', '99 % below', 'kPa'],
    ['at_peak.von_mises_max_over_p99', 'Largest stress, of the 99 %'],
    ['at_peak.greatest_principal_strain.p95', 'Largest principal strain, 95 % below'],
    ['at_peak.greatest_principal_stretch.p95', 'Largest principal stretch, 95 % below'],
    ['at_peak.volume_ratio.min', 'Least ratio of volumes of an element'],
  ]],
  ['Mesh', [
    ['skin_vertices', 'Vertices of the skin'],
    ['nodes', 'Nodes'],
    ['tets', 'Tetrahedra'],
    ['inverted_tets', 'of them turned inside out in some frame'],
    ['mesh_quality.least_dihedral_deg', 'Least dihedral angle', '°'],
    ['mesh_quality.skin_to_scan_mean_mm', 'Skin to scan, mean', 'mm'],
    ['mesh_quality.skin_to_scan_face_max_mm', 'Skin to scan, largest on the face', 'mm'],
  ]],
  ['Simulation', [
    ['element', 'Element'],
    ['strain', 'Strain'],
    ['law', 'Law of the tissue'],
    ['solver', 'Solver'],
    ['basis_size', 'Modes of the basis'],
    ['estimated_error', 'Estimated error', 'of the largest displacement'],
    ['verified_error', 'Error against the full model', 'of the largest displacement'],
    ['steps', 'Steps'],
    ['dt_s', 'Step', 's'],
    ['seconds.total', 'Computing time', 's'],
    ['version', 'Version of Hyperex'],
    ['commit', 'Commit'],
  ]],
];

/** Shown elsewhere on the page. */
const elsewhere = new Set(['program', 'title', 'variants', 'notes', 'warnings', 'remarks', 'symmetry.excursions', 'symmetry.commissure', 'symmetry.jitter_mm', 'mesh_quality.skin_to_scan_max_mm']);

/** Meanings of special numbers. Keys of summary.json, or of the scene's options. */
const meanings: Record<string, [stands: (value: number) => boolean, words: string]> = {
  'symmetry.lowpass_hz': [(v) => v === 0, 'not filtered'],
  'options.output.lowpass_hz': [(v) => v === 0, 'off'],
  'options.output.jitter_mm': [(v) => v < 0, 'automatic'],
  'options.output.peak_time_s': [(v) => v < 0, 'automatic'],
  'options.time.end_s': [(v) => v === 0, 'end of the recording'],
  'options.mesh.thickness_mm': [(v) => v === 0, 'from published depths'],
  'options.support.field_kpa_per_mm': [(v) => v === 0, 'off'],
};

const headUnknown = 'not known: no noise is seen in the points that hold it';

/** What null means, of keys that are shown all the same. */
const unknowns: Record<string, string> = {
  'head_shift_uncertainty_mm': headUnknown,
  'head_turn_uncertainty_deg': headUnknown,
};

const meaningOf = (key: string, value: unknown): string | null => {
  if (value === null) return unknowns[key] ?? null;
  const meaning = meanings[key];
  return meaning && typeof value === 'number' && meaning[0](value) ? meaning[1] : null;
};

const isEmpty = (value: unknown): boolean =>
  value === null || value === undefined || value === '' || (typeof value === 'number' && !Number.isFinite(value)) ||
  (Array.isArray(value) && value.every(isEmpty)) || (isObject(value) && Object.values(value).every(isEmpty));

/** Lengths and times below a nanometre or a nanosecond are rounding errors. */
const leastShown = 1e-6;

function textOf(value: unknown, unit = ''): string {
  if (typeof value === 'number') return ['mm', 's', '°'].includes(unit) && Math.abs(value) < leastShown ? '0' : number(value);
  if (typeof value === 'boolean') return value ? 'yes' : 'no';
  if (Array.isArray(value)) return value.map((v) => textOf(v, unit)).join(', ');
  return typeof value === 'string' ? pointOrText(value) : String(value);
}

/** A list of objects as one object: each under its name, or its place in the list. */
const byName = (list: unknown[]): Json =>
  Object.fromEntries(list.map((item, i) => {
    if (!isObject(item)) return [String(i + 1), item];
    const { name, point, landmark, ...rest } = item;
    const called = [name, point, landmark].find((v) => typeof v === 'string' && v !== '');
    return [`${i + 1}${called ? ` ${landmarkName(String(called))}` : ''}`, rest];
  }));

/** Nested objects row by row; a unit in an outer key ("distance_mm": {"mean": ...}) applies to the inner ones. */
function rowsOf(object: Json, skip: ReadonlySet<string>, outer: Omit<Row, 'value'> = { key: '', name: '', unit: '' }): Row[] {
  return Object.entries(object).flatMap(([key, value]) => {
    const own = nameAndUnit(key.replaceAll('.', ' · '));
    const row = {
      key: outer.key ? `${outer.key}.${key}` : key,
      name: outer.name ? `${outer.name} · ${own.name}` : own.name,
      unit: own.unit || outer.unit || (outer.key === 'seconds' ? 's' : ''),
    };
    if (isEmpty(value) || skip.has(row.key)) return [];
    if (Array.isArray(value) && value.some(isObject)) return rowsOf(byName(value), skip, row);
    return isObject(value) ? rowsOf(value, skip, row) : [{ ...row, value }];
  });
}

const at = (object: unknown, path: string): unknown =>
  path.split('.').reduce<unknown>((inner, key) => (isObject(inner) ? inner[key] : undefined), object);

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
    const words = meaningOf(key, value);
    const shown = words !== null ? '' : typeof value === 'number' || Array.isArray(value) ? unit : '';
    row.append(head);
    const cell = row.insertCell();
    cell.textContent = (words ?? textOf(value, unit)) + (shown ? (shown === '°' ? '°' : ` ${shown}`) : '');
    if (typeof value === 'string' || words !== null) cell.className = 'text';
  }
  card.append(made);
  return card;
}

/** The rows of a section of the scene, under their whole keys. */
const optionsOf = (section: string, values: Json): Row[] =>
  rowsOf(values, new Set()).map((row) => ({ ...row, key: `options.${section}.${row.key}` }));

function folded(title: string, tables: HTMLElement[], name = ''): HTMLElement {
  const details = element('details', '', `all-figures ${name}`.trim());
  const box = element('div', '', 'table-cards');
  box.append(...tables);
  details.append(element('summary', title), box);
  return details;
}

/** This many warnings are shown before the figures; the others are counted. */
const mostAbove = 3;

/** Above the face and not behind a link, since figures should not be read without them. */
export function fillWarnings(warnings: unknown, into: HTMLElement): void {
  const all = Array.isArray(warnings) ? [...new Set(warnings.filter((w): w is string => typeof w === 'string'))] : [];
  into.hidden = all.length === 0;
  for (const warning of all.slice(0, mostAbove)) {
    const item = element('li');
    item.append(element('strong', 'Warning: '), /^\S+\.\w/.test(warning) ? warning : upper(warning));
    into.append(item);
  }
  if (all.length <= mostAbove) return;
  const more = element('li');
  const link = element('a', all.length - mostAbove === 1 ? '1 more warning' : `${all.length - mostAbove} more warnings`);
  link.setAttribute('href', '#note-list');
  more.append(link);
  into.append(more);
}

/** Warnings first, each once. */
export function fillNotes(notes: string[], warnings: unknown, into: HTMLElement): void {
  const first = Array.isArray(warnings) ? warnings.filter((w): w is string => typeof w === 'string') : [];
  const all = [...new Set([...first, ...notes])];
  into.hidden = all.length === 0;
  for (const note of all) {
    const item = element('li', '', first.includes(note) ? 'warning' : '');
    if (first.includes(note)) item.append(element('strong', 'Warning: '));
    // A file's name stays as it is.
    item.append(/^\S+\.\w/.test(note) ? note : upper(note));
    into.append(item);
  }
}

export function fillSummary(summary: Json, into: HTMLElement): void {
  const used = new Set(elsewhere);
  const cards = groups.flatMap(([title, wanted]) => {
    const rows = wanted.flatMap(([key, name, unit = '']) => {
      const value = at(summary, key);
      used.add(key);
      return isEmpty(value) && meaningOf(key, value) === null ? [] : [{ key, name, unit, value }];
    });
    return rows.length > 0 ? [table(title, rows)] : [];
  });
  const box = element('div', '', 'table-cards');
  box.append(...cards);
  into.append(box);
  const { options, ...rest } = summary;
  const others = rowsOf(rest, used);
  if (others.length > 0) into.append(folded('All other figures', [table('Other figures', others)]));
  if (!isObject(options) || isEmpty(options)) return;
  const sections = Object.entries(options).filter(([, value]) => !isEmpty(value));
  const single = Object.fromEntries(sections.filter(([, value]) => !isObject(value)));
  const tables = sections.flatMap(([key, value]) => (isObject(value) ? [table(nameAndUnit(key).name, optionsOf(key, value))] : []));
  if (Object.keys(single).length > 0) tables.unshift(table('scene', rowsOf(single, new Set())));
  into.append(folded('Options of the scene', tables, 'options'));
}
