// SPDX-License-Identifier: GPL-3.0-or-later
// The replay's data as the other parts use them.
import type { Manifest, ModeData, MuscleData, SymmetryCurve, SkinMapData } from './manifest';
import { usePointWords } from '../page/format';
import type { Block, Stretch } from '../page/page_data';

export type Vec3 = [number, number, number];

export interface Mode {
  stepM: number;
  values: Int16Array;
}

/** A quantity on the skin: least + bytes / 255 * (greatest - least). */
export interface SkinMap {
  key: string;
  name: string;
  unit: string;
  least: number;
  greatest: number;
  bytes: Uint8Array;
}

/** Base (the scene without a variant) or a variant of it: the same skin with another motion. */
export interface Face {
  name: string;
  /** What differs from base, a sentence each. */
  changes: string[];
  maxDisplacementMm: number;
  /** From base, over all vertices and frames. */
  maxDifferenceMm: number;
  /** Where that is. */
  maxDifferenceFrame: number;
  /** What is added to the scene's own displacement; null for base. */
  difference: { modes: Mode[]; weights: Float32Array; maxErrorMm: number } | null;
  symmetry: SymmetryCurve | null;
  /** Samples x names x 3, as in `Replay.landmarks`. */
  landmarkPositions: Float32Array;
  tissue: SkinMap[];
  /** Activations over time, as in `Muscles.groups`; [] where not known. */
  muscles: { left: number[]; right: number[] }[];
  /** Of each of `Muscles.lines`, a character per sample: 0 where the activation may be 0 (95 %). [] where not known. */
  activeMuscles: string[];
  /** Frames x 7: the jaw's quaternion x y z w and its translation since rest; null without teeth. */
  jaw: Float32Array | null;
  /** The pose that surgery gave the upper teeth, quaternion x y z w and translation; null where it moved none. */
  upperTeeth: number[] | null;
}

export interface MuscleGroup {
  name: string;
  left: number[];
  right: number[];
  /** 1 sigma of the activation where the group acts most. */
  sigmaLeft: number;
  sigmaRight: number;
  /** "mostly the prior's choice" where that is so there; else empty. */
  noteLeft: string;
  noteRight: string;
}

/** Where muscles drive. */
export interface Muscles {
  timeS: number[];
  fewPoints: boolean;
  groups: MuscleGroup[];
  /** `sheet`: a fan, its tip first. */
  lines: { name: string; latin: string; points: Vec3[]; sheet?: Vec3[] }[];
}

/** A hole of the skin. */
export interface Opening {
  loop: Int32Array;
  /** At rest: the edge, the rings behind it, and a point. */
  rest: Float32Array;
  /** For each ring behind the edge, and for the point: shares of the motion of edge, its middle and the jaw. */
  rings: [number, number, number][];
  /** Per vertex of the loop: its share of the jaw's motion. */
  jaw: Float32Array;
  /** sRGB per point. */
  colours: Uint8Array;
}

export interface Replay {
  title: string;
  notes: string[];
  summary: Record<string, unknown>;
  scanVertices: number;
  points: Float32Array;
  triangles: Int32Array;
  colour: Uint8Array | null;
  /** Ambient occlusion at rest, one byte per vertex. */
  light: Uint8Array;
  /** Opacity of the skin, one byte per vertex: 0 at the border of the scan. */
  fade: Uint8Array;
  texture: { image: Blob; uv: Float32Array; skinVertex: Int32Array; triangles: Int32Array } | null;
  timeS: number[];
  peakFrame: number;
  modes: Mode[];
  weights: Float32Array;
  maxErrorMm: number;
  maxDisplacementMm: number;
  /** Frames x 8: quaternions x y z w of the right and the left eye since looking ahead; null where not recorded. */
  gaze: Float32Array | null;
  landmarks: { names: string[]; timeS: number[]; positions: Float32Array };
  driven: { names: string[]; points: Vec3[] };
  held: Vec3[];
  lipCut: Vec3[];
  symmetry: SymmetryCurve | null;
  /** Where each vertex's mirror image lies on the skin at rest: three vertices each, -1 where it has none, and
   *  their weights of about 255 in all. */
  mirror: { normal: Vec3; vertices: Int32Array; weights: Uint8Array } | null;
  /** Holes of the skin: vertices around each, and the pocket attached to them. */
  openings: Opening[];
  /** `light`: a byte for each vertex of the model. */
  eyeballs: { centre: Vec3; gaze: Vec3; radiusM: number; light: Uint8Array }[];
  /** An eyeball of radius 1 with its gaze along +z; three bytes of colour a vertex. */
  eyeModel: { points: Float32Array; triangles: Uint32Array; colours: Uint8Array } | null;
  /** At rest. */
  teeth: {
    jaw: 'upper' | 'lower';
    part: 'crowns' | 'gum' | 'tongue';
    colour: Vec3;
    points: Float32Array;
    triangles: Uint32Array;
    light: Uint8Array;
  }[];
  muscles: Muscles | null;
  /** How far base is expected to be from the true face; null where that is not known. */
  uncertainty: SkinMap | null;
  /** Base first, then its variants in their order. */
  faces: Face[];
}

/** All of one type in memory: loops over several are slow. */
const stepsOf = (values: Stretch, block: Block): Int16Array =>
  values.type === 'int8' ? new Int16Array(block.int8(values)) : block.int16(values);

const modesOf = (modes: ModeData[], block: Block): Mode[] =>
  modes.map((m) => ({ stepM: m.step_m, values: stepsOf(m.values, block) }));

const mapOf = ({ values, ...map }: SkinMapData, block: Block): SkinMap => ({ ...map, bytes: block.uint8(values) });

const tissueOf = (maps: SkinMapData[] | undefined, block: Block): SkinMap[] => (maps ?? []).map((map) => mapOf(map, block));

const musclesOf = ({ time_s, few_points, groups, lines }: MuscleData): Muscles => ({
  timeS: time_s,
  fewPoints: few_points,
  groups: groups.map(({ sigma_left, sigma_right, note_left, note_right, ...group }) => ({
    ...group, sigmaLeft: sigma_left, sigmaRight: sigma_right, noteLeft: note_left ?? '', noteRight: note_right ?? '',
  })),
  lines,
});

const stillPoints = ({ middle, points }: { middle: Vec3; points: ModeData }, block: Block): Float32Array =>
  Float32Array.from(stepsOf(points.values, block), (step, i) => middle[i % 3] + points.step_m * step);

/** A mesh that does not change its shape. */
const rigidOf = (mesh: { middle: Vec3; points: ModeData; triangles: Stretch }, block: Block) => ({
  points: stillPoints(mesh, block),
  triangles: new Uint32Array(mesh.triangles.type === 'int16' ? block.int16(mesh.triangles) : block.int32(mesh.triangles)),
});

function openingOf(opening: Manifest['openings'][number], block: Block): Opening {
  const { int32, float32, uint8 } = block;
  return {
    loop: int32(opening.loop),
    rest: stillPoints(opening, block),
    rings: opening.rings,
    jaw: float32(opening.jaw),
    colours: uint8(opening.colours),
  };
}

function teethOf(row: NonNullable<Manifest['teeth']>[number], block: Block): Replay['teeth'][number] {
  const { jaw, part, colour } = row;
  return { jaw, part, colour, ...rigidOf(row, block), light: block.uint8(row.light) };
}

function facesOf(manifest: MovingManifest, block: Block): Face[] {
  const itself: Face = {
    name: 'base',
    changes: [],
    maxDisplacementMm: manifest.motion.max_displacement_mm,
    maxDifferenceMm: 0,
    maxDifferenceFrame: 0,
    difference: null,
    symmetry: manifest.symmetry,
    landmarkPositions: block.float32(manifest.landmarks.positions),
    tissue: tissueOf(manifest.tissue, block),
    muscles: manifest.muscles?.groups ?? [],
    activeMuscles: manifest.muscles?.active ?? [],
    jaw: manifest.motion.jaw ? block.float32(manifest.motion.jaw) : null,
    upperTeeth: manifest.motion.upper_teeth ?? null,
  };
  const variants = (manifest.variants ?? []).map((variant) => ({
    name: variant.name,
    changes: variant.changes,
    maxDisplacementMm: variant.max_displacement_mm,
    maxDifferenceMm: variant.max_difference_mm,
    maxDifferenceFrame: variant.max_difference_frame,
    difference: {
      modes: modesOf(variant.difference.modes, block),
      weights: block.float32(variant.difference.weights),
      maxErrorMm: variant.difference.max_error_mm,
    },
    symmetry: variant.symmetry,
    landmarkPositions: block.float32(variant.landmarks),
    tissue: tissueOf(variant.tissue, block),
    muscles: variant.muscles ?? [],
    activeMuscles: variant.active_muscles ?? [],
    jaw: variant.jaw ? block.float32(variant.jaw) : null,
    upperTeeth: variant.upper_teeth ?? null,
  }));
  return [itself, ...variants];
}

/** The fixed part of a replay: the skin at rest. */
type StillPart = 'scanVertices' | 'points' | 'triangles' | 'colour' | 'texture' | 'mirror' | 'openings' | 'eyeballs' | 'eyeModel' | 'light' | 'fade' | 'teeth';
export type Moving = Omit<Replay, StillPart>;
/** What a manifest must have for `movingOf`. */
export type MovingManifest = Omit<Manifest, 'version' | 'scan_vertices' | 'skin' | 'mirror' | 'openings' | 'eyeballs' | 'eye_model' | 'teeth'>;

function stillOf(manifest: Manifest, block: Block): Pick<Replay, StillPart> {
  const { float32, int32, uint8 } = block;
  const { skin } = manifest;
  return {
    scanVertices: manifest.scan_vertices,
    points: float32(skin.points),
    triangles: int32(skin.triangles),
    colour: skin.colour ? uint8(skin.colour) : null,
    texture: skin.texture
      ? {
          image: new Blob([uint8(skin.texture.image)], { type: skin.texture.mime_type }),
          uv: float32(skin.texture.uv),
          skinVertex: int32(skin.texture.skin_vertex),
          triangles: int32(skin.texture.triangles),
        }
      : null,
    mirror: manifest.mirror
      ? {
          normal: manifest.mirror.normal,
          vertices: int32(manifest.mirror.vertices),
          weights: uint8(manifest.mirror.weights),
        }
      : null,
    openings: manifest.openings.map((opening) => openingOf(opening, block)),
    eyeballs: manifest.eyeballs.map(({ centre, gaze, radius_m, light }) => ({ centre, gaze, radiusM: radius_m, light: uint8(light) })),
    eyeModel: manifest.eye_model ? { ...rigidOf(manifest.eye_model, block), colours: uint8(manifest.eye_model.colours) } : null,
    light: uint8(skin.light),
    fade: uint8(skin.fade),
    teeth: (manifest.teeth ?? []).map((row) => teethOf(row, block)),
  };
}

/** The parts that can change while the skin at rest stays the same. */
export function movingOf(manifest: MovingManifest, block: Block): Moving {
  usePointWords(manifest.point_words);
  const { motion } = manifest;
  return {
    title: manifest.title,
    notes: manifest.notes,
    summary: manifest.summary,
    timeS: motion.time_s,
    peakFrame: motion.peak_frame,
    modes: modesOf(motion.modes, block),
    weights: block.float32(motion.weights),
    maxErrorMm: motion.max_error_mm,
    maxDisplacementMm: motion.max_displacement_mm,
    gaze: motion.gaze ? block.float32(motion.gaze) : null,
    landmarks: {
      names: manifest.landmarks.names,
      timeS: manifest.landmarks.time_s,
      positions: block.float32(manifest.landmarks.positions),
    },
    driven: manifest.driven,
    held: manifest.held,
    lipCut: manifest.lip_cut,
    symmetry: manifest.symmetry,
    muscles: manifest.muscles ? musclesOf(manifest.muscles) : null,
    uncertainty: manifest.uncertainty ? mapOf(manifest.uncertainty, block) : null,
    faces: facesOf(manifest, block),
  };
}

export const replayOf = (manifest: Manifest, block: Block): Replay =>
  ({ ...stillOf(manifest, block), ...movingOf(manifest, block) });
