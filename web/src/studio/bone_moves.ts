// SPDX-License-Identifier: GPL-3.0-or-later
// Reads and writes the rows of surgery.bone. Reads what the server says about segments of bone. No DOM here.
import type { Block, Stretch } from '../page/page_data';
import type { Vec3 } from '../replay/data';
import { isRecord } from './messages';

export const boneKey = 'surgery.bone';
export type BonePart = 'maxilla' | 'mandible' | 'chin';
export const boneParts: BonePart[] = ['maxilla', 'mandible', 'chin'];

/** As in a scene file; vectors are along the axes of the face: to the left, up, forward. */
export interface BoneMove {
  part: string;
  cut: string;
  move_mm: Vec3;
  turn_deg: Vec3;
  cut_shift_mm: number;
}

const vectorOf = (value: unknown): Vec3 => (Array.isArray(value) && value.length === 3 ? (value.map(Number) as Vec3) : [0, 0, 0]);

export function movesOf(value: unknown): BoneMove[] {
  return (Array.isArray(value) ? value.filter(isRecord) : []).map((row) => ({
    part: String(row.part ?? 'mandible'), cut: String(row.cut ?? 'standard'), move_mm: vectorOf(row.move_mm),
    turn_deg: vectorOf(row.turn_deg), cut_shift_mm: Number(row.cut_shift_mm ?? 0),
  }));
}

/** The move of a part; one that moves nothing where there is none. */
export const moveOf = (moves: BoneMove[], part: BonePart): BoneMove =>
  moves.find((move) => move.part === part) ?? { part, cut: 'standard', move_mm: [0, 0, 0], turn_deg: [0, 0, 0], cut_shift_mm: 0 };

export const isStill = ({ move_mm, turn_deg }: BoneMove): boolean => [...move_mm, ...turn_deg].every((value) => value === 0);

/** The moves with another one of the same part. One that moves nothing is left out. */
export function withMove(moves: BoneMove[], next: BoneMove): BoneMove[] {
  const before = moves.findIndex(({ part }) => part === next.part);
  const others = moves.filter(({ part }) => part !== next.part);
  if (isStill(next)) return others;
  return before < 0 ? [...moves, next] : moves.map((move, i) => (i === before ? next : move));
}

/** Where a segment is cut and about what it turns, metres, in the scan's axes. */
export interface BoneSegment {
  part: string;
  cut: string;
  turns_about: Vec3;
  plane_at: Vec3;
  /** Towards the segment. */
  plane_normal: Vec3;
  half_width_m: number;
  /** The segment lies in front of it. */
  ends_at: Vec3 | null;
}

export interface Surface {
  points: Float32Array;
  triangles: Int32Array;
}

/** Of the event face. */
export interface BonesKnown {
  axes: [left: Vec3, up: Vec3, forward: Vec3];
  /** A place in the middle of the face. */
  middle: Vec3;
  segments: BoneSegment[];
  skull: Surface | null;
  mandible: Surface | null;
}

type Sent<T> = Omit<T, 'skull' | 'mandible'> & Record<'skull' | 'mandible', { points: Stretch; triangles: Stretch } | null>;

export function bonesOf(message: unknown, block: Block): BonesKnown {
  const { skull, mandible, ...rest } = message as Sent<BonesKnown>;
  const surface = (sent: Sent<BonesKnown>['skull']): Surface | null =>
    sent && { points: block.float32(sent.points).slice(), triangles: block.int32(sent.triangles).slice() };
  return { ...rest, skull: surface(skull), mandible: surface(mandible) };
}
