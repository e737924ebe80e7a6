// SPDX-License-Identifier: GPL-3.0-or-later
// What the studio's page says and hears, as TypeScript, made of apps/studio/protocol.json.
//   node web/protocol/generate.mjs            writes web/src/studio/protocol.ts
//   node web/protocol/generate.mjs --print    prints it
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
export const schemaFile = join(here, '..', '..', 'apps', 'studio', 'protocol.json');
export const typesFile = join(here, '..', 'src', 'studio', 'protocol.ts');

const types = { string: 'string', integer: 'number', number: 'number', boolean: 'boolean', json: 'unknown', array: 'Stretch' };

function typeOf(name, { type, choices }) {
  if (!(type in types)) throw new Error(`${name}: unknown type ${type}`);
  return choices ? choices.map((choice) => `'${choice}'`).join(' | ') : types[type];
}

const pascal = (name) => name.split('_').map((word) => word[0].toUpperCase() + word.slice(1)).join('');

function* comment(text, indent) {
  const lines = [''];
  for (const word of text.split(' ')) {
    if (lines.at(-1).length + word.length > 105 - indent.length) lines.push('');
    lines[lines.length - 1] += (lines.at(-1) ? ' ' : '') + word;
  }
  if (lines.length === 1) yield `${indent}/** ${lines[0]} */`;
  else yield* [`${indent}/**`, ...lines.map((line) => `${indent} * ${line}`), `${indent} */`];
}

function* interfaceOf(name, about, fields) {
  if (about) yield* comment(about, '');
  const entries = Object.entries(fields);
  if (entries.length === 0) {
    yield `export type ${name} = Record<string, never>;`;
    return;
  }
  yield `export interface ${name} {`;
  for (const [key, field] of entries) {
    if (field.about) yield* comment(field.about, '  ');
    yield `  ${key}${field.optional ? '?' : ''}: ${typeOf(`${name}.${key}`, field)};`;
  }
  yield '}';
}

function* mapOf(name, about, entries) {
  yield* comment(about, '');
  yield `export interface ${name} {`;
  for (const [key, value] of entries) yield `  ${key}: ${value};`;
  yield '}';
}

function* lines({ about, version, requests, events }) {
  yield '// SPDX-License-Identifier: GPL-3.0-or-later';
  yield '// Made by web/protocol/generate.mjs of apps/studio/protocol.json: not to be changed by hand.';
  yield "import type { Stretch } from '../page/page_data';";
  yield '';
  yield* comment(about, '');
  yield `export const protocolVersion = ${version};`;
  for (const [name, request] of Object.entries(requests)) {
    yield '';
    yield* interfaceOf(`${pascal(name)}Request`, request.about, request.fields);
    yield* interfaceOf(`${pascal(name)}Answer`, '', request.answer);
  }
  for (const [name, event] of Object.entries(events)) {
    yield '';
    yield* interfaceOf(`${pascal(name)}Event`, event.about, event.fields);
  }
  yield '';
  yield* mapOf('Requests', 'What may be asked, and how it is answered.',
    Object.keys(requests).map((name) => [name, `{ fields: ${pascal(name)}Request; answer: ${pascal(name)}Answer }`]));
  yield '';
  yield* mapOf('Events', 'What comes unasked.', Object.keys(events).map((name) => [name, `${pascal(name)}Event`]));
}

export const typesOf = (schema) => `${[...lines(schema)].join('\n')}\n`;
export const generated = () => typesOf(JSON.parse(readFileSync(schemaFile, 'utf8')));

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  if (process.argv.includes('--print')) process.stdout.write(generated());
  else writeFileSync(typesFile, generated());
}
