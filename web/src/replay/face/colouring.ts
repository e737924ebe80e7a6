// SPDX-License-Identifier: GPL-3.0-or-later
// The quantities that the face's colours can show. Ranges are common to all faces, so that their colours can be
// compared, except for the difference from base, whose size varies too much between variants.
import { asymmetry, usualAsymmetryMm } from './asymmetry';
import { niceCeiling, type RampName } from './colour';
import type { Face, Replay, SkinMap } from '../data';
import type { FaceShape } from './deform';
import { faceWords, number } from '../../page/format';

/** What the colours stand for: `least` is the first of the ramp, `greatest` the last. */
export interface Scale {
  ramp: RampName;
  title: string;
  unit: string;
  least: number;
  greatest: number;
  /** Explains the range, and which vertices have no colour. */
  remark: string;
}

/** How the faces that are shown are coloured. */
export interface Painting {
  /** Null where the face has its own colours. */
  scale: Scale | null;
  /** Writes one number per vertex, 0 (least) to 1 (greatest), possibly outside; NaN: no value. `other`: the other face
   *  of two. */
  fill(shape: FaceShape, out: Float32Array, other: FaceShape | null): void;
  /** Whether a face's colours depend on the other face, too. */
  together?: boolean;
  /** What the colours must not be taken for. */
  caution?: string;
  /** Explains the colours of a face where they need it. */
  note(face: Face): string;
}

export interface Colouring {
  key: string;
  /** On its button. */
  label: string;
  /** The painting of one face or two, given by their indices in `Replay.faces`. */
  of(shown: number[]): Painting;
}

const without = () => '';
const ofAll = (replay: Replay) => (replay.faces.length > 1 ? 'range of all faces' : '');

function displacement(replay: Replay): Colouring {
  const greatest = niceCeiling(Math.max(...replay.faces.map((f) => f.maxDisplacementMm)));
  const painting: Painting = {
    scale: { ramp: 'moss', title: 'Displacement from rest', unit: 'mm', least: 0, greatest, remark: ofAll(replay) },
    fill(shape, out) {
      const d = shape.displacement;
      const factor = 1e3 / greatest;
      for (let i = 0, v = 0; i < out.length; ++i, v += 3)
        out[i] = factor * Math.sqrt(d[v] * d[v] + d[v + 1] * d[v + 1] + d[v + 2] * d[v + 2]);
    },
    note: without,
  };
  return { key: 'displacement', label: 'Displacement', of: () => painting };
}

function distances(a: Float32Array, b: Float32Array, factor: number, out: Float32Array): void {
  for (let i = 0, v = 0; i < out.length; ++i, v += 3) {
    const x = a[v] - b[v];
    const y = a[v + 1] - b[v + 1];
    const z = a[v + 2] - b[v + 2];
    out[i] = factor * Math.sqrt(x * x + y * y + z * z);
  }
}

/** Distance from the unchanged face. Next to base, both faces show the difference between them: base's own is zero everywhere and
 *  would carry no information. */
function difference(replay: Replay): Colouring {
  const { faces } = replay;
  const of = (shown: number[]): Painting => {
    const variants = [...new Set(shown)].filter((i) => faces[i].difference);
    const between = shown.length > 1 && shown.includes(0) && variants.length > 0;
    const greatest = niceCeiling(Math.max(0, ...variants.map((i) => faces[i].maxDifferenceMm)));
    const names = variants.map((i) => faceWords(faces, i)).join(' and ');
    const title = between ? 'Distance between the faces' : 'Distance from the unchanged face';
    return {
      scale: { ramp: 'embers', title, unit: 'mm', least: 0, greatest, remark: names && `range of ${names} alone` },
      fill(shape, out, other) {
        const from = between && other ? other.displacement : shape.scene.displacement;
        distances(shape.displacement, from, 1e3 / greatest, out);
      },
      together: between,
      note: (face) => (face.difference || between ? '' : '0 mm everywhere by definition'),
    };
  };
  return { key: 'difference', label: 'Difference', of };
}

/** On a smaller scale, unevenness due to the mesh would look like a finding. */
const leastAsymmetryRangeMm = 5;

function asymmetryOfMotion(replay: Replay, mirror: NonNullable<Replay['mirror']>): Colouring {
  let painting: Painting | null = null;
  const made = (): Painting => {
    const greatest = niceCeiling(Math.max(usualAsymmetryMm(replay, mirror), leastAsymmetryRangeMm));
    const some = mirror.vertices.some((v) => v < 0) ? 'grey: unpaired' : '';
    const remark = [ofAll(replay), some].filter((text) => text).join('; ');
    return {
      scale: { ramp: 'plum', title: 'Asymmetry of the motion', unit: 'mm', least: 0, greatest, remark },
      fill: (shape, out) => asymmetry(mirror, shape.displacement, 1e3 / greatest, out),
      caution: 'The map cannot show which side is weak.',
      note: without,
    };
  };
  return { key: 'asymmetry', label: 'Asymmetry', of: () => (painting ??= made()) };
}

/** How much of the motion's variance the driven points determine, of the parts that the program prints. */
function shownShares({ uncertainty }: Record<string, unknown>): string {
  const known = (uncertainty ?? {}) as Record<string, { determined: number } | undefined>;
  const shares = ['lips', 'cheeks', 'eyes', 'forehead'].flatMap((part) => {
    const share = known[part]?.determined;
    return share === undefined ? [] : [`${part} ${Math.round(100 * share)} %`];
  });
  return shares.length > 0 ? `Of the motion the recording shows: ${shares.join(', ')}. ` : '';
}

function expectedError(replay: Replay, map: SkinMap): Colouring {
  const remark = replay.faces.length > 1 ? 'that of base' : '';
  const greatest = niceCeiling(map.greatest);
  const factor = map.greatest / 255 / greatest;
  const painting: Painting = {
    scale: { ramp: 'plum', title: 'Expected error of the skin', unit: 'mm', least: 0, greatest, remark },
    fill(_shape, out) {
      for (let i = 0; i < out.length; ++i) out[i] = factor * map.bytes[i];
    },
    caution: `${shownShares(replay.summary)}Without errors of mesh and tissue.`,
    note: without,
  };
  return { key: 'uncertainty', label: 'Error', of: () => painting };
}

/** Names of maps, where the page has a word of its own: Young's modulus is the stiffness. */
const mapNames: Record<string, string> = { young_kpa: 'Stiffness' };

function tissue(replay: Replay, key: string): Colouring {
  const { name: given, unit, least, greatest } = replay.faces[0].tissue.find((map) => map.key === key)!;
  const name = mapNames[key] ?? given;
  const bytesOf = (face: Face) => face.tissue.find((map) => map.key === key)?.bytes;
  const painting: Painting = {
    scale: { ramp: 'sea', title: name, unit, least, greatest, remark: ofAll(replay) },
    fill(shape, out) {
      const bytes = bytesOf(shape.face);
      if (!bytes) out.fill(0);
      else for (let i = 0; i < out.length; ++i) out[i] = bytes[i] / 255;
    },
    note(face) {
      const bytes = bytesOf(face);
      if (!bytes || !bytes.every((b) => b === bytes[0])) return '';
      return 'the same everywhere';
    },
  };
  return { key: `tissue:${key}`, label: name, of: () => painting };
}

const plain: Painting = { scale: null, fill: (_shape, out) => void out.fill(0), note: without };
const skin: Colouring = { key: 'skin', label: 'Skin', of: () => plain };

export function colouringsOf(replay: Replay): Colouring[] {
  return [
    skin,
    displacement(replay),
    ...(replay.faces.length > 1 ? [difference(replay)] : []),
    ...(replay.mirror ? [asymmetryOfMotion(replay, replay.mirror)] : []),
    ...(replay.uncertainty ? [expectedError(replay, replay.uncertainty)] : []),
    ...replay.faces[0].tissue.map((map) => tissue(replay, map.key)),
  ];
}

interface Tick {
  share: number;
  text: string;
}

/** Whether the texts have room on a bar as wide as 21 characters: the first begins and the last ends with the bar, the
 *  others are centred. Of seven, each other one is shown. */
function haveRoom(ticks: Tick[]): boolean {
  const width = 21;
  const shown = ticks.length === 7 ? ticks.filter((_, i) => i % 2 === 0) : ticks;
  const starts = shown.map(({ share, text }, i) => share * width - text.length * (i === 0 ? 0 : i === shown.length - 1 ? 1 : 0.5));
  return shown.every((_, i) => i === 0 || starts[i] >= starts[i - 1] + shown[i - 1].text.length + 0.5);
}

/** Places along the bar, 0 to 1, and their values: round ones where few even steps make them, and no more than have
 *  room. */
export function ticksOf({ least, greatest }: Scale): Tick[] {
  const range = greatest - least;
  const round = (step: number) => [1, 2, 5].includes(Number(step.toExponential(6).split('e')[0]));
  const ticks = (count: number): Tick[] => Array.from({ length: count + 1 }, (_, i) => {
    const share = i / count;
    return { share, text: number(Number((least + share * range).toPrecision(4))) };
  });
  return [...[5, 4, 6, 3].filter((n) => round(range / n)), 4, 2].map(ticks).find(haveRoom) ?? ticks(1);
}
