// SPDX-License-Identifier: GPL-3.0-or-later
// The state of the page: the server's scene, the face's data, which face is shown and edited.
import { Listeners } from '../page/listeners';
import { ChangingSource } from '../replay/data_source';
import type { Face } from '../replay/data';
import { Playback } from '../replay/playback';
import { Shown } from '../replay/shown';
import { changeWords } from '../replay/change_words';
import type { Bounds } from './bounds';
import { words } from './words';
import { isRecord, type MuscleInfo, type Region, type SceneKey, type SceneNow, type Values } from './messages';

/** {"tissue.young_kpa": 150} as a report's summary has it: {"tissue": {"young_kpa": 150}}. */
export function nested(values: Values): Record<string, unknown> {
  const out: Record<string, unknown> = {};
  for (const [path, value] of Object.entries(values)) {
    const parts = path.split('.');
    const last = parts.pop()!;
    let inner = out;
    for (const part of parts) inner = (inner[part] ??= {}) as Record<string, unknown>;
    inner[last] = value;
  }
  return out;
}

/** The key of a scene: strengths of muscles by name. */
export const gainKey = 'muscles.gain';

export const gainsIn = (value: unknown): Record<string, number> => (isRecord(value) ? (value as Record<string, number>) : {});

export class StudioState {
  readonly source = new ChangingSource();
  readonly shown = new Shown(1);
  readonly playback = new Playback(0, 0);
  readonly sceneChanged = new Listeners();
  keys = new Map<string, SceneKey>();
  muscles: MuscleInfo[] = [];
  regions: Region[] = [];
  scene: SceneNow | null = null;
  /** The base itself may be changed, not only another face beside it. */
  changeBase = false;

  /** The face that changes apply to: the right one where two are shown. */
  get edited(): number {
    const { visible } = this.shown;
    return visible[visible.length - 1];
  }

  valuesOf(face: number): Values {
    return this.scene?.values[face] ?? this.scene?.values[0] ?? {};
  }

  /** Strengths of muscles that a face changes: muscles.gain. */
  gainsOf(face: number): Record<string, number> {
    return gainsIn(this.valuesOf(face)[gainKey]);
  }

  /** What the scene allows of a key's numbers, or of those in a column of its tables, in their unit. */
  boundsOf(key: string, column = ''): Bounds {
    const described = this.keys.get(key);
    const one = column ? described?.columns?.find(({ name }) => name === column) : described;
    if (!one) throw new Error(`not described: ${key} ${column}`);
    return { low: one.low ?? -Infinity, high: one.high ?? Infinity, above: one.above_low ?? false };
  }

  /** The place of the variant with this name; 0, base, for the empty name. */
  faceCalled(variant: string): number {
    const faces = this.scene?.faces ?? [];
    return variant === '' ? 0 : Math.max(faces.findIndex(({ name }, i) => i > 0 && name === variant), 0);
  }

  /** The scene's title, or "SCAN, moved by RECORDING"; "" where both are unknown. */
  get called(): string {
    if (this.scene?.title) return this.scene.title;
    const values = this.valuesOf(0);
    const file = (key: string) => (typeof values[key] === 'string' ? (values[key] as string).replace(/^.*[\\/]/, '') : '');
    const scan = file('scan.file') === 'embedded' ? words.embedded : file('scan.file');
    const recording = ['file', 'recording', 'arkit', 'openface'].map((key) => file(`motion.${key}`)).find((name) => name !== '');
    return scan && recording ? words.movedBy(scan, recording) : scan;
  }

  nameOf(face: number): string {
    return this.scene?.faces[face]?.name ?? '';
  }

  /** What differs from base in a variant, a sentence each. */
  changesOf(face: number): string[] {
    const latinOf = (stem: string): string => this.muscles.find(({ name }) => name === stem)?.latin ?? '';
    return changeWords(this.scene?.faces[face]?.changes ?? {}, nested(this.valuesOf(0)), latinOf);
  }

  /** A name that no other face has yet. */
  freeName(wanted: string, own = -1): string {
    const taken = new Set(this.scene?.faces.filter((_, i) => i !== own).map(({ name }) => name));
    for (let n = 1; ; ++n) {
      const name = n === 1 ? wanted : `${wanted} ${n}`;
      if (!taken.has(name)) return name;
    }
  }

  setScene(scene: SceneNow): void {
    this.scene = scene;
    this.sceneChanged.notify();
  }

  /** A face that moves like another until the server has computed its own motion. */
  addLike(like: number, name: string): void {
    const { replay } = this.source;
    const face: Face = { ...replay.faces[like], name, changes: [] };
    face.difference ??= { modes: [], weights: new Float32Array(0), maxErrorMm: 0 };
    this.source.setMotion({ ...replay, faces: [...replay.faces, face] });
  }

  without(face: number): void {
    const { replay } = this.source;
    this.source.setMotion({ ...replay, faces: replay.faces.filter((_, i) => i !== face) });
  }
}
