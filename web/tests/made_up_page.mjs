// SPDX-License-Identifier: GPL-3.0-or-later
// A page of variants whose figures hold what is rare: an exact motion, figures that are not defined, changes of
// every kind, points whose excursions are undecided.
import { mkdtemp, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fixture } from './fixtures.mjs';
import { readPage, withData } from './page_data.mjs';

const sides = (L, R) => ({ L, R });
const pair = (point, L, R, undecided = false) => ({
  point, undecided, floor_mm: undecided ? 0.3 : 0.05, speed_correlation: 0.987,
  excursion_mm: sides(L, R), excursion_ratio_R_L: L > 0 ? R / L : null,
  path_mm: sides(2 * L, 2 * R), path_ratio_R_L: L > 0 ? R / L : null,
  peak_speed_mm_s: sides(9 * L, 9 * R), peak_speed_ratio_R_L: L > 0 ? R / L : null,
});

export async function rarePage() {
  const { html, data } = await readPage(fixture('variants.html'));
  for (const { symmetry } of [data, ...data.variants]) Object.assign(symmetry, { noise: [], jitter_mm: 0 });
  const { table } = data.summary.variants;
  Object.assign(table[1], { lag_ms: null, changes: {
    'tissue.young_kpa': 1000, 'solver.method': 'direct', 'muscles.gain': { side_R: 0.3, zygomatic_L: 0, zyg_major_R: 1.255 },
    'time.step_s': 0.005,
  } });
  Object.assign(table[2], {
    hysteresis: 3.2e-6,
    changes: { 'tissue.region': [{ scar: ['cheilion_R', 'alare_R'], width_mm: 8, young_factor: 20 }, { name: 'lips', viscosity_pa_s: 900 }] },
  });
  Object.assign(table[1], { added_xi_difference: 0.0031, added_xi_floor: 0.0123, added_xi_decided: 0 });
  Object.assign(table[2], { added_xi_difference: 0.0456, added_xi_floor: 0.0123, added_xi_decided: 1 });
  table[3].changes = { 'tissue.point': [{ landmark: 'cheek', side: 'L', young_kpa: 80 }], 'motion.gain': 0.5 };
  data.summary.options = { tissue: { young_kpa: 192.4 }, solver: { method: 'reduced' }, motion: { gain: 1 },
    time: { end_s: 0, step_s: 0.005 }, output: { peak_time_s: -1, jitter_mm: -1, lowpass_hz: 6 } };
  data.summary.checks = [{ name: 'first', worst_mm: 0.25 }, { worst_mm: 0.5 }];
  data.summary.symmetry = {
    jitter_mm: 0, lowpass_hz: 0,
    excursions: [pair('alare', 0.5, 0.6, true), pair('cheilion', 6.78, 4.2), pair('ibug68_7/9', 12, 11), pair('cheek', 0, 1)],
  };
  table[2].excursions = [pair('cheilion', 5, 3), pair('alare', 6, 0.25)];
  Object.assign(data.point_words, {
    cheilion: 'corner of the mouth (cheilion)', alare: 'wing of the nose (alare)', cheek: 'cheek', 'ibug68_7/9': 'outline of the jaw',
  });
  const file = join(await mkdtemp(join(tmpdir(), 'hyperex-page-')), 'rare.html');
  await writeFile(file, withData(html, data));
  return file;
}
