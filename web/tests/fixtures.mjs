// SPDX-License-Identifier: GPL-3.0-or-later
// Where the files under test are: HYPEREX_REPORT_FIXTURES, or what the newest build wrote.
import { existsSync, readdirSync, statSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = join(dirname(fileURLToPath(import.meta.url)), '..', '..');

export function fixture(name) {
  const folders = process.env.HYPEREX_REPORT_FIXTURES
    ? [process.env.HYPEREX_REPORT_FIXTURES]
    : existsSync(join(root, 'build'))
      ? readdirSync(join(root, 'build')).map((preset) => join(root, 'build', preset, 'report_fixtures'))
      : [];
  const files = folders.map((folder) => join(folder, name)).filter(existsSync);
  if (files.length === 0)
    throw new Error(`no ${name}: run build/PRESET/bin/write_report_fixtures build/PRESET/report_fixtures first`);
  return files.sort((a, b) => statSync(b).mtimeMs - statSync(a).mtimeMs)[0];
}
