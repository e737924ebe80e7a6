// SPDX-License-Identifier: GPL-3.0-or-later
// What surgery does to the soft tissue, as a variant's row of the summary has it (metrics/soft_tissue_moves.hpp). No DOM
// here.
import type { Vec3 } from './data';
import { fixed, number } from '../page/format';

/** Displacements along the axes of the face: to the subject's left, up, forward. */
export interface SoftTissueMove {
  landmark: string;
  /** Displacement of the face at rest by surgery. */
  at_rest_mm: Vec3;
  /** From the face at rest, at the peak of base. */
  expression_before_mm: Vec3;
  expression_after_mm: Vec3;
  /** The first along the movement of the bone, over that movement. */
  soft_per_bone?: number;
  published?: { usual: number; low: number; high: number; source: string };
}

type VariantRow = Record<string, unknown> | undefined;

interface Surgery {
  landmarks?: SoftTissueMove[];
  /** Only where the variant adds another volume than base. */
  added_volume_ml?: number;
  /** What lies between both skins at rest, positive outwards. */
  skin_volume_change_ml?: number;
  greatest_at_rest_mm?: number;
}

const surgeryOf = (row: VariantRow): Surgery => (row?.surgery ?? {}) as Surgery;

/** Empty where the variant neither moves bones nor adds volume. */
export function softTissueMoves(row: VariantRow): SoftTissueMove[] {
  const { landmarks } = surgeryOf(row);
  return Array.isArray(landmarks) ? landmarks : [];
}

export const lengthOf = ([x, y, z]: Vec3): number => Math.hypot(x, y, z);

/** Below this a movement is shown as 0.0 mm. */
const leastShownMm = 0.05;

/** The landmarks to show: volume is added in one place, and most landmarks stay where they are. */
export const shownMoves = (row: VariantRow): SoftTissueMove[] =>
  softTissueMoves(row).filter(({ at_rest_mm: move }) => surgeryOf(row).added_volume_ml === undefined || lengthOf(move) >= leastShownMm);

/** "2 ml added", "1 ml taken away". */
export const volumeWords = (ml: number): string => `${Number(Math.abs(ml).toPrecision(3))} ml ${ml < 0 ? 'taken away' : 'added'}`;

/** What becomes of added volume: "2 ml added, 1.8 ml show at the skin, which moves by up to 0.7 mm"; "" where a variant
 *  adds none. */
export function volumeSentence(row: VariantRow): string {
  const { added_volume_ml: added, skin_volume_change_ml: shown, greatest_at_rest_mm: most } = surgeryOf(row);
  if (added === undefined) return '';
  if (shown === undefined || most === undefined) return volumeWords(added);
  const twoDigits = (ml: number): string => number(Number(ml.toPrecision(2)));
  const moved = `moves by up to ${fixed(most, 1)} mm`;
  // Bones that move shift the skin, too.
  const { changes } = row!;
  if (typeof changes === 'object' && changes !== null && 'surgery.bone' in changes)
    return `${volumeWords(added)}; with the bones the skin ${shown < 0 ? 'loses' : 'gains'} ${twoDigits(Math.abs(shown))} ml and ${moved}`;
  return `${volumeWords(added)}, ${twoDigits(added < 0 ? -shown : shown)} ml show at the skin, which ${moved}`;
}

const ways: [plus: string, minus: string][] = [['left', 'right'], ['up', 'down'], ['forward', 'back']];

/** "5.6 forward, 0.4 down", the largest first; what rounds to nothing is left out. */
export const directionWords = (move: Vec3): string =>
  move.map((by, axis) => ({ by, way: ways[axis][by < 0 ? 1 : 0] }))
    .filter(({ by }) => Math.abs(by) >= leastShownMm)
    .sort((a, b) => Math.abs(b.by) - Math.abs(a.by))
    .map(({ by, way }) => `${fixed(Math.abs(by), 1)} ${way}`)
    .join(', ');

/** A row of surgery.bone in words: "mandible 6 mm forward, front 4 deg down, whole bone". */
export function boneWords(row: Record<string, unknown>): string {
  const part = typeof row.part === 'string' ? row.part.replaceAll('_', ' ') : 'bone';
  const numbers = (value: unknown): number[] => (Array.isArray(value) ? value.map(Number) : []);
  const short = (value: number): string => String(Number(Math.abs(value).toPrecision(3)));
  const moved = numbers(row.move_mm).flatMap((by, axis) => (by ? [`${short(by)} mm ${ways[axis][by < 0 ? 1 : 0]}`] : []));
  const turns = [['front', 'down', 'up'], ['front', 'to the left', 'to the right'], ['left side', 'up', 'down']];
  const turned = numbers(row.turn_deg).flatMap((by, axis) => {
    if (!by) return [];
    const [what, plus, minus] = turns[axis];
    return [`${what} ${short(by)} deg ${by < 0 ? minus : plus}`];
  });
  const shift = Number(row.cut_shift_mm ?? 0);
  const [plus, minus] = row.part === 'mandible' ? ways[2] : ways[1];
  const cut = [...(row.cut === 'whole' && row.part !== 'skull' ? ['whole bone'] : []), ...(shift ? [`cut ${short(shift)} mm ${shift < 0 ? minus : plus}`] : [])];
  return [part, [[...moved, ...turned].join(', ') || 'not moved', ...cut].join(', ')].join(' ');
}
