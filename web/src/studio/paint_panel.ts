// SPDX-License-Identifier: GPL-3.0-or-later
// Painting tissue with a brush: patches of other stiffness, viscosity or thickness are painted, erased, filled and
// mirrored on the face. Each stroke can be undone. The skin shows the painted parameter meanwhile.
import { at, element } from '../page/dom';
import { upper } from '../page/format';
import type { SkinHit } from '../replay/face/face_body';
import type { Stage } from '../replay/face/stage';
import { BrushInHand, type Painter } from './brush';
import type { Connection } from './connection';
import type { Edits } from './edits';
import { isRecord, type Preset, type StifferTissue } from './messages';
import { PaintControls, type Kind, type PaintActions, type Size, type Tool } from './paint_controls';
import { PaintMap } from './paint_map';
import { PatchEditor, type PatchView } from './patch_editor';
import { rowsOf, type Factor, type Painted } from './patches';
import { threeDigits } from './slider';
import type { StudioState } from './studio_state';
import { words } from './words';

export class PaintPanel implements Painter, PaintActions, PatchView {
  readonly element = element('div', '', 'panel paint-panel');
  private readonly editor: PatchEditor;
  private readonly map: PaintMap;
  /** Null until the server has sent the choices. */
  private controls: PaintControls | null = null;
  private scar: Kind | null = null;
  private tool: Tool = 'paint';
  private readonly sizes: { brush: Size; scar: Size } = {
    brush: { widthMm: 20, hardness: 30, strength: 100 }, scar: { widthMm: 8, hardness: 50, strength: 100 },
  };
  private stage: Stage | null = null;
  private brush: BrushInHand | null = null;
  private visible = false;

  constructor(private readonly state: StudioState, edits: Edits, connection: Connection) {
    this.editor = new PatchEditor(state, edits, connection, this);
    this.map = new PaintMap(state, this.editor);
    state.sceneChanged.add(() => this.sync());
    state.shown.onChange(() => this.sync());
  }

  /** Called once the choices are known. */
  build(presets: Preset[], tissues: StifferTissue[]): void {
    this.scar = scarKind(presets, this.sizes.scar);
    const kinds = [...(this.scar ? [this.scar] : []), ...tissues.map(({ name, source, young_factor: factor }) => (
      { name: words.paintTissue(name.replaceAll('_', ' ')), factor, source }))];
    const both = this.controls?.both.checked ?? false;
    this.controls = new PaintControls(this.element, kinds, this.state, this);
    this.controls.both.checked = both;
    this.chooseTool(this.tool);
    this.sync();
  }

  /** Sets the stage of a new face; null: the present face is closed. */
  attach(stage: Stage | null): void {
    this.letGo();
    this.stage = stage;
    this.editor.clear();
    if (this.visible) this.takeUp();
  }

  /** The panel is shown or hidden. */
  seen(now: boolean): void {
    this.visible = now;
    if (now) this.takeUp();
    else this.letGo();
  }

  /** After a new motion. */
  refresh(): void {
    if (this.brush) this.repaint();
  }

  // Painter.

  radiusM(): number | null {
    return this.tool === 'turn' ? null : this.size.widthMm / 2e3;
  }

  begin(): void {
    this.state.playback.pause();
    const { widthMm, hardness, strength } = this.size;
    this.editor.begin({
      radiusM: widthMm / 2e3, hardness: hardness / 100, strength: strength / 100, erases: this.tool === 'erase', mirrored: this.controls!.both.checked,
    });
  }

  dab(hit: SkinHit): void {
    this.editor.dab(hit);
    this.stage?.repaint();
  }

  end(keep: boolean): void {
    this.editor.end(keep);
  }

  widen(steps: number): void {
    this.size.widthMm = threeDigits(Math.min(Math.max(this.size.widthMm * 1.15 ** steps, 3), 80));
    this.showSize();
  }

  announce(what: 'down' | 'up'): void {
    at('announcement').textContent = what === 'down' ? words.paintDown : words.paintUp;
  }

  // PaintActions.

  choosePainted(painted: Painted): void {
    if (!this.editor.choosePainted(painted)) {
      this.sync();
      return;
    }
    if (painted === 'thickness' && this.tool === 'scar') this.chooseTool('paint');
    this.sync();
    // The name of the map and its bar change, too.
    if (this.brush) this.stage?.lend(this.map.colouring());
  }

  chooseTool(tool: Tool): void {
    this.tool = tool;
    // A scar is a patch of its own.
    if (tool === 'scar' && this.scar) this.editor.chooseStiffness(this.scar.factor);
    this.showTool();
    this.showSize();
  }

  choosePatch(patch: number): void {
    this.editor.chosen = patch;
    this.sync();
  }

  setFactor(factor: Factor, value: number, done: boolean): void {
    this.relabelling(() => this.editor.setFactor(factor, value, done));
  }

  setVolume(ml: number, done: boolean): void {
    this.relabelling(() => this.editor.setVolume(ml, done));
  }

  setDepth(mm: number, done: boolean): void {
    this.editor.setDepth(mm, done);
  }

  setSize(key: keyof Size, value: number): void {
    this.size[key] = value;
    this.showSize();
  }

  fill(region: string): void {
    void this.editor.fill(region, this.tool === 'erase');
  }

  mirror(): void {
    this.editor.mirror();
  }

  clear(): void {
    this.editor.remove();
  }

  // PatchView.

  sync(): void {
    if (!this.state.scene || !this.controls) return;
    const { editor } = this;
    const { patches } = editor;
    editor.chosen = Math.min(editor.chosen, patches.length);
    const { source } = this.state;
    this.controls.show({
      painted: editor.painted, patches, chosen: editor.chosen, row: editor.row, there: editor.there,
      canMirror: source.open && source.replay.mirror !== null,
    });
    if (this.brush) editor.fetchShares();
    this.repaint();
  }

  repaint(): void {
    if (!this.brush || !this.state.source.open) return;
    if (!this.editor.stroking) this.map.rescale();
    this.stage?.repaint();
  }

  report(problem: string): void {
    this.controls?.report(problem);
  }

  private get size(): Size {
    return this.tool === 'scar' ? this.sizes.scar : this.sizes.brush;
  }

  /** The name of the map and its bar change where the change shows another one. */
  private relabelling(change: () => void): void {
    const before = this.editor.showsVolume;
    change();
    if (this.editor.showsVolume !== before && this.brush) this.stage?.lend(this.map.colouring());
  }

  private takeUp(): void {
    const viewer = this.stage?.face;
    if (!viewer || this.brush) return;
    this.state.playback.pause();
    this.brush = new BrushInHand(viewer, this);
    this.repaint();
    this.stage!.lend(this.map.colouring());
    this.showTool();
    this.sync();
  }

  private letGo(): void {
    this.brush?.dispose();
    this.brush = null;
    this.stage?.lend(null);
    at('canvas-host').classList.remove('painting');
  }

  private showTool(): void {
    this.controls?.showTool(this.tool);
    at('canvas-host').classList.toggle('painting', this.brush !== null && this.tool !== 'turn');
    this.brush?.show();
  }

  private showSize(): void {
    this.controls?.showSize(this.size);
    this.brush?.show();
  }
}

/** The scar that a preset of variants has; sets the width of its brush. */
function scarKind(presets: Preset[], size: Size): Kind | null {
  for (const { changes, source, assumed } of presets) {
    const rows = isRecord(changes.tissue) ? rowsOf(changes.tissue.region) : [];
    const scar = rows.find((row) => Array.isArray(row.scar) && typeof row.young_factor === 'number');
    if (!scar) continue;
    if (typeof scar.width_mm === 'number') size.widthMm = scar.width_mm;
    return { name: upper(words.paintScar), factor: Number(scar.young_factor), source: words.presetSource(source, assumed) };
  }
  return null;
}
