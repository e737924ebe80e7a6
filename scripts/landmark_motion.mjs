#!/usr/bin/env node
// SPDX-License-Identifier: GPL-3.0-or-later
// Writes src/hyperex/motion/data/landmark_motion.csv: how landmarks move while the head stands still.
//   node scripts/landmark_motion.mjs RIG.glb RIG_LANDMARKS.json RANGE_OF_MOTION.csv > landmark_motion.csv
// The rig has morph targets named like ARKit's blend shapes and the vertices of its landmarks; the
// recording has a person's weights of these shapes. Both together give the second moments (about
// rest) of the landmarks' displacements, kept as their strongest modes: one set for the shapes of
// brows and eyes, one for all others. Shapes that the recording hardly has are covered by a motion of
// each shape alone. What a rig does not do is stated below by hand.
import { readFileSync } from "node:fs";

// Standard deviations (x, y, z; mm) of motion beyond the rig's modes. Upper part of the face first.
const STATED = [
  ["upper", "0 16", 0.7, 0.7, 0.7],
  ["upper", "17 18 19 20 21 22 23 24 25 26", 1.5, 4, 1],
  ["upper", "27", 0.5, 2, 0.5],
  ["upper", "28", 0.5, 1.5, 0.8],
  ["upper", "29", 0.5, 1.2, 1.5],
  ["upper", "36 39 42 45", 0.7, 1.5, 1.5],
  ["upper", "37 38 43 44", 0.7, 3, 1],
  ["upper", "40 41 46 47 palpebrale_inferius_R palpebrale_inferius_L", 0.7, 2, 1.2],
  ["upper", "glabella", 0.5, 3, 0.7],
  ["lower", "1 15", 1, 2, 1.5],
  ["lower", "2 14", 1.5, 3, 2],
  ["lower", "3 13", 2, 4, 2.5],
  ["lower", "4 12", 3, 4, 4],
  ["lower", "5 6 7 8 9 10 11", 4, 6, 6],
  ["lower", "30", 0.7, 1.2, 2.5],
  ["lower", "31 32 33 34 35 alare_R alare_L", 2, 2.5, 3],
  ["lower", "crista_philtri_superior_R crista_philtri_superior_L", 2, 3, 3],
  ["lower", "cheek_R cheek_L", 3, 4, 4],
  ["lower", "48 49 50 51 52 53 54 55 56 57 58 59 60 61 62 63 64 65 66 67", 4, 6, 6],
];
// The inner corners lie on bone and ligament.
const DEPTH_OF_INNER_CORNERS = 0.5;
const ALIASES = {
  ibug68_36: "exocanthion_R", ibug68_45: "exocanthion_L", ibug68_39: "endocanthion_R",
  ibug68_42: "endocanthion_L", ibug68_27: "nasion", ibug68_30: "pronasale", ibug68_33: "subnasale",
  ibug68_8: "pogonion", ibug68_48: "cheilion_R", ibug68_54: "cheilion_L",
  ibug68_50: "crista_philtri_inferior_R", ibug68_52: "crista_philtri_inferior_L",
  ibug68_51: "labiale_superius", ibug68_57: "labiale_inferius", ibug68_62: "stomion",
};
// A recording has a few expressions of one person: each shape, of both sides, also moves by itself.
const ALONE = 0.15; // standard deviation of a weight
const LEAST_MODE_MM = 0.4; // root of the summed squares over all landmarks; weaker modes are left out

const [rigFile, landmarkFile, weightFile] = process.argv.slice(2);
const glb = readFileSync(rigFile);
const jsonLength = glb.readUInt32LE(12);
const gltf = JSON.parse(glb.subarray(20, 20 + jsonLength).toString());
const binary = glb.subarray(20 + jsonLength + 8);

function vectors(index) {
  const accessor = gltf.accessors[index], out = new Float32Array(accessor.count * 3);
  const floats = (view, offset, count) => {
    for (let i = 0; i < count; ++i)
      floats.to[floats.at(i)] = binary.readFloatLE((gltf.bufferViews[view].byteOffset ?? 0) + offset + 4 * i);
  };
  floats.to = out;
  floats.at = (i) => i;
  if (accessor.bufferView !== undefined)
    floats(accessor.bufferView, accessor.byteOffset ?? 0, out.length);
  if (accessor.sparse) {
    const { indices, values, count } = accessor.sparse, wide = indices.componentType === 5125;
    const start = (gltf.bufferViews[indices.bufferView].byteOffset ?? 0) + (indices.byteOffset ?? 0);
    const row = (i) => (wide ? binary.readUInt32LE(start + 4 * i) : binary.readUInt16LE(start + 2 * i));
    floats.at = (i) => 3 * row(Math.floor(i / 3)) + (i % 3);
    floats(values.bufferView, values.byteOffset ?? 0, 3 * count);
  }
  return out;
}

const mesh = gltf.meshes[0], face = mesh.primitives[0];
const vertexOf = JSON.parse(readFileSync(landmarkFile)).rig_vertex;
const landmarks = STATED.flatMap(([part, names, sx, sy, sz]) =>
  names.split(" ").map((name) => ({ part, sd: [sx, sy, sz], name: /^\d/.test(name) ? `ibug68_${name}` : name })));
for (const point of landmarks)
  if (/_(39|42)$/.test(point.name)) point.sd[2] = DEPTH_OF_INNER_CORNERS;
// A face is as likely to move on one side as on the other: all is averaged with its mirror image.
const MIRRORED_RANGES = [[0, 16], [17, 26], [31, 35]], MIRRORED_PAIRS =
  "36 45 37 44 38 43 39 42 40 47 41 46 48 54 49 53 50 52 55 59 56 58 60 64 61 63 65 67".split(" ").map(Number);
function mirrorName(name) {
  if (/_[LR]$/.test(name)) return name.replace(/_[LR]$/, (side) => (side === "_L" ? "_R" : "_L"));
  if (!name.startsWith("ibug68_")) return name;
  const k = Number(name.slice(7)), pair = MIRRORED_PAIRS.indexOf(k);
  for (const [first, last] of MIRRORED_RANGES) if (k >= first && k <= last) return `ibug68_${first + last - k}`;
  return pair < 0 ? name : `ibug68_${MIRRORED_PAIRS[pair ^ 1]}`;
}
const opposite = landmarks.map((point) => landmarks.findIndex((other) => other.name === mirrorName(point.name)));
/** Three numbers a landmark, mirrored. */
const mirrored = (values) =>
  values.map((_, i) => (i % 3 === 0 ? -1 : 1) * values[3 * opposite[Math.floor(i / 3)] + (i % 3)]);
const at = (array, name) => [0, 1, 2].map((axis) => 1e3 * array[3 * vertexOf[name] + axis]);
const size = 3 * landmarks.length;
const shapes = Object.fromEntries(mesh.extras.targetNames.map((name, i) => {
  const target = vectors(face.targets[i].POSITION);
  return [name, landmarks.flatMap((point) => at(target, point.name))];
}));

const [header, ...rows] = readFileSync(weightFile, "utf8").trim().split("\n").map((line) => line.split(","));
function shapesOf(column) {
  if (/^EyeLook|Yaw$|Pitch$|Roll$/.test(column)) return [];
  const name = column[0].toLowerCase() + column.slice(1);
  if (shapes[name]) return [name];
  const sided = name.replace(/Left$/, "_L").replace(/Right$/, "_R");
  return shapes[sided] ? [sided] : [`${name}_L`, `${name}_R`].filter((side) => shapes[side]);
}

const ofUpper = (name) => /^(brow|eye)/.test(name);
/** Displacements by each shape of a part of the face, those of two sides together. */
function shapesAlone(part) {
  const sums = {};
  for (const [name, values] of Object.entries(shapes))
    if (!/^eyeLook|^tongue/.test(name) && ofUpper(name) === (part === "upper")) {
      const sum = (sums[name.replace(/_[LR]$/, "")] ??= new Float64Array(size));
      values.forEach((value, i) => (sum[i] += value));
    }
  return Object.values(sums);
}

function moments(part) {
  const sum = Array.from({ length: size }, () => new Float64Array(size));
  const used = header.flatMap((column, i) => shapesOf(column).map((shape) => [i, shape]))
    .filter(([, shape]) => ofUpper(shape) === (part === "upper"));
  // Second moments of the weights first: far fewer than those of coordinates.
  for (const [i, a] of used)
    for (const [j, b] of used) {
      const mean = rows.reduce((s, row) => s + row[i] * row[j], 0) / rows.length;
      if (mean !== 0)
        for (let r = 0; r < size; ++r)
          if (shapes[a][r] !== 0) for (let c = 0; c < size; ++c) sum[r][c] += mean * shapes[a][r] * shapes[b][c];
    }
  for (const shape of shapesAlone(part))
    for (let r = 0; r < size; ++r)
      if (shape[r] !== 0) for (let c = 0; c < size; ++c) sum[r][c] += ALONE * ALONE * shape[r] * shape[c];
  // Averaged with what the mirrored face would do.
  const halfMirrored = sum.map((row) => mirrored(Array.from(row)));
  const turned = Array.from({ length: size }, (_, c) => mirrored(halfMirrored.map((row) => row[c])));
  return sum.map((row, r) => row.map((value, c) => (value + turned[c][r]) / 2));
}

// The strongest modes of a symmetric matrix, each as long as its standard deviation: the power method with deflation.
function modesOf(matrix) {
  const modes = [];
  for (;;) {
    let vector = Float64Array.from({ length: size }, (_, i) => Math.sin(i + 1)), value = 0;
    for (let round = 0; round < 3000; ++round) {
      const next = matrix.map((row) => row.reduce((s, m, i) => s + m * vector[i], 0));
      value = Math.hypot(...next);
      if (value === 0) return modes;
      const change = Math.max(...next.map((v, i) => Math.abs(v / value - vector[i])));
      vector = next.map((v) => v / value);
      if (change < 1e-10) break;
    }
    if (Math.sqrt(value) < LEAST_MODE_MM) return modes;
    modes.push(vector.map((v) => v * Math.sqrt(value)));
    matrix = matrix.map((row, r) => row.map((m, c) => m - value * vector[r] * vector[c]));
  }
}

const modes = { upper: modesOf(moments("upper")), lower: modesOf(moments("lower")) };
const neutral = vectors(face.attributes.POSITION);
const asGiven = landmarks.flatMap((point) => at(neutral, point.name)), reflected = mirrored(asGiven);
const rest = asGiven.map((value, i) => (value + reflected[i]) / 2);
const columns = ["name", "alias", "part", "x", "y", "z", "sx", "sy", "sz"];
for (const part of ["upper", "lower"])
  modes[part].forEach((_, m) => columns.push(...["x", "y", "z"].map((axis) => `${part}${m}${axis}`)));
console.log(`# SPDX-License-Identifier: GPL-3.0-or-later
# How landmarks move while the head stands still, mm (+x the subject's left, +y up, +z forward); written by
# scripts/landmark_motion.mjs, which says how.
#   x y z: place at rest. sx sy sz: standard deviation beyond the modes.
#   upperN, lowerN: modes of brows and eyes and of the rest of the face, each one standard deviation.
# Modes from the expressions of ICT-FaceKit Light (USC Institute for Creative Technologies, MIT) with
# the weights of a Live Link Face recording of a range of motion (MIT), and of each shape alone.
${columns.join(",")}`);
landmarks.forEach((point, row) => {
  const numbers = [...rest.slice(3 * row, 3 * row + 3), ...point.sd];
  for (const part of ["upper", "lower"])
    for (const mode of modes[part]) numbers.push(mode[3 * row], mode[3 * row + 1], mode[3 * row + 2]);
  console.log([point.name, ALIASES[point.name] ?? "", point.part, ...numbers.map((v) => +v.toFixed(2) || 0)].join(","));
});
