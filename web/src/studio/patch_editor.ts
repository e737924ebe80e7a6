// SPDX-License-Identifier: GPL-3.0-or-later
// The painted patches: which one is chosen, its shares while it is being painted, and how its changes reach the scene.
import type { SkinHit } from '../replay/face/face_body';
import { Refused, type Connection } from './connection';
import type { Edits } from './edits';
import {
  depthOf, factorOf, isPatch, PaintedThickness, PaintedTissue, parameterKeys, patchesOf, regionKey, rowsOf, Shares, thicknessKey, volumeShares,
  withVolume, type Factor, type Painted, type Patch, type Row,
} from './patches';
import { ownDepthMm } from './paint_controls';
import { SkinWalk } from './skin_walk';
import { mirrored, rounded, Stroke, type Brush } from './stroke';
import type { StudioState } from './studio_state';
import { words } from './words';

const ownFactor = 3;

/** Called after changes. */
export interface PatchView {
  /** Patches, or which one is chosen. */
  sync(): void;
  /** Values on the skin. */
  repaint(): void;
  /** An empty text: none. */
  report(problem: string): void;
}

export class PatchEditor {
  painted: Painted = 'tissue';
  /** Index of a patch; one past the last: a new one, which the first stroke makes. */
  chosen = 0;
  /** The parameter that is shown. */
  shownFactor: Factor = 'young';
  /** Where volume is added is shown in its place. */
  showsVolume = false;
  /** What a new patch will have. */
  fresh: Row = { young_factor: ownFactor };
  private readonly freshOf: Record<Painted, Row> = { tissue: this.fresh, thickness: { thickness_mm: ownDepthMm } };
  private readonly shares: Shares;
  private readonly tissue: PaintedTissue;
  private readonly thickness: PaintedThickness;
  private walk: SkinWalk | null = null;
  private stroke: Stroke | null = null;
  /** Shares that the scene does not have yet. */
  private hand: { patch: number; shares: Float32Array } | null = null;
  private queue: Promise<void> = Promise.resolve();
  private pending = 0;
  /** The rows as the scene will have them once all is sent. */
  private sent: Row[] | null = null;

  constructor(
    private readonly state: StudioState, private readonly edits: Edits, private readonly connection: Connection, private readonly view: PatchView,
  ) {
    this.shares = new Shares(connection);
    this.tissue = new PaintedTissue(state, this.shares);
    this.thickness = new PaintedThickness(this.shares);
    connection.on('motion', () => this.tissue.hold());
    connection.on('face', ({ thickness, block }) => {
      this.tissue.hold();
      this.thickness.unpainted = block.float32(thickness).slice();
    });
  }

  /** For a new face. */
  clear(): void {
    this.stroke = null;
    this.walk = null;
    this.hand = null;
    this.shares.clear();
  }

  get stroking(): boolean {
    return this.stroke !== null;
  }

  get patches(): Patch[] {
    return patchesOf(this.rows);
  }

  /** The row of the chosen patch. */
  get row(): Row {
    return this.patches[this.chosen]?.row ?? this.fresh;
  }

  /** The chosen patch has paint, or gets it. */
  get there(): boolean {
    return this.chosen < this.patches.length || this.pending > 0;
  }

  /** False while a change of the present patches is unfinished. */
  choosePainted(painted: Painted): boolean {
    if (this.stroke || this.pending > 0) return false;
    this.freshOf[this.painted] = this.fresh;
    this.painted = painted;
    this.fresh = this.freshOf[painted];
    this.chosen = 0;
    this.hand = null;
    this.sent = null;
    return true;
  }

  /** Chooses a patch that has this stiffness: the chosen one if it does, else a new one. */
  chooseStiffness(factor: number): void {
    const { patches } = this;
    if (patches[this.chosen] && factorOf(patches[this.chosen].row, 'young') === factor) return;
    this.chosen = patches.length;
    this.fresh = { young_factor: factor };
    this.view.sync();
  }

  /** Fetches the shares of all patches that are not here yet. */
  fetchShares(): void {
    const missing = this.patches.filter(({ file }) => !this.shares.ofFile(file));
    if (missing.length === 0) return;
    void Promise.all(missing.map(({ file }) => this.shares.fetchFile(file))).then(() => this.view.repaint(), () => {});
  }

  // Strokes.

  begin(brush: Brush): void {
    const { replay } = this.state.source;
    this.view.report('');
    this.walk ??= new SkinWalk(replay.points, replay.triangles, replay.scanVertices, replay.lipCut);
    this.hand = { patch: this.chosen, shares: this.chosenShares() };
    this.stroke = new Stroke(this.walk, this.hand.shares, brush, replay.mirror);
  }

  dab(hit: SkinHit): void {
    this.stroke?.dab(hit);
  }

  end(keep: boolean): void {
    const { stroke } = this;
    this.stroke = null;
    if (!stroke || !this.hand) return;
    if (keep) {
      this.keep(this.hand.shares, this.hand.patch);
      return;
    }
    stroke.undo();
    if (this.pending === 0) this.hand = null;
    this.view.repaint();
  }

  // Changes of the chosen patch.

  setFactor(factor: Factor, value: number, done: boolean): void {
    this.shownFactor = factor;
    this.showsVolume = false;
    this.changeRow(({ [parameterKeys[factor]]: _value, ...rest }) => ({ ...rest, [`${factor}_factor`]: value }), done);
  }

  setVolume(ml: number, done: boolean): void {
    this.showsVolume = ml !== 0;
    this.changeRow((row) => withVolume(row, ml), done);
  }

  private changeRow(change: (row: Row) => Row, done: boolean): void {
    const { rows } = this;
    const i = this.rowIndex(rows, this.chosen);
    if (i < 0) {
      this.fresh = change(this.fresh);
      this.view.sync();
      return;
    }
    const next = { [regionKey]: rows.map((row, k) => (k === i ? change(row) : row)) };
    if (done) void this.edits.commit(next);
    else this.edits.live(next);
    this.view.repaint();
  }

  /** The mesh is made anew when `done`. */
  setDepth(mm: number, done: boolean): void {
    const rows = [...this.rows];
    const i = this.rowIndex(rows, this.chosen);
    if (i < 0) {
      this.fresh = { ...this.fresh, thickness_mm: mm };
      this.view.sync();
      return;
    }
    rows[i] = { ...rows[i], thickness_mm: mm };
    this.sent = rows;
    this.view.repaint();
    if (done) this.enqueue(() => this.edits.ofBase({ [thicknessKey]: rows }));
  }

  /** `erases`: the patch is removed from the region. */
  async fill(region: string, erases: boolean): Promise<void> {
    this.view.report('');
    const shares = await this.shares.fetchRegion(region).catch((error: unknown) => {
      this.view.report(error instanceof Refused ? error.message : words.lost);
      return null;
    });
    if (!shares || !this.state.source.open) return;
    const own = this.chosenShares();
    if (shares.length !== own.length) return;
    for (let v = 0; v < own.length; ++v)
      own[v] = erases ? rounded(own[v] * (1 - shares[v])) : Math.max(own[v], rounded(shares[v]));
    this.keep(own);
  }

  mirror(): void {
    const { mirror } = this.state.source.replay;
    if (!mirror) return;
    const own = this.chosenShares();
    const other = new Float32Array(own.length);
    mirrored(mirror, own, other);
    for (let v = 0; v < own.length; ++v) own[v] = Math.max(own[v], rounded(other[v]));
    this.keep(own);
  }

  remove(): void {
    this.keep(this.noShares());
  }

  /** Values of a face on the skin as painted: of the shown parameter, in units of scene files, mm, or shares of volume. */
  values(face: number, out: Float32Array): void {
    const inHand = (patches: Patch[]) => this.hand && { ...this.hand, row: patches[this.hand.patch]?.row ?? this.fresh };
    if (this.painted === 'thickness') {
      const { patches } = this;
      this.thickness.values(patches, inHand(patches), out);
      return;
    }
    const own = face === this.state.edited;
    const patches = own ? this.patches : patchesOf(rowsOf(this.state.valuesOf(face)[regionKey]));
    if (this.showsVolume) volumeShares(this.shares, patches, own ? inHand(patches) : null, out);
    else this.tissue.values(face, patches, this.shownFactor, own ? inHand(patches) : null, out);
  }

  /** The largest value that a new patch would have, given the largest one now. */
  room(most: number): number {
    const row = this.patches[this.chosen] ? {} : this.fresh;
    if (this.showsVolume && this.painted === 'tissue') return 1;
    return this.painted === 'thickness' ? Math.max(most, depthOf(row)) : most * Math.max(factorOf(row, this.shownFactor), 1);
  }

  private get rows(): Row[] {
    return this.sent ?? rowsOf(this.painted === 'thickness' ? this.state.valuesOf(0)[thicknessKey] : this.edits.value(regionKey));
  }

  private rowIndex(rows: Row[], patch: number): number {
    return rows.indexOf(rows.filter(isPatch)[patch]);
  }

  private noShares(): Float32Array {
    return new Float32Array(this.state.source.replay.points.length / 3);
  }

  /** A copy, to be changed. */
  private chosenShares(): Float32Array {
    if (this.hand?.patch === this.chosen) return this.hand.shares.slice();
    const file = this.patches[this.chosen]?.file;
    const known = file === undefined ? null : this.shares.ofFile(file);
    return known?.slice() ?? this.noShares();
  }

  /** The shares of a patch go into the scene: one step of the history. */
  private keep(shares: Float32Array, patch = this.chosen): void {
    this.hand = { patch, shares };
    const asPainted = shares.slice();
    const fresh = { ...this.fresh };
    this.enqueue(() => this.send(patch, asPainted, fresh));
    this.view.repaint();
  }

  private enqueue(send: () => Promise<void>): void {
    ++this.pending;
    this.queue = this.queue.then(send).catch((error: unknown) => {
      this.view.report(error instanceof Refused ? error.message : words.lost);
    }).then(() => {
      if (--this.pending > 0) return;
      this.sent = null;
      if (!this.stroke) this.hand = null;
      this.view.sync();
    });
  }

  private async send(patch: number, shares: Float32Array, fresh: Row): Promise<void> {
    const vertices: number[] = [];
    shares.forEach((share, v) => {
      if (share > 0) vertices.push(v);
    });
    const rows = [...this.rows];
    const i = this.rowIndex(rows, patch);
    if (vertices.length === 0) {
      if (i < 0) return;
      rows.splice(i, 1);
    } else {
      const { file } = await this.connection.request('paint', { vertices, shares: vertices.map((v) => rounded(shares[v])) });
      if (i < 0) rows.push({ painted: file, ...fresh });
      else rows[i] = { ...rows[i], painted: file };
      // As the file has it, also where the cut between the lips has split the skin.
      await this.shares.fetchFile(file);
    }
    this.sent = rows;
    if (this.painted === 'thickness') await this.edits.ofBase({ [thicknessKey]: rows });
    else await this.edits.step({ [regionKey]: rows });
  }
}
