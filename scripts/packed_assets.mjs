// SPDX-License-Identifier: GPL-3.0-or-later
// The files that the npm package @mediapipe/face_mesh (Apache-2.0) packs into one .data file, whose
// loader script lists the byte offsets. As a program it takes one out:
//   node packed_assets.mjs PACKAGE_FOLDER face_landmark.tflite TARGET
import { readFileSync, writeFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const STEM = 'face_mesh_solution_packed_assets';

/** The bytes of one packed file; an Error says what is missing. */
export function assetBytes(folder, name) {
  const loader = readFileSync(join(folder, `${STEM}_loader.js`), 'utf8');
  const match = loader.match(/loadPackage\((\{.*\})\)/);
  if (!match) throw new Error(`no list of files in ${STEM}_loader.js`);
  const entry = JSON.parse(match[1]).files.find((file) => basename(file.filename) === name);
  if (!entry) throw new Error(`${name} is not in the package`);
  const bytes = readFileSync(join(folder, `${STEM}.data`)).subarray(entry.start, entry.end);
  if (bytes.length !== entry.end - entry.start) throw new Error(`${STEM}.data is torn`);
  return bytes;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [folder, name, target] = process.argv.slice(2);
  try {
    if (!target) throw new Error('usage: packed_assets.mjs PACKAGE_FOLDER NAME TARGET');
    writeFileSync(target, assetBytes(folder, name));
  } catch (error) {
    console.error(`packed_assets: ${error.message}`);
    process.exit(1);
  }
}
