// SPDX-License-Identifier: GPL-3.0-or-later
// Made by web/protocol/generate.mjs of apps/studio/protocol.json: not to be changed by hand.
import type { Stretch } from '../page/page_data';

/**
 * What the studio's page and its server say to each other. One message is one WebSocket message. Requests
 * are JSON texts {"id": n, "do": name, ...fields}; each is answered by {"answer": id, ...fields} or
 * {"answer": id, "error": "one sentence"}. Events come unasked: {"event": name, ...fields}. A message with
 * arrays is binary: the length of its JSON text (4 bytes, little-endian), the text, zeros up to a multiple
 * of 8 bytes, then the block in which fields of type array lie ({"type", "offset", "count"}, little-endian).
 * Times are seconds, lengths metres unless a name says otherwise; a face is 0 for base and 1, 2 ... for its
 * variants.
 */
export const protocolVersion = 1;

/** The first message; anything else before it ends the connection. */
export interface HelloRequest {
  /** of the address that the studio printed */
  token: string;
  /** of this protocol */
  version: number;
}
export interface HelloAnswer {
  /** name, version */
  program: string;
  /** keys of a scene: name, kind, unit, range, choices, default, description */
  keys: unknown;
  /** of variants: name, summary, source, assumed, changes */
  presets: unknown;
  /** published tissues that are so many times as stiff: name, summary, source, young_factor */
  tissues: unknown;
  /** parts of the face that tissue.region may name, alone or with _L or _R: name, meaning */
  regions: unknown;
  /** what the studio was started with: file names that open may name */
  places: unknown;
}

/**
 * Opens a face; progress follows, then the event face. What was open is closed. The answer comes when the
 * face is there.
 */
export interface OpenRequest {
  /** "embedded", "started" (what the command named), "autosave" or the name of an upload */
  what: string;
  /** name of an upload, for a scan; a zip, for a scene too */
  recording?: string;
}
export type OpenAnswer = Record<string, never>;

/**
 * Other values of keys of the scene, of base or a variant. Live: the event shape follows at once; of several
 * that wait the last counts. Not live: the event motion follows.
 */
export interface SetRequest {
  /** "tissue.young_kpa": 150, "muscles.gain": {"zyg_major_R": 0.3}; null: the key goes */
  changes: unknown;
  /** 0: base */
  face: number;
  /** while a slider is dragged */
  live: boolean;
  /** of the frame that is shown */
  time_s: number;
}
export interface SetAnswer {
  /** a later one took its place */
  superseded: boolean;
}

/** A variant like another face, or a preset of it. */
export interface AddVariantRequest {
  /** of the variant */
  name: string;
  /** the face whose changes it begins with */
  like: number;
  /** one of hello's presets */
  preset?: string;
}
export interface AddVariantAnswer {
  /** its place */
  face: number;
}

/** A variant goes; later ones move up. */
export interface RemoveVariantRequest {
  /** its place */
  face: number;
}
export type RemoveVariantAnswer = Record<string, never>;

/** Another name. */
export interface RenameVariantRequest {
  /** its place */
  face: number;
  /** the new one */
  name: string;
}
export type RenameVariantAnswer = Record<string, never>;

/**
 * Keeps what was painted on the skin as a file that "painted" of tissue.region and mesh.thickness_region may
 * name in set.
 */
export interface PaintRequest {
  /** of the skin; all others have a share of 0 */
  vertices: unknown;
  /** of each of them, above 0 to 1 */
  shares: unknown;
}
export interface PaintAnswer {
  /** its name */
  file: string;
}

/** How much of the change of a region holds where: the event shares comes before the answer. */
export interface RegionSharesRequest {
  /** a row of tissue.region: name, scar or painted; values and factors do not matter */
  region: unknown;
  /** that the event is to bear */
  key: string;
}
export type RegionSharesAnswer = Record<string, never>;

/** The scene as it was before the last change. */
export type UndoRequest = Record<string, never>;
export type UndoAnswer = Record<string, never>;

/** What undo took back. */
export type RedoRequest = Record<string, never>;
export type RedoAnswer = Record<string, never>;

/** Where a landmark of the scan lies; the face is made anew when landmarks_done is asked. */
export interface MoveLandmarkRequest {
  /** of the landmark */
  name: string;
  /** [x, y, z], metres, in the scan's frame; absent: as it was found */
  position?: unknown;
}
export interface MoveLandmarkAnswer {
  /** where it lies now, on the skin */
  position: unknown;
  /** a sentence each on landmarks that are hardly plausible */
  warnings: unknown;
}

/** The face is made anew with the landmarks as they lie; the event face follows. */
export type LandmarksDoneRequest = Record<string, never>;
export type LandmarksDoneAnswer = Record<string, never>;

/**
 * Follows a face while frames come in, from a camera or a recording played as one: events live and
 * live_shape. What was live ends. Changes of a face meanwhile show that face.
 */
export interface LiveStartRequest {
  /** the camera that the command named; the scene's motion.recording */
  what: 'device' | 'recording';
  /** whose tissue */
  face: number;
}
export type LiveStartAnswer = Record<string, never>;

/** The camera is let go; the take stays. */
export type LiveStopRequest = Record<string, never>;
export type LiveStopAnswer = Record<string, never>;

/** The face of the last moment is the one at rest. */
export type LiveNeutralRequest = Record<string, never>;
export type LiveNeutralAnswer = Record<string, never>;

/** A take begins, in the place of the one before, or ends: the event take. */
export interface LiveRecordRequest {
  /** begins */
  on: boolean;
}
export type LiveRecordAnswer = Record<string, never>;

/** A shape is on the screen: another may come. Measures the delay. */
export interface LiveDrawnRequest {
  /** of the event live_shape */
  frame: number;
}
export type LiveDrawnAnswer = Record<string, never>;

/** The take becomes the scene's motion; the event face follows. */
export interface LiveTakeRequest {
  /** since its first sample */
  from_s: number;
  /** likewise */
  to_s: number;
}
export type LiveTakeAnswer = Record<string, never>;

/** A name under which nothing lies where save writes, but what the studio wrote there itself. */
export interface FreeNameRequest {
  /** the wanted one */
  name: string;
}
export interface FreeNameAnswer {
  /** that, or with a number behind it */
  name: string;
}

/** Deletes what a session that ended has left (places.autosave of hello). Refused while it is open. */
export type DiscardAutosaveRequest = Record<string, never>;
export type DiscardAutosaveAnswer = Record<string, never>;

/** Writes into the folder that the studio was started with; never over a file that it did not write. */
export interface SaveRequest {
  /**
   * scene: the scene file and what it names; run: all that hyperex run writes; landmarks: for 3D Slicer;
   * landmarks_json: as hyperex has them
   */
  what: 'scene' | 'run' | 'report' | 'landmarks' | 'landmarks_json';
  /** of the file or folder, without an ending */
  name: string;
}
export interface SaveAnswer {
  /** where it lies */
  path: string;
}

/** Of what takes longer than a moment. */
export interface ProgressEvent {
  /** "meshing the soft tissue"; empty: done */
  stage: string;
  /** 0 to 1; below 0: not known */
  share: number;
}

/** What the command would write to its log. */
export interface SaidEvent {
  /** how grave */
  level: 'note' | 'warning' | 'error';
  /** one sentence */
  text: string;
}

/** The scene as it is now: after each change. */
export interface SceneEvent {
  /** of the scene */
  title: string;
  /** of a face each: every key with its value, in the units of scene files */
  values: unknown;
  /** of base and each variant: name, changes (key: value) */
  faces: unknown;
  /** "muscles", "displacement" or "reactions" */
  drive: string;
  /** a sentence */
  drive_why: string;
  /** whether undo has something to do */
  can_undo: boolean;
  /** likewise */
  can_redo: boolean;
  /** whether a file of the user's holds all this */
  saved: boolean;
  /** the scene file as it would be saved */
  text: string;
}

/** Binary. A face was opened: all that report.html holds (its manifest), and what can be edited. */
export interface FaceEvent {
  /** the manifest of a report (web/src/replay/manifest.ts), its stretches in this message's block */
  replay: unknown;
  /**
   * of the scan: name, other (that of the other side, or its own), position (m), found (whether by the
   * program)
   */
  landmarks: unknown;
  /** names, branches and sides that gains may name */
  muscles: unknown;
  /**
   * of the muscles over time, where they drive: names, time_s, faces (an array a face: float32, names x
   * times); else null
   */
  activations: unknown;
  /**
   * float32, one a vertex of the skin: of the soft tissue, mm, without what is painted
   * (mesh.thickness_region)
   */
  thickness: Stretch;
}

/** Binary. Some faces move otherwise now: replaces what the last face or motion event said of them. */
export interface MotionEvent {
  /** as in the event face, without skin, texture, mirror, openings and eyeballs */
  replay: unknown;
  /** rows of variants.csv as JSON: what differs from base, in millimetres */
  table: unknown;
  /** as in the event face */
  activations: unknown;
  /** that it took */
  seconds: number;
  /** error bands are known; false: they follow when nothing else is to do, in another such event */
  bands: boolean;
}

/** How the live face goes, some times a second. */
export interface LiveEvent {
  /** for a face; its shape at rest; what it does */
  state: 'looking' | 'learning' | 'following' | 'ended';
  /** a sentence, or empty */
  problem: string;
  /** that were tracked */
  frames: number;
  /** of those, in which the face was followed */
  valid: number;
  /** that came while the one before was worked on */
  dropped: number;
  /** that were not sent, as the page had not drawn those before */
  not_drawn: number;
  /** that the page has drawn */
  drawn: number;
  /** in the last second */
  drawn_a_second: number;
  /** from having a camera's frame to having it drawn, median of the last ones; null: none yet */
  delay_ms: unknown;
  /** 95 % within */
  delay_95_ms: unknown;
  /** of that, alignment and simulation */
  step_ms: number;
  /** a take */
  recording: boolean;
  /** its length */
  take_s: number;
}

/** Binary. The live face in one frame; answered by live_drawn. */
export interface LiveShapeEvent {
  /** whose tissue */
  face: number;
  /** its number */
  frame: number;
  /** of the camera's clock */
  time_s: number;
  /** displacement = step_m * values */
  step_m: number;
  /** int16, three a vertex */
  values: Stretch;
}

/** A take was recorded. */
export interface TakeEvent {
  /** of each sample, since the first */
  time_s: unknown;
  /** of each sample the farthest way of a point from the neutral face */
  moved_mm: unknown;
}

/** Binary. Where a region's change holds. */
export interface SharesEvent {
  /** as it was asked */
  key: string;
  /** float32, one a vertex of the skin, 0 to 1 */
  values: Stretch;
}

/** Binary. One face at one instant, in static equilibrium: while a slider is dragged. */
export interface ShapeEvent {
  /** whose */
  face: number;
  /** the instant */
  time_s: number;
  /** displacement = step_m * values */
  step_m: number;
  /** int16, three a vertex */
  values: Stretch;
  /** that it took */
  seconds: number;
}

/** What may be asked, and how it is answered. */
export interface Requests {
  hello: { fields: HelloRequest; answer: HelloAnswer };
  open: { fields: OpenRequest; answer: OpenAnswer };
  set: { fields: SetRequest; answer: SetAnswer };
  add_variant: { fields: AddVariantRequest; answer: AddVariantAnswer };
  remove_variant: { fields: RemoveVariantRequest; answer: RemoveVariantAnswer };
  rename_variant: { fields: RenameVariantRequest; answer: RenameVariantAnswer };
  paint: { fields: PaintRequest; answer: PaintAnswer };
  region_shares: { fields: RegionSharesRequest; answer: RegionSharesAnswer };
  undo: { fields: UndoRequest; answer: UndoAnswer };
  redo: { fields: RedoRequest; answer: RedoAnswer };
  move_landmark: { fields: MoveLandmarkRequest; answer: MoveLandmarkAnswer };
  landmarks_done: { fields: LandmarksDoneRequest; answer: LandmarksDoneAnswer };
  live_start: { fields: LiveStartRequest; answer: LiveStartAnswer };
  live_stop: { fields: LiveStopRequest; answer: LiveStopAnswer };
  live_neutral: { fields: LiveNeutralRequest; answer: LiveNeutralAnswer };
  live_record: { fields: LiveRecordRequest; answer: LiveRecordAnswer };
  live_drawn: { fields: LiveDrawnRequest; answer: LiveDrawnAnswer };
  live_take: { fields: LiveTakeRequest; answer: LiveTakeAnswer };
  free_name: { fields: FreeNameRequest; answer: FreeNameAnswer };
  discard_autosave: { fields: DiscardAutosaveRequest; answer: DiscardAutosaveAnswer };
  save: { fields: SaveRequest; answer: SaveAnswer };
}

/** What comes unasked. */
export interface Events {
  progress: ProgressEvent;
  said: SaidEvent;
  scene: SceneEvent;
  face: FaceEvent;
  motion: MotionEvent;
  live: LiveEvent;
  live_shape: LiveShapeEvent;
  take: TakeEvent;
  shares: SharesEvent;
  shape: ShapeEvent;
}
