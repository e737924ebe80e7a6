// SPDX-License-Identifier: GPL-3.0-or-later
// Pages of visits with made-up figures in them, on the page as Vite built it. Neither the program nor a recording is needed.
import { mkdtemp, readFile, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { deflateSync } from 'node:zlib';
import { fixture, template } from './fixtures.mjs';
import { readPage, withFirstData } from './page_data.mjs';
import { crc32 } from './zip.mjs';

/** A chunk of a PNG file. */
function chunk(name, content) {
  const out = Buffer.alloc(12 + content.length);
  out.writeUInt32BE(content.length);
  out.write(name, 4, 'latin1');
  content.copy(out, 8);
  out.writeUInt32BE(crc32(out.subarray(4, 8 + content.length)), 8 + content.length);
  return out;
}

/** An oval with eyes and a mouth, which is wider the later the visit. */
function picture(smile) {
  const [width, height] = [180, 240];
  const rows = Buffer.alloc(height * (1 + 3 * width));
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) {
      const [u, v] = [(x - width / 2) / 70, (y - height / 2) / 100];
      const eye = Math.hypot((Math.abs(u) - 0.42) / 0.16, (v + 0.2) / 0.07) < 1;
      const mouth = Math.abs(v - 0.5 + smile * u * u) < 0.035 && Math.abs(u) < 0.4 + 0.2 * smile;
      const colour = Math.hypot(u, v) > 1 ? [238, 236, 232] : eye ? [60, 50, 50] : mouth ? [150, 50, 60] : [214, 176, 152];
      rows.set(colour, y * (1 + 3 * width) + 1 + 3 * x);
    }
  const head = Buffer.from([0, 0, 0, width, 0, 0, 0, height, 8, 2, 0, 0, 0]);
  const png = Buffer.concat([
    Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]),
    chunk('IHDR', head), chunk('IDAT', deflateSync(rows)), chunk('IEND', Buffer.alloc(0)),
  ]);
  return `data:image/png;base64,${png.toString('base64')}`;
}

const pairs = [
  ['corner_excursion', 'Corner of the mouth: excursion', 'mm', 8], ['corner_up', 'Corner of the mouth: up', 'mm', 6],
  ['corner_lateral', 'Corner of the mouth: to its own side', 'mm', 4.5], ['corner_forward', 'Corner of the mouth: forward', 'mm', -2],
  ['smile_angle', 'Direction of the smile over the horizontal', 'degrees', 42], ['upper_lip', 'Upper lip, midway to the corner: up', 'mm', 3],
  ['fold', 'Nasolabial fold: path', 'mm', 3.2], ['cheek', 'Cheek: forward', 'mm', 2.2],
  ['lid_closure', 'Lids: closing while smiling', '%', 31], ['brow', 'Brow: up', 'mm', 0.4],
  ['lower_lip', 'Lower lip, midway to the corner: down', 'mm', 1.4],
];
const middle = [['philtrum', 'Philtrum: deviation to the side of the stronger corner', 'mm', 1.1], ['symmetry', 'Weaker corner, share of the stronger', '%', 71]];

const round = (value) => Math.round(1e4 * value) / 1e4;
const around = (value, half) => ({ value: round(value), low: round(value - half), high: round(value + half) });

/** `k`: number of the row, from which its figures follow. */
function measure([key, words, unit, size], side, visits, k) {
  const half = unit === 'mm' ? 0.6 : 3;
  const at = (visit) => size * (side === 'L' ? 1 : 0.6 + (0.3 * visit) / Math.max(visits - 1, 1));
  const beyond = (change) => (Math.abs(change) > 1.4 * half ? 'yes' : k % 5 === 4 ? 'cannot tell' : 'no');
  return {
    key, words, side, unit, values: Array.from({ length: visits }, (_, i) => around(at(i), half)),
    changes: Array.from({ length: visits }, (_, i) => {
      if (i === 0) return null;
      const { value, low, high } = around(at(i) - at(0), 1.4 * half);
      return {
        value, low, high, low_measured: round(value - half / 2), high_measured: round(value + half / 2),
        beyond: beyond(value), doubtful: false, largest: ['repetition', 'jitter', 'head pose', 'axes'][k % 4],
      };
    }),
  };
}

function curve(visit, recording, visits) {
  const time_s = Array.from({ length: 81 }, (_, i) => round(-1 + i / 40));
  const bump = (t, most) => most * Math.exp(-((t - (t > 0 ? 0 : 0.05 * recording)) ** 2) / (t > 0 ? 0.3 : 0.12));
  const right = 4.8 + (2.4 * visit) / Math.max(visits - 1, 1);
  return {
    visit, recording, time_s,
    right_mm: time_s.map((t) => (visit === 1 && t > 0.5 && t < 0.6 ? null : round(bump(t, right - 0.2 * recording)))),
    left_mm: time_s.map((t) => round(bump(t, 8 + 0.1 * visit))),
  };
}

const dates = ['2026-03-01', '2026-04-12', '2026-05-30', '2026-08-02', '2026-11-20', '2027-01-15', '2027-03-08'];

/** 24 rows of measures. One is not measured at the second visit, and has no change there. */
export function madeUpVisits(count) {
  const sided = pairs.flatMap((pair, i) => [measure(pair, 'L', count, 2 * i), measure(pair, 'R', count, 2 * i + 1)]);
  const measures = [...sided, ...middle.map((one, i) => measure(one, '', count, 22 + i))];
  const brow = measures.find(({ key, side }) => key === 'brow' && side === 'R');
  if (count > 1) brow.values[1] = brow.changes[1] = null;
  return {
    version: 1, program: 'Hyperex 1.0.0', patient: 'P-017', expression: 'smile', peak_by: 'corners of the mouth',
    repetition: { mm: 1.5, source: 'default', text: 'The same person’s smile is taken to repeat within 1.5 mm (95 %), a default after published repeats.' },
    visits: Array.from({ length: count }, (_, i) => ({
      label: dates[i], note: i === 0 ? 'before injection' : i === count - 1 ? 'six months after injection, 12 weeks of exercises' : '',
      recordings: i === 1 ? ['smile_2a.csv', 'smile_2b.csv'] : [`smile_${i + 1}.csv`], peak_s: 1.23 + 0.1 * i, jitter_mm: i === 1 ? null : 0.31,
      head_fit_mm: 0.8, eye_distance_mm: 88.1 + 0.2 * i, picture: picture(0.15 + 0.1 * i), no_picture: '',
    })),
    curves: Array.from({ length: count }, (_, i) => [curve(i, 0, count), ...(i === 1 ? [curve(i, 1, count)] : [])]).flat(),
    measures,
    summary: count > 1
      ? ['The right corner of the mouth goes 2.4 mm farther than at the first visit (95 %: 1.6 to 3.2 mm): beyond what measurement and repetition make.',
         'The left corner has not changed: 0.0 mm (95 %: −0.8 to 0.8 mm).']
      : ['The right corner of the mouth goes 4.8 mm, the left 8.0 mm.'],
    choices: ['the head is held by head_1, head_2 and head_3, which keep still against each other.'],
    notes: ['smile_2a.csv: its tracking jitter is not known, as the file was smoothed.', 'The visits were recorded with different cameras.'],
    caveat: 'Hyperex is research software, no medical device: these figures are not for diagnosis or treatment.',
  };
}

/** Writes the page into a folder of its own and gives its path. The colours are those of another page. */
export async function visitsPage(manifest) {
  const { palette } = (await readPage(fixture('tracking.html'))).data;
  const file = join(await mkdtemp(join(tmpdir(), 'hyperex-visits-')), 'visits.html');
  await writeFile(file, withFirstData(await readFile(template('visits.html'), 'utf8'), { ...manifest, palette }));
  return file;
}
