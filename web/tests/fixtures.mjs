// SPDX-License-Identifier: GPL-3.0-or-later
// Where the files under test are: HYPEREX_REPORT_FIXTURES, or what the newest build wrote.
import { existsSync, readdirSync, statSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = join(dirname(fileURLToPath(import.meta.url)), '..', '..');

/** Folders of what builds wrote for tests. */
function folders() {
  if (process.env.HYPEREX_REPORT_FIXTURES) return [process.env.HYPEREX_REPORT_FIXTURES];
  const builds = join(root, 'build');
  return existsSync(builds) ? readdirSync(builds).map((preset) => join(builds, preset, 'report_fixtures')) : [];
}

/** The newest of these files that exists. */
function newest(files, otherwise) {
  const found = files.filter(existsSync);
  if (found.length === 0) throw new Error(otherwise);
  return found.sort((a, b) => statSync(b).mtimeMs - statSync(a).mtimeMs)[0];
}

export const fixture = (name) => newest(folders().map((folder) => join(folder, name)),
  `no ${name}: run build/PRESET/bin/write_report_fixtures build/PRESET/report_fixtures first`);

/** A page as Vite built it, without data. */
export const template = (name) => newest(folders().map((folder) => join(folder, '..', 'web', name)),
  `no ${name}: build hx_report first`);
