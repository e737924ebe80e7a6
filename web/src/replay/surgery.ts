// SPDX-License-Identifier: GPL-3.0-or-later
// What surgery does to the soft tissue, as a variant's row of the summary has it (metrics/soft_tissue_moves.hpp). No DOM
// here.
import type { Vec3 } from './data';
import { fixed } from '../page/format';

/** Displacements along the axes of the face: to the subject's left, up, forward. */
export interface SoftTissueMove {
  landmark: string;
  /** Of the face at rest, by surgery. */
  at_rest_mm: Vec3;
  /** From the face at rest, at the peak of base. */
  expression_before_mm: Vec3;
  expression_after_mm: Vec3;
  /** The first along the movement of the bone, over that movement. */
  soft_per_bone?: number;
  published?: { usual: number; low: number; high: number; source: string };
}

/** Empty where the variant moves no bones. */
export function softTissueMoves(row: Record<string, unknown> | undefined): SoftTissueMove[] {
  const given = (row?.surgery as { landmarks?: unknown } | undefined)?.landmarks;
  return Array.isArray(given) ? (given as SoftTissueMove[]) : [];
}

export const lengthOf = ([x, y, z]: Vec3): number => Math.hypot(x, y, z);

const ways: [plus: string, minus: string][] = [['left', 'right'], ['up', 'down'], ['forward', 'back']];

/** "5.6 forward, 0.4 down", the largest first; what rounds to nothing is left out. */
export const directionWords = (move: Vec3): string =>
  move.map((by, axis) => ({ by, way: ways[axis][by < 0 ? 1 : 0] }))
    .filter(({ by }) => Math.abs(by) >= 0.05)
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
