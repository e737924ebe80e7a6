// SPDX-License-Identifier: GPL-3.0-or-later
// Tissue by brush: patches that are so many times as stiff or viscous, or so thick, painted, erased, filled and
// mirrored on the face; each stroke is a step that can be undone. The map of the tissue is seen while one paints.
import { at, button, element } from '../page/dom';
import { upper } from '../page/format';
import { niceCeiling } from '../replay/face/colour';
import type { Colouring, Scale } from '../replay/face/colouring';
import type { SkinHit } from '../replay/face/face_body';
import type { Stage } from '../replay/face/stage';
import { BrushInHand, type Painter } from './brush';
import { Refused, type Connection } from './connection';
import type { Edits } from './edits';
import { isRecord, type Preset, type StifferTissue } from './messages';
import {
  depthOf, factorOf, isPatch, PaintedThickness, PaintedTissue, parameterKeys, patchesOf, regionKey, rowsOf, Shares, thicknessKey, type Factor, type Row,
} from './patches';
import { regionChooser } from './region_chooser';
import { SkinWalk } from './skin_walk';
import { linear, logarithmic, Slider } from './slider';
import { mirrored, rounded, Stroke } from './stroke';
import type { StudioState } from './studio_state';
import { words } from './words';

type Tool = 'turn' | 'paint' | 'erase' | 'scar';
const tools: Tool[] = ['turn', 'paint', 'erase', 'scar'];
/** What the patches are of: each face has its own tissue, all have one mesh. */
type What = 'tissue' | 'thickness';

/** What a patch may be from the start: a factor of the stiffness with its source. */
interface Kind {
  name: string;
  factor: number;
  source: string;
}

interface Size {
  widthMm: number;
  hardness: number;
  strength: number;
}

const ownFactor = 3;
const ownDepthMm = 10;
const threeDigits = (value: number): number => Number(value.toPrecision(3));

export class PaintPanel implements Painter {
  readonly element = element('div', '', 'panel paint-panel');
  private readonly shares: Shares;
  private readonly tissue: PaintedTissue;
  private readonly thickness: PaintedThickness;
  private kinds: Kind[] = [];
  private what: What = 'tissue';
  private tool: Tool = 'paint';
  private readonly sizes: { brush: Size; scar: Size } = {
    brush: { widthMm: 20, hardness: 30, strength: 100 }, scar: { widthMm: 8, hardness: 50, strength: 100 },
  };
  /** Place among the patches; past the last: another one, to be made by the first stroke. */
  private chosen = 0;
  /** What a patch that is not there yet will have. */
  private fresh: Row = { young_factor: ownFactor };
  private readonly freshOf: Record<What, Row> = { tissue: this.fresh, thickness: { thickness_mm: ownDepthMm } };
  private shown: Factor = 'young';
  private greatest = 1;

  private stage: Stage | null = null;
  private brush: BrushInHand | null = null;
  private walk: SkinWalk | null = null;
  private stroke: Stroke | null = null;
  /** Shares that the scene does not have yet. */
  private hand: { patch: number; shares: Float32Array } | null = null;
  private queue: Promise<void> = Promise.resolve();
  private pending = 0;
  /** Of strokes on their way. */
  private sent: Row[] | null = null;
  private visible = false;

  private readonly toolButtons = new Map<Tool, HTMLButtonElement>();
  private readonly patch = element('select');
  private readonly whatChoice = element('select');
  private readonly kind = element('select');
  private readonly source = element('p', '', 'why');
  private readonly problem = element('p', '', 'problem');
  private readonly both = element('input');
  private factors: Record<Factor, Slider> | null = null;
  private depth: Slider | null = null;
  /** What only tissue has. */
  private readonly ofTissue: HTMLElement[] = [];
  private readonly ofAll = element('p', words.paintThicknessOfAll, 'why');
  private width: Slider | null = null;
  private readonly feel: { key: 'hardness' | 'strength'; slider: Slider }[] = [];
  private readonly needShares: HTMLButtonElement[] = [];

  constructor(private readonly state: StudioState, private readonly edits: Edits, private readonly connection: Connection) {
    this.shares = new Shares(connection);
    this.tissue = new PaintedTissue(state, this.shares);
    this.thickness = new PaintedThickness(this.shares);
    state.sceneChanged.add(() => this.sync());
    state.shown.onChange(() => this.sync());
    connection.on('motion', () => this.tissue.hold());
    connection.on('face', ({ thickness, block }) => {
      this.tissue.hold();
      this.thickness.unpainted = block.float32(thickness).slice();
    });
  }

  /** Once what there is to choose from is known. */
  build(presets: Preset[], tissues: StifferTissue[]): void {
    this.kinds = [...scarKind(presets, this.sizes.scar), ...tissues.map(({ name, source, young_factor: factor }) => (
      { name: words.paintTissue(name.replaceAll('_', ' ')), factor, source }))];
    this.element.replaceChildren();
    this.ofTissue.length = 0;
    this.addWhat();
    this.addTools();
    this.addPatch();
    this.addBrush();
    this.addFactors();
    this.addFill();
    this.problem.setAttribute('role', 'alert');
    this.problem.hidden = true;
    this.element.append(this.problem, element('p', words.paintKeys, 'why paint-keys'));
    this.chooseTool(this.tool);
    this.sync();
  }

  /** Of a new face; null: the one that was goes. */
  attach(stage: Stage | null): void {
    this.letGo();
    this.stage = stage;
    this.walk = null;
    this.hand = null;
    this.shares.clear();
    if (this.visible) this.takeUp();
  }

  /** The panel comes into view or goes. */
  seen(now: boolean): void {
    this.visible = now;
    if (now) this.takeUp();
    else this.letGo();
  }

  /** After a motion came. */
  refresh(): void {
    if (this.brush) this.repaint(true);
  }

  // What the brush asks.

  radiusM(): number | null {
    return this.tool === 'turn' ? null : this.size.widthMm / 2e3;
  }

  begin(): void {
    const { replay } = this.state.source;
    this.state.playback.pause();
    this.tell('');
    this.walk ??= new SkinWalk(replay.points, replay.triangles, replay.scanVertices, replay.lipCut);
    this.hand = { patch: this.chosen, shares: this.chosenShares() };
    const { hardness, strength } = this.size;
    this.stroke = new Stroke(this.walk, this.hand.shares, {
      radiusM: this.size.widthMm / 2e3, hardness: hardness / 100, strength: strength / 100,
      erases: this.tool === 'erase', mirrored: this.both.checked,
    }, replay.mirror);
  }

  dab(at: SkinHit): void {
    this.stroke?.dab(at);
    this.stage?.repaint();
  }

  end(keep: boolean): void {
    const { stroke } = this;
    this.stroke = null;
    if (!stroke || !this.hand) return;
    if (keep) this.keep();
    else {
      stroke.undo();
      if (this.pending === 0) this.hand = null;
      this.repaint(true);
    }
  }

  widen(steps: number): void {
    this.size.widthMm = threeDigits(Math.min(Math.max(this.size.widthMm * 1.15 ** steps, 3), 80));
    this.showSize();
  }

  say(what: 'down' | 'up'): void {
    at('said').textContent = what === 'down' ? words.paintDown : words.paintUp;
  }

  // The page's part.

  private get size(): Size {
    return this.tool === 'scar' ? this.sizes.scar : this.sizes.brush;
  }

  private get rows(): Row[] {
    return this.sent ?? rowsOf(this.what === 'thickness' ? this.state.valuesOf(0)[thicknessKey] : this.edits.value(regionKey));
  }

  /** Of the chosen patch, to be changed. */
  private chosenShares(): Float32Array {
    if (this.hand?.patch === this.chosen) return this.hand.shares.slice();
    const file = patchesOf(this.rows)[this.chosen]?.file;
    const known = file === undefined ? null : this.shares.ofFile(file);
    return known?.slice() ?? new Float32Array(this.state.source.replay.points.length / 3);
  }

  private takeUp(): void {
    const viewer = this.stage?.face;
    if (!viewer || this.brush) return;
    this.state.playback.pause();
    this.brush = new BrushInHand(viewer, this);
    this.repaint(true);
    this.stage!.lend(this.colouring());
    this.showTool();
    this.sync();
  }

  private letGo(): void {
    this.brush?.dispose();
    this.brush = null;
    this.stage?.lend(null);
    at('canvas-host').classList.remove('painting');
  }

  private addWhat(): void {
    const label = element('label', '', 'part');
    label.title = words.paintWhatHint;
    label.append(element('span', words.paintWhat), this.whatChoice);
    this.whatChoice.id = 'paint-what';
    this.whatChoice.replaceChildren(new Option(words.paintWhatTissue, 'tissue'), new Option(words.paintWhatThickness, 'thickness'));
    this.whatChoice.value = this.what;
    this.whatChoice.addEventListener('change', () => this.choose(this.whatChoice.value as What));
    this.element.append(label, this.ofAll);
  }

  private choose(what: What): void {
    if (this.stroke || this.pending > 0) {
      this.whatChoice.value = this.what;
      return;
    }
    this.freshOf[this.what] = this.fresh;
    this.what = what;
    this.fresh = this.freshOf[what];
    this.chosen = 0;
    this.hand = null;
    this.sent = null;
    if (what === 'thickness' && this.tool === 'scar') this.chooseTool('paint');
    this.sync();
    // Its name and its bar too.
    if (this.brush) this.stage?.lend(this.colouring());
  }

  private addTools(): void {
    const row = element('div', '', 'paint-tools');
    const segments = element('div', '', 'segments');
    segments.setAttribute('role', 'group');
    segments.setAttribute('aria-label', words.paintTools);
    for (const tool of tools) {
      const made = button(words.paintToolNames[tool], '', () => this.chooseTool(tool));
      made.title = words.paintToolHints[tool];
      made.dataset.tool = tool;
      this.toolButtons.set(tool, made);
      if (tool === 'scar') this.ofTissue.push(made);
      segments.append(made);
    }
    Object.assign(this.both, { type: 'checkbox', id: 'paint-both' });
    const label = element('label', '', 'check');
    label.title = words.paintBothHint;
    label.append(this.both, words.paintBoth);
    row.append(segments, label);
    this.element.append(row);
  }

  private addPatch(): void {
    const choose = element('label', '', 'part');
    choose.append(element('span', words.paintPatch), this.patch);
    this.patch.id = 'paint-patch';
    this.patch.addEventListener('change', () => {
      this.chosen = Number(this.patch.value);
      this.sync();
    });
    const kind = element('label', '', 'part');
    kind.append(element('span', words.paintKind), this.kind);
    this.kind.id = 'paint-kind';
    this.kind.replaceChildren(
      new Option(words.paintOwn, ''), ...this.kinds.map(({ name, factor }, i) => new Option(words.paintTimes(name, factor), String(i))));
    this.kind.addEventListener('change', () => {
      const known = this.kinds[Number(this.kind.value)];
      if (this.kind.value !== '' && known) this.setFactor('young', known.factor, true);
    });
    const of = (factor: Factor, name: string, hint: string): Slider => {
      const slider = new Slider({
        name, unit: '×', hint, course: logarithmic(0.1, 10), round: threeDigits, low: 0.001, high: 1000,
        live: (value) => this.setFactor(factor, value, false),
        done: (value) => this.setFactor(factor, value ?? 1, true),
      });
      slider.element.dataset.paint = factor;
      return slider;
    };
    this.factors = {
      young: of('young', words.paintStiffness, words.paintStiffnessHint),
      viscosity: of('viscosity', words.paintViscosity, words.paintViscosityHint),
    };
    const row = element('div', '', 'paint-patch');
    this.depth = new Slider({
      name: words.paintThickness, unit: 'mm', hint: words.paintThicknessHint, course: logarithmic(1, 40), round: threeDigits, low: 1, high: 40,
      live: (value) => this.setDepth(value, false),
      done: (value) => this.setDepth(value ?? ownDepthMm, true),
    });
    this.depth.element.dataset.paint = 'thickness';
    row.append(choose, kind);
    this.ofTissue.push(kind, this.source);
    this.element.append(row);
  }

  private addBrush(): void {
    const box = element('div', '', 'paint-brush');
    this.width = new Slider({
      name: words.paintWidth, unit: 'mm', hint: words.paintWidthHint, course: logarithmic(3, 80), round: threeDigits, low: 1, high: 80,
      live: (value) => this.setSize('widthMm', value), done: (value) => this.setSize('widthMm', value ?? this.size.widthMm),
    });
    this.width.element.dataset.paint = 'width';
    box.append(this.width.element);
    this.feel.length = 0;
    for (const [key, name, hint, low] of [
      ['hardness', words.paintHardness, words.paintHardnessHint, 0], ['strength', words.paintStrength, words.paintStrengthHint, 5],
    ] as const) {
      const slider = new Slider({
        name, unit: '%', hint, course: linear(low, key === 'hardness' ? 95 : 100), round: Math.round, low, high: key === 'hardness' ? 95 : 100,
        live: (value) => this.setSize(key, value), done: (value) => this.setSize(key, value ?? this.size[key]),
      });
      slider.element.dataset.paint = key;
      this.feel.push({ key, slider });
      box.append(slider.element);
    }
    this.element.append(box);
  }

  private addFactors(): void {
    const box = element('div', '', 'paint-brush');
    box.append(this.factors!.young.element, this.factors!.viscosity.element, this.depth!.element);
    this.ofTissue.push(this.factors!.young.element, this.factors!.viscosity.element);
    this.element.append(box, this.source);
  }

  private addFill(): void {
    const box = element('div', '', 'region paint-fill');
    const region = regionChooser(this.state.regions);
    region.id = 'paint-region';
    const fill = button(words.paintFill, 'quiet', () => void this.fill(region.value));
    fill.title = words.paintFillHint;
    const row = element('div', '', 'part');
    const label = element('label', '', 'part');
    label.append(element('span', words.regionChoose), region);
    row.append(label, fill);
    const mirror = button(words.paintMirror, 'quiet', () => this.mirror());
    mirror.title = words.paintMirrorHint;
    const clear = button(words.paintClear, 'quiet', () => this.clear());
    clear.title = words.paintClearHint;
    this.needShares.splice(0, Infinity, mirror, clear);
    const buttons = element('div', '', 'landmark-buttons');
    buttons.append(mirror, clear);
    box.append(row, buttons);
    this.element.append(box);
  }

  private chooseTool(tool: Tool): void {
    this.tool = tool;
    // A scar is a patch of its own.
    if (tool === 'scar' && this.kinds[0]) {
      const patches = patchesOf(this.rows);
      if (!patches[this.chosen] || factorOf(patches[this.chosen].row, 'young') !== this.kinds[0].factor) {
        this.chosen = patches.length;
        this.fresh = { young_factor: this.kinds[0].factor };
        this.sync();
      }
    }
    this.showTool();
    this.showSize();
  }

  private showTool(): void {
    for (const [tool, made] of this.toolButtons) made.setAttribute('aria-pressed', String(tool === this.tool));
    at('canvas-host').classList.toggle('painting', this.brush !== null && this.tool !== 'turn');
    this.brush?.show();
  }

  private setSize(key: keyof Size, value: number): void {
    this.size[key] = value;
    this.brush?.show();
    this.showSize();
  }

  private showSize(): void {
    this.width?.set(this.size.widthMm, null);
    for (const { key, slider } of this.feel) slider.set(this.size[key], null);
    this.brush?.show();
  }

  /** Of the chosen patch. */
  private setFactor(factor: Factor, value: number, done: boolean): void {
    this.shown = factor;
    const key = `${factor}_factor`;
    const { rows } = this;
    const i = rows.indexOf(rows.filter(isPatch)[this.chosen]);
    if (i < 0) {
      this.fresh = { ...this.fresh, [key]: value };
      this.sync();
      return;
    }
    const { [parameterKeys[factor]]: _value, ...rest } = rows[i];
    const next = { [regionKey]: rows.map((row, k) => (k === i ? { ...rest, [key]: value } : row)) };
    if (done) void this.edits.commit(next);
    else this.edits.live(next);
    this.repaint(true);
  }

  /** Of the chosen patch. The mesh is made anew once it is let go. */
  private setDepth(depth: number, done: boolean): void {
    const rows = [...this.rows];
    const i = rows.indexOf(rows.filter(isPatch)[this.chosen]);
    if (i < 0) {
      this.fresh = { ...this.fresh, thickness_mm: depth };
      this.sync();
      return;
    }
    rows[i] = { ...rows[i], thickness_mm: depth };
    this.sent = rows;
    this.repaint(true);
    if (done) this.enqueue(() => this.edits.ofBase({ [thicknessKey]: rows }));
  }

  private async fill(region: string): Promise<void> {
    this.tell('');
    const shares = await this.shares.fetchRegion(region).catch((error: unknown) => {
      this.tell(error instanceof Refused ? error.message : words.lost);
      return null;
    });
    if (!shares || !this.state.source.open) return;
    const own = this.chosenShares();
    if (shares.length !== own.length) return;
    const erases = this.tool === 'erase';
    for (let v = 0; v < own.length; ++v)
      own[v] = erases ? rounded(own[v] * (1 - shares[v])) : Math.max(own[v], rounded(shares[v]));
    this.hand = { patch: this.chosen, shares: own };
    this.keep();
  }

  private mirror(): void {
    const { mirror } = this.state.source.replay;
    if (!mirror) return;
    const own = this.chosenShares();
    const other = new Float32Array(own.length);
    mirrored(mirror, own, other);
    for (let v = 0; v < own.length; ++v) own[v] = Math.max(own[v], rounded(other[v]));
    this.hand = { patch: this.chosen, shares: own };
    this.keep();
  }

  private clear(): void {
    this.hand = { patch: this.chosen, shares: new Float32Array(this.state.source.replay.points.length / 3) };
    this.keep();
  }

  /** What is in the hand goes into the scene: one step of the history. */
  private keep(): void {
    const { patch, shares } = this.hand!;
    const asPainted = shares.slice();
    const fresh = { ...this.fresh };
    this.enqueue(() => this.send(patch, asPainted, fresh));
    this.repaint(true);
  }

  private enqueue(send: () => Promise<void>): void {
    ++this.pending;
    this.queue = this.queue.then(send).catch((error: unknown) => {
      this.tell(error instanceof Refused ? error.message : words.lost);
    }).then(() => {
      if (--this.pending > 0) return;
      this.sent = null;
      if (!this.stroke) this.hand = null;
      this.sync();
    });
  }

  private async send(patch: number, shares: Float32Array, fresh: Row): Promise<void> {
    const vertices: number[] = [];
    shares.forEach((share, v) => {
      if (share > 0) vertices.push(v);
    });
    const rows = [...this.rows];
    const i = rows.indexOf(rows.filter(isPatch)[patch]);
    if (vertices.length === 0) {
      if (i < 0) return;
      rows.splice(i, 1);
    } else {
      const { file } = await this.connection.ask('paint', { vertices, shares: vertices.map((v) => rounded(shares[v])) });
      if (i < 0) rows.push({ painted: file, ...fresh });
      else rows[i] = { ...rows[i], painted: file };
      // As the file has it: also where the cut between the lips has parted the skin.
      await this.shares.fetchFile(file);
    }
    this.sent = rows;
    if (this.what === 'thickness') await this.edits.ofBase({ [thicknessKey]: rows });
    else await this.edits.step({ [regionKey]: rows });
  }

  /** The patches of the face that is changed, as the scene has them. */
  private sync(): void {
    if (!this.state.scene || !this.factors) return;
    const patches = patchesOf(this.rows);
    if (this.chosen > patches.length) this.chosen = patches.length;
    this.patch.replaceChildren(
      ...patches.map(({ row }, i) => new Option(
        this.what === 'thickness' ? words.paintPatchDepth(i + 1, depthOf(row)) : words.paintPatchName(i + 1, factorOf(row, 'young')), String(i))),
      new Option(words.paintNew, String(patches.length)));
    this.patch.value = String(this.chosen);
    const row = patches[this.chosen]?.row ?? this.fresh;
    const young = factorOf(row, 'young');
    const known = this.kinds.findIndex(({ factor }) => factor === young);
    this.kind.value = known < 0 ? '' : String(known);
    this.source.textContent = known < 0 ? words.paintOwnSource : this.kinds[known].source;
    this.factors.young.set(young, null);
    this.factors.viscosity.set(factorOf(row, 'viscosity'), null);
    this.depth!.set(depthOf(row) || ownDepthMm, null);
    for (const one of this.ofTissue) one.hidden = this.what !== 'tissue';
    this.depth!.element.hidden = this.ofAll.hidden = this.what !== 'thickness';
    const { source } = this.state;
    this.both.disabled = !source.open || !source.replay.mirror;
    const there = this.chosen < patches.length || this.pending > 0;
    for (const one of this.needShares) one.disabled = !there;
    this.needShares[0].disabled ||= this.both.disabled;
    const missing = patches.filter(({ file }) => !this.shares.ofFile(file));
    if (this.brush && missing.length > 0)
      void Promise.all(missing.map(({ file }) => this.shares.fetchFile(file))).then(() => this.repaint(true), () => {});
    this.repaint(true);
  }

  private values(face: number, out: Float32Array): void {
    if (this.what === 'thickness') {
      const patches = patchesOf(this.rows);
      this.thickness.values(patches, this.hand && { ...this.hand, row: patches[this.hand.patch]?.row ?? this.fresh }, out);
      return;
    }
    const own = face === this.state.edited;
    const patches = own ? patchesOf(this.rows) : patchesOf(rowsOf(this.state.valuesOf(face)[regionKey]));
    const { hand } = this;
    const inHand = own && hand ? { ...hand, row: patches[hand.patch]?.row ?? this.fresh } : null;
    this.tissue.values(face, patches, this.shown, inHand, out);
  }

  /** `anew`: the range of the colours too. */
  private repaint(anew: boolean): void {
    if (!this.brush || !this.state.source.open) return;
    if (anew && !this.stroke) {
      const { replay } = this.state.source;
      const values = new Float32Array(replay.points.length / 3);
      let most = 0;
      for (const face of new Set(this.state.shown.visible)) {
        this.values(face, values);
        for (const value of values) most = Math.max(most, value);
      }
      // A patch that is to come has room.
      const row = patchesOf(this.rows)[this.chosen] ? {} : this.fresh;
      this.greatest = niceCeiling(this.what === 'thickness' ? Math.max(most, depthOf(row)) : most * Math.max(factorOf(row, this.shown), 1));
    }
    this.stage?.repaint();
  }

  private colouring(): Colouring {
    const scale = (): Scale => {
      if (this.what === 'thickness')
        return { ramp: 'sea', title: words.paintThicknessMap, unit: 'mm', least: 0, greatest: this.greatest, remark: words.paintRemark };
      const key = `tissue.${parameterKeys[this.shown]}`;
      return {
        ramp: 'sea', title: words.keyNames[key], unit: this.state.keys.get(key)?.unit ?? '', least: 0, greatest: this.greatest,
        remark: words.paintRemark,
      };
    };
    return {
      key: 'painted', label: words.paintMap,
      of: () => ({
        scale: scale(),
        fill: (shape, out) => {
          this.values(Math.max(this.state.source.replay.faces.indexOf(shape.face), 0), out);
          for (let v = 0; v < out.length; ++v) out[v] /= this.greatest;
        },
        note: () => '',
      }),
    };
  }

  private tell(problem: string): void {
    this.problem.textContent = problem;
    this.problem.hidden = problem === '';
  }
}

/** The scar that a preset of variants has, and how wide it is. */
function scarKind(presets: Preset[], size: Size): Kind[] {
  for (const { changes, source, assumed } of presets) {
    const rows = isRecord(changes.tissue) ? rowsOf(changes.tissue.region) : [];
    const scar = rows.find((row) => Array.isArray(row.scar) && typeof row.young_factor === 'number');
    if (!scar) continue;
    if (typeof scar.width_mm === 'number') size.widthMm = scar.width_mm;
    return [{ name: upper(words.paintScar), factor: Number(scar.young_factor), source: words.presetSource(source, assumed) }];
  }
  return [];
}
