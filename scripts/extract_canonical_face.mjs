// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the canonical face that the npm package @mediapipe/face_mesh (Apache-2.0) carries as OBJ:
//   node extract_canonical_face.mjs PACKAGE_FOLDER canonical_face.obj
// 468 vertices in centimetres with texture coordinates, 898 triangles.
// The asset is a protocol buffer: GeometryPipelineMetadata { Mesh3d canonical_mesh = 1; ... },
// Mesh3d { ... repeated float vertex_buffer = 3 (x y z u v); repeated uint32 index_buffer = 4 }.
import { writeFileSync } from 'node:fs';
import { assetBytes } from './packed_assets.mjs';

const ASSET = 'geometry_pipeline_metadata_landmarks.binarypb';

function fail(message) {
  console.error(`extract_canonical_face: ${message}`);
  process.exit(1);
}

/** Top-level fields of a protocol-buffer message: [number, wire type, value]. */
function* fields(bytes) {
  let at = 0;
  const varint = () => {
    let value = 0;
    for (let scale = 1; ; scale *= 128) {
      if (at >= bytes.length) fail('the asset is torn');
      const byte = bytes[at++];
      value += (byte & 127) * scale;
      if (byte < 128) return value;
    }
  };
  while (at < bytes.length) {
    const tag = varint();
    const [number, type] = [Math.floor(tag / 8), tag % 8];
    if (type === 0) yield [number, type, varint()];
    else if (type === 2 || type === 5 || type === 1) {
      const size = type === 2 ? varint() : type === 5 ? 4 : 8;
      if (at + size > bytes.length) fail('the asset is torn');
      yield [number, type, bytes.subarray(at, (at += size))];
    } else fail(`wire type ${type} in the asset`);
  }
}

function floats(bytes) {
  const list = [];
  for (let i = 0; i + 4 <= bytes.length; i += 4) list.push(bytes.readFloatLE(i));
  return list;
}

function varints(bytes) {
  const list = [];
  let value = 0, scale = 1;
  for (const byte of bytes) {
    value += (byte & 127) * scale;
    if (byte < 128) { list.push(value); value = 0; scale = 1; } else scale *= 128;
  }
  return list;
}

function canonicalMesh(bytes) {
  const vertices = [], indices = [];
  for (const [number, , mesh] of fields(bytes)) {
    if (number !== 1) continue;
    for (const [field, type, value] of fields(mesh)) {
      if (field === 3) vertices.push(...floats(value));
      if (field === 4) indices.push(...(type === 0 ? [value] : varints(value)));
    }
  }
  return { vertices, indices };
}

const [folder, target] = process.argv.slice(2);
if (!folder || !target) fail('usage: extract_canonical_face.mjs PACKAGE_FOLDER canonical_face.obj');
let bytes;
try {
  bytes = assetBytes(folder, ASSET);
} catch (error) {
  fail(error.message);
}
const { vertices, indices } = canonicalMesh(bytes);
if (vertices.length !== 468 * 5 || indices.length !== 898 * 3)
  fail(`expected 468 vertices and 898 triangles, found ${vertices.length / 5} and ${indices.length / 3}`);

const lines = ['# Canonical face of MediaPipe Face Mesh, Apache-2.0, centimetres'];
for (let i = 0; i < vertices.length; i += 5) lines.push(`v ${vertices.slice(i, i + 3).join(' ')}`);
for (let i = 0; i < vertices.length; i += 5) lines.push(`vt ${vertices.slice(i + 3, i + 5).join(' ')}`);
for (let i = 0; i < indices.length; i += 3)
  lines.push('f ' + indices.slice(i, i + 3).map((k) => `${k + 1}/${k + 1}`).join(' '));
writeFileSync(target, lines.join('\n') + '\n');
