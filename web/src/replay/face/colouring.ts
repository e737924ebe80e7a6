// SPDX-License-Identifier: GPL-3.0-or-later
// What the colours of the face can tell. Ranges are those of all faces together, so that colours of two
// faces compare.
import { niceCeiling, type RampName } from './colour';
import type { Face, Replay } from '../data';
import type { FaceShape } from './deform';
import { number } from '../../page/format';

/** What the colours stand for: `least` is the first of the ramp, `greatest` the last. */
export interface Scale {
  ramp: RampName;
  title: string;
  unit: string;
  least: number;
  greatest: number;
}

export interface Colouring {
  key: string;
  /** On its button. */
  label: string;
  /** Null where the face has its own colours. */
  scale: Scale | null;
  /** Writes a number from 0 (least) to 1 (greatest) a vertex; may leave that range. */
  fill(shape: FaceShape, out: Float32Array): void;
  /** A word on what a face shows, where the colours alone would not say. */
  note(face: Face): string;
}

const without = () => '';

function displacement(replay: Replay): Colouring {
  const greatest = niceCeiling(Math.max(...replay.faces.map((f) => f.maxDisplacementMm)));
  return {
    key: 'displacement',
    label: 'Displacement',
    scale: { ramp: 'viridis', title: 'Displacement from rest', unit: 'mm', least: 0, greatest },
    fill(shape, out) {
      const d = shape.displacement;
      const factor = 1e3 / greatest;
      for (let i = 0, v = 0; i < out.length; ++i, v += 3)
        out[i] = factor * Math.sqrt(d[v] * d[v] + d[v + 1] * d[v + 1] + d[v + 2] * d[v + 2]);
    },
    note: without,
  };
}

function difference(replay: Replay): Colouring {
  const greatest = niceCeiling(Math.max(...replay.faces.map((f) => f.maxDifferenceMm)));
  return {
    key: 'difference',
    label: 'Difference',
    scale: { ramp: 'embers', title: 'Distance from the scene itself', unit: 'mm', least: 0, greatest },
    fill(shape, out) {
      if (!shape.face.difference) {
        out.fill(0);
        return;
      }
      const d = shape.displacement;
      const own = shape.scene.displacement;
      const factor = 1e3 / greatest;
      for (let i = 0, v = 0; i < out.length; ++i, v += 3) {
        const x = d[v] - own[v];
        const y = d[v + 1] - own[v + 1];
        const z = d[v + 2] - own[v + 2];
        out[i] = factor * Math.sqrt(x * x + y * y + z * z);
      }
    },
    note: (face) => (face.difference ? '' : '0 mm everywhere by definition'),
  };
}

function tissue(replay: Replay, key: string): Colouring {
  const { name, unit, least, greatest } = replay.faces[0].tissue.find((map) => map.key === key)!;
  const bytesOf = (face: Face) => face.tissue.find((map) => map.key === key)?.bytes;
  return {
    key: `tissue:${key}`,
    label: name,
    scale: { ramp: 'sea', title: name, unit, least, greatest },
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
}

const skin: Colouring = {
  key: 'skin',
  label: 'Skin',
  scale: null,
  fill: (_shape, out) => void out.fill(0),
  note: without,
};

export function colouringsOf(replay: Replay): Colouring[] {
  return [
    displacement(replay),
    ...(replay.faces.length > 1 ? [difference(replay)] : []),
    ...replay.faces[0].tissue.map((map) => tissue(replay, map.key)),
    skin,
  ];
}

/** Places along the bar, 0 to 1, and their values: round ones where few even steps make them. */
export function ticksOf({ least, greatest }: Scale): { share: number; text: string }[] {
  const range = greatest - least;
  const round = (step: number) => [1, 2, 5].includes(Number(step.toExponential(6).split('e')[0]));
  const count = [5, 4, 6, 3].find((n) => round(range / n)) ?? 4;
  return Array.from({ length: count + 1 }, (_, i) => {
    const share = i / count;
    return { share, text: number(Number((least + share * range).toPrecision(4))) };
  });
}
