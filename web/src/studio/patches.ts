// SPDX-License-Identifier: GPL-3.0-or-later
// Painted patches: rows of tissue.region and mesh.thickness_region that name a file with one share per vertex, and
// these shares on the skin.
import type { Face } from '../replay/data';
import type { Connection } from './connection';
import { isRecord } from './messages';
import type { StudioState } from './studio_state';

export const regionKey = 'tissue.region';
/** A key of the scene itself: all faces have one mesh. */
export const thicknessKey = 'mesh.thickness_region';
/** The property of a patch: each face has its own tissue, all share one mesh. */
export type Painted = 'tissue' | 'thickness';
export type Row = Record<string, unknown>;
export type Factor = 'young' | 'viscosity';
/** Their keys in the section tissue, and in tissue maps. */
export const parameterKeys: Record<Factor, string> = { young: 'young_kpa', viscosity: 'viscosity_pa_s' };

export interface Patch {
  /** Its file, as the scene names it. */
  file: string;
  row: Row;
}

export const rowsOf = (value: unknown): Row[] => (Array.isArray(value) ? value.filter(isRecord) : []);
export const isPatch = (row: Row): boolean => typeof row.painted === 'string' && row.painted !== '';
export const patchesOf = (rows: Row[]): Patch[] => rows.filter(isPatch).map((row) => ({ file: String(row.painted), row }));
export const factorOf = (row: Row, factor: Factor): number => Number(row[`${factor}_factor`] ?? 1);
export const volumeOf = (row: Row): number => Number(row.volume_ml ?? 0);
export const depthOf = (row: Row): number => Number(row.thickness_mm ?? 0);

/** Keys that say where a patch is, and nothing of its tissue. */
const ofPlace = new Set(['painted', 'blend_mm']);

/** 0 removes the key. A scene refuses a patch that changes nothing: it gets a factor of 1, so that its paint is kept. */
export function withVolume(row: Row, ml: number): Row {
  const { volume_ml: _before, ...rest } = row;
  if (ml !== 0) return { ...rest, volume_ml: ml };
  return Object.keys(rest).every((key) => ofPlace.has(key)) ? { ...rest, young_factor: 1 } : rest;
}

/** The studio names its own files after their contents, so the folder does not matter. */
const nameOf = (file: string): string => file.replace(/^.*\//, '');

/** Shares of files and of named regions, fetched from the server once per face. */
export class Shares {
  private readonly known = new Map<string, Float32Array>();
  private readonly requested = new Map<string, Promise<Float32Array | null>>();

  constructor(private readonly connection: Connection) {
    connection.on('shares', ({ key, values, block }) => void this.known.set(key, block.float32(values).slice()));
  }

  /** For another face. */
  clear(): void {
    this.known.clear();
    this.requested.clear();
  }

  /** Null: not fetched yet. */
  ofFile(file: string): Float32Array | null {
    return this.known.get(nameOf(file)) ?? null;
  }

  /** Rejects where the server refuses. */
  async fetchFile(file: string): Promise<Float32Array | null> {
    return this.fetch(nameOf(file), { painted: file });
  }

  async fetchRegion(name: string): Promise<Float32Array | null> {
    return this.fetch(`region ${name}`, { name });
  }

  private fetch(key: string, region: Row): Promise<Float32Array | null> {
    let request = this.requested.get(key);
    if (!request) {
      request = this.connection.request('region_shares', { region, key }).then(() => this.known.get(key) ?? null);
      this.requested.set(key, request);
      request.catch(() => this.requested.delete(key));
    }
    return request;
  }
}

/** The values of a parameter over a face as it is being painted. */
export class PaintedTissue {
  /** For each face, the patches contained in the server's map. */
  private held: Patch[][] = [];

  constructor(private readonly state: StudioState, private readonly shares: Shares) {}

  /** After a motion, whose maps are those of the present scene. */
  hold(): void {
    this.held = (this.state.scene?.values ?? []).map((values) => patchesOf(rowsOf(values[regionKey])));
  }

  /** Values of a face with these patches, in units of scene files. `inHand` replaces the shares of its patch. */
  values(face: number, patches: Patch[], factor: Factor, inHand: { patch: number; shares: Float32Array; row: Row } | null, out: Float32Array): void {
    const shown: Face | undefined = this.state.source.replay.faces[face] ?? this.state.source.replay.faces[0];
    const map = shown.tissue.find(({ key }) => key === parameterKeys[factor]);
    if (map) for (let v = 0; v < out.length; ++v) out[v] = map.least + (map.bytes[v] / 255) * (map.greatest - map.least);
    else out.fill(Number(this.state.valuesOf(face)[`tissue.${parameterKeys[factor]}`]) || 0);
    const before = map ? this.held[face] ?? [] : [];
    const all = [...before, ...patches].map(({ file }) => this.shares.ofFile(file));
    // Until all shares are fetched, the server's map is shown.
    const whole = all.every((one, i) => one !== null || (inHand !== null && i - before.length === inHand.patch));
    if (!whole) return;
    const times = (shares: Float32Array, by: number, inverse: boolean) => {
      if (by === 1) return;
      for (let v = 0; v < out.length; ++v) {
        const part = 1 + shares[v] * (by - 1);
        // A factor of 0 cannot be taken out again: nothing is left until the server's next map.
        out[v] *= inverse ? 1 / (part || 1) : part;
      }
    };
    before.forEach(({ row }, i) => times(all[i]!, factorOf(row, factor), true));
    patches.forEach(({ row }, i) => {
      const own = inHand?.patch === i ? inHand : { shares: all[before.length + i]!, row };
      times(own.shares, factorOf(own.row, factor), false);
    });
    if (inHand && inHand.patch >= patches.length) times(inHand.shares, factorOf(inHand.row, factor), false);
  }
}

/** Where patches add or take away volume: for each vertex the greatest of their shares. */
export function volumeShares(shares: Shares, patches: Patch[], inHand: { patch: number; shares: Float32Array; row: Row } | null, out: Float32Array): void {
  out.fill(0);
  const lay = (own: Float32Array | null, row: Row) => {
    if (own && volumeOf(row) !== 0) for (let v = 0; v < out.length; ++v) out[v] = Math.max(out[v], own[v]);
  };
  patches.forEach(({ file, row }, i) => lay(inHand?.patch === i ? inHand.shares : shares.ofFile(file), inHand?.patch === i ? inHand.row : row));
  if (inHand && inHand.patch >= patches.length) lay(inHand.shares, inHand.row);
}

/** The thickness of the tissue as it is being painted, mm. */
export class PaintedThickness {
  /** For each vertex, without paint; empty: unknown. */
  unpainted: Float32Array = new Float32Array();

  constructor(private readonly shares: Shares) {}

  values(patches: Patch[], inHand: { patch: number; shares: Float32Array; row: Row } | null, out: Float32Array): void {
    if (this.unpainted.length !== out.length) {
      out.fill(0);
      return;
    }
    out.set(this.unpainted);
    const lay = (shares: Float32Array | null, row: Row) => {
      if (!shares) return;
      const depth = depthOf(row);
      for (let v = 0; v < out.length; ++v) out[v] += shares[v] * (depth - out[v]);
    };
    patches.forEach(({ file, row }, i) => lay(inHand?.patch === i ? inHand.shares : this.shares.ofFile(file), inHand?.patch === i ? inHand.row : row));
    if (inHand && inHand.patch >= patches.length) lay(inHand.shares, inHand.row);
  }
}
