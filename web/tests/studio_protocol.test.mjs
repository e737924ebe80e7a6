// SPDX-License-Identifier: GPL-3.0-or-later
// The page's types are those of the one description of what page and server say.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { test } from 'node:test';
import { generated, typesFile, typesOf } from '../protocol/generate.mjs';

test('protocol.ts is what the generator makes of protocol.json', async () => {
  assert.equal(await readFile(typesFile, 'utf8'), generated(), 'run node web/protocol/generate.mjs');
});

test('a field of each type, choices and what may be left out', () => {
  const text = typesOf({
    about: 'a', version: 3,
    requests: { add_it: { about: 'Adds.', fields: { n: { type: 'integer', least: 1, most: 5 }, how: { type: 'string', choices: ['a', 'b'], optional: true } }, answer: {} } },
    events: { came: { about: 'Came.', fields: { x: { type: 'array' }, free: { type: 'json' } } } },
  });
  for (const line of [
    'export const protocolVersion = 3;', 'export interface AddItRequest {', '  n: number;', "  how?: 'a' | 'b';",
    'export type AddItAnswer = Record<string, never>;', '  x: Stretch;', '  free: unknown;',
    '  add_it: { n: { least: 1, most: 5 } },', '  add_it: { fields: AddItRequest; answer: AddItAnswer };', '  came: CameEvent;',
  ])
    assert.ok(text.split('\n').includes(line), line);
  assert.throws(() => typesOf({ about: '', version: 1, requests: {}, events: { e: { about: '', fields: { f: { type: 'float' } } } } }), /unknown type float/);
});
