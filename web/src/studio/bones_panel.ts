// SPDX-License-Identifier: GPL-3.0-or-later
// Surgery: segments of bone moved by numbers, by sliders or by their arrows over the face, and what that does to the
// face at rest, beside published ratios.
import { button, element } from '../page/dom';
import { fixed, landmarkName, upper } from '../page/format';
import { remember, remembered, rememberFold } from '../page/remember';
import type { Vec3 } from '../replay/data';
import { frameAt } from '../replay/face/deform';
import type { FaceViewer } from '../replay/face/viewer';
import { directionWords, shownMoves, volumeSentence } from '../replay/surgery';
import { variantsOf } from '../replay/variants';
import { BoneDivision } from './bone_division';
import { BoneHandles } from './bone_handles';
import { boneKey, boneParts, isStill, moveOf, movesOf, withMove, type BoneMove, type BonePart, type BonesKnown } from './bone_moves';
import { axisColours, BoneView } from './bone_view';
import { clipped, type Bounds } from './bounds';
import { Refused, type Connection } from './connection';
import type { Edits } from './edits';
import type { Control, RemarkPanel } from './remark_places';
import { linear, Slider } from './slider';
import type { StudioState } from './studio_state';
import { words } from './words';

/** Where the sliders end is a choice of this page: surgery seldom moves a bone farther. Digits and arrows may go as far as
 *  the scene allows. */
const usualMm = [-15, 15] as const;
const usualDeg = [-15, 15] as const;
const tenth = (value: number): number => Math.round(10 * value) / 10;

export class BonesPanel implements RemarkPanel {
  readonly key = 'bones';
  readonly sections = ['surgery'];
  readonly element = element('div', '', 'panel bones-panel');
  private part: BonePart = 'mandible';
  private readonly parts = element('div', '', 'segments');
  private readonly cut = element('select');
  private readonly cutLabel = element('label', '', 'part');
  private moves: Slider[] = [];
  private turns: Slider[] = [];
  private shift: Slider | null = null;
  private readonly note = element('p', '', 'why');
  private readonly results = element('table', '', 'bone-results');
  private readonly through = element('input');
  private readonly throughLabel = element('label', '', 'check');
  private readonly back = button(words.boneBack, 'quiet', () => this.commit(this.inBase));
  private readonly divide = button(words.boneDivide, 'quiet', () => this.startDivision());
  private readonly dividing = element('p', '', 'why');
  private division: BoneDivision | null = null;
  private bones: BonesKnown | null = null;
  private visible = false;
  private paused = false;
  /** Cuts of a face that were chosen before anything moved. */
  private pending: { face: number; cuts: Map<string, Pick<BoneMove, 'cut' | 'cut_shift_mm'>> } | null = null;
  private shown: { view: BoneView; handles: BoneHandles; of: string } | null = null;

  constructor(private readonly state: StudioState, private readonly edits: Edits, private readonly connection: Connection,
    private readonly viewer: () => FaceViewer | null) {
    this.parts.setAttribute('role', 'group');
    this.parts.setAttribute('aria-label', words.bonePart);
    for (const part of boneParts) {
      const choose = button(words.boneParts[part], '', () => this.choose(part));
      choose.dataset.part = part;
      this.parts.append(choose);
    }
    this.cut.append(new Option(words.boneCuts.standard, 'standard'), new Option(words.boneCuts.whole, 'whole'));
    this.cut.addEventListener('change', () => this.commit({ ...this.move, cut: this.cut.value }));
    this.cutLabel.append(element('span', words.boneCut), this.cut);
    Object.assign(this.through, { type: 'checkbox', checked: remembered('bones.through') !== 'no' });
    this.through.addEventListener('change', () => {
      remember('bones.through', this.through.checked ? 'yes' : 'no');
      this.showBones();
    });
    this.throughLabel.append(this.through, element('span', words.bonesThrough));
    this.divide.hidden = true;
    this.dividing.setAttribute('role', 'status');
    connection.on('ct', ({ measured }) => (this.divide.hidden = !measured));
    state.sceneChanged.add(() => this.update());
    state.shown.onChange(() => this.update());
    state.source.onChange(() => this.fillResults());
    state.playback.onChange(() => this.openJaw());
  }

  /** Once the keys are known. */
  build(): void {
    this.moves = [0, 1, 2].map((axis) => this.slider('move_mm', axis, words.boneMoves[axis], usualMm, 'mm', words.boneMoveHint));
    this.turns = [0, 1, 2].map((axis) => this.slider('turn_deg', axis, words.boneTurns[axis], usualDeg, '°', words.boneTurnHint));
    const shifts = this.boundsOf('cut_shift_mm');
    this.shift = new Slider({
      name: words.boneShift, unit: 'mm', hint: words.boneShiftHint, course: linear(...clipped(shifts, ...usualMm)), round: tenth, bounds: shifts,
      live: (value) => this.live({ ...this.move, cut_shift_mm: value }),
      done: (value) => this.commit({ ...this.move, cut_shift_mm: value ?? this.inBase.cut_shift_mm }),
    });
    const more = element('details', '', 'muscle-group');
    more.append(element('summary', words.boneMore), ...this.turns.map((slider) => slider.element), this.cutLabel, this.shift.element);
    rememberFold(more, 'bones.more');
    this.element.replaceChildren(
      element('p', words.bonesSay, 'why'), this.parts, ...[2, 1, 0].map((axis) => this.moves[axis].element), this.results, more, this.back, this.throughLabel,
      this.note, this.divide, this.dividing);
    this.update();
  }

  private boundsOf(column: keyof BoneMove): Bounds {
    return this.state.boundsOf(boneKey, column);
  }

  /** Of a new face. */
  take(bones: BonesKnown): void {
    this.bones = bones;
    this.hide();
    this.update();
  }

  /** After the stage was made again. */
  attach(): void {
    if (this.division) this.endDivision('');
    this.shown?.handles.dispose();
    this.shown = null;
    this.showBones();
  }

  /** While other marks are shown over the face. */
  pause(on: boolean): void {
    this.paused = on;
    this.showBones();
  }

  seen(now: boolean): void {
    this.visible = now;
    this.showBones();
  }

  controlsOf(): Control[] {
    return [];
  }

  private slider(
    key: 'move_mm' | 'turn_deg', axis: number, name: string, usual: readonly [number, number], unit: string, hint: string,
  ): Slider {
    const bounds = this.boundsOf(key);
    const head = element('span', '', 'bone-axis');
    const dot = element('i');
    if (key === 'move_mm') dot.style.background = axisColours[axis];
    head.append(dot, name);
    const withValue = (value: number): BoneMove => {
      const { move } = this;
      const next: Vec3 = [...move[key]];
      next[axis] = value;
      return { ...move, [key]: next };
    };
    const slider = new Slider({
      name, unit, hint, course: linear(...clipped(bounds, ...usual)), round: tenth, bounds, head,
      live: (value) => this.live(withValue(value)),
      done: (value) => this.commit(withValue(value ?? this.inBase[key][axis])),
    });
    slider.element.dataset.bone = `${key}.${axis}`;
    return slider;
  }

  private get all(): BoneMove[] {
    return movesOf(this.edits.value(boneKey));
  }

  private get move(): BoneMove {
    const own = this.all.find(({ part }) => part === this.part);
    return own ?? { ...moveOf([], this.part), ...(this.pending?.face === this.state.edited ? this.pending.cuts.get(this.part) : {}) };
  }

  /** What base does with the same part. */
  private get inBase(): BoneMove {
    return moveOf(movesOf(this.state.valuesOf(0)[boneKey]), this.part);
  }

  private choose(part: BonePart): void {
    this.part = part;
    this.update();
  }

  private live(next: BoneMove): void {
    this.showBones(next);
    if (!isStill(next)) this.edits.live({ [boneKey]: withMove(this.all, next) });
  }

  private commit(next: BoneMove): void {
    if (isStill(next) && !this.all.some(({ part }) => part === next.part)) {
      // Nothing moves yet: the cut is kept for what will.
      if (this.pending?.face !== this.state.edited) this.pending = { face: this.state.edited, cuts: new Map() };
      this.pending.cuts.set(this.part, { cut: next.cut, cut_shift_mm: next.cut_shift_mm });
      this.update();
      return;
    }
    void this.edits.commit({ [boneKey]: withMove(this.all, next) });
  }

  private update(): void {
    const { state, part } = this;
    if (!state.scene) return;
    for (const choose of this.parts.querySelectorAll('button')) {
      choose.setAttribute('aria-pressed', String(choose.dataset.part === part));
      choose.classList.toggle('changed', this.all.some((move) => move.part === choose.dataset.part));
    }
    const own = this.move;
    const base = this.inBase;
    for (const axis of [0, 1, 2]) {
      this.moves[axis].set(own.move_mm[axis], base.move_mm[axis]);
      this.turns[axis].set(own.turn_deg[axis], base.turn_deg[axis]);
    }
    this.shift?.set(own.cut_shift_mm, base.cut_shift_mm);
    this.cutLabel.hidden = part !== 'mandible';
    this.cut.value = own.cut === 'whole' ? 'whole' : 'standard';
    this.back.disabled = !this.all.some((move) => move.part === part);
    const known = Boolean(this.bones && (this.bones.skull ?? this.bones.mandible));
    this.throughLabel.hidden = !known;
    this.note.textContent = known ? words.bonesOwn : words.bonesGuessed;
    this.fillResults();
    this.showBones();
  }

  /** The bones, the cut and the arrows, while this panel is seen. */
  private showBones(move = this.move): void {
    const viewer = this.viewer();
    if (!viewer || !this.bones || !this.visible || this.paused) {
      this.hide();
      return;
    }
    const of = `${move.part} ${move.cut} ${move.cut_shift_mm}`;
    if (this.shown?.of === of && viewer.shows(this.shown.view)) {
      this.shown.view.set(move);
      this.shown.view.bonesVisible = this.through.checked;
      this.openJaw();
      viewer.redraw();
      return;
    }
    if (this.division) this.endDivision('');
    this.shown?.handles.dispose();
    const view = new BoneView(this.bones, move);
    view.bonesVisible = this.through.checked;
    viewer.showMarks(view);
    const moved = (moveMm: Vec3, done: boolean) => {
      const { low, high } = this.boundsOf('move_mm');
      const next = { ...this.move, move_mm: moveMm.map((mm) => Math.min(Math.max(mm, low), high)) as Vec3 };
      if (done) this.commit(next);
      else {
        next.move_mm.forEach((value, axis) => this.moves[axis].set(value, null));
        this.live(next);
      }
    };
    this.shown = { view, handles: new BoneHandles(viewer, view, () => this.move.move_mm, moved), of };
    this.openJaw();
  }

  private openJaw(): void {
    const { replay } = this.state.source;
    if (!this.shown || !this.state.source.open) return;
    const face = replay.faces[this.state.edited];
    if (face) this.shown.view.openAs(face, frameAt(replay.timeS, this.state.playback.timeS));
  }

  /** Two clicks on the bones, then the program divides them anew. */
  private startDivision(): void {
    const viewer = this.viewer();
    if (!viewer || !this.shown) return;
    this.through.checked = true;
    this.showBones();
    this.endDivision(words.boneDivideSkull);
    this.shown.handles.paused = true;
    this.division = new BoneDivision(viewer, this.shown.view, (skull, mandible) => {
      if (mandible) {
        this.endDivision(words.boneDividing);
        void this.sendSeeds(skull, mandible);
      } else this.dividing.textContent = words.boneDivideJaw;
    }, () => this.endDivision(''));
  }

  private async sendSeeds(skull: Vec3, mandible: Vec3): Promise<void> {
    try {
      await this.connection.request('ct_bones', { skull, mandible });
      this.dividing.textContent = '';
    } catch (error) {
      this.dividing.textContent = error instanceof Refused ? error.message : '';
    }
  }

  private endDivision(text: string): void {
    this.division?.dispose();
    this.division = null;
    if (this.shown) this.shown.handles.paused = false;
    this.dividing.textContent = text;
  }

  private hide(): void {
    if (this.division) this.endDivision('');
    if (!this.shown) return;
    this.shown.handles.dispose();
    const viewer = this.viewer();
    if (viewer?.shows(this.shown.view)) viewer.showMarks(null);
    this.shown = null;
  }

  /** What surgery did to the face at rest, once it was computed. */
  private fillResults(): void {
    const { state, results } = this;
    results.replaceChildren();
    if (!state.source.open) return;
    const row = variantsOf(state.source.replay)?.table.find(({ name }) => name === state.nameOf(state.edited));
    const moves = shownMoves(row);
    results.hidden = moves.length === 0;
    if (moves.length === 0) return;
    const caption = results.createCaption();
    caption.append(words.boneResults, element('small', volumeSentence(row)));
    const head = results.createTHead().insertRow();
    for (const text of [words.boneLandmark, words.boneAtRest, words.boneRatio]) {
      const cell = element('th', text);
      cell.scope = 'col';
      head.append(cell);
    }
    const body = results.createTBody();
    for (const { landmark, at_rest_mm, soft_per_bone, published } of moves) {
      const line = body.insertRow();
      const name = element('th', upper(landmarkName(landmark)));
      name.scope = 'row';
      const ratio = element('td', soft_per_bone === undefined ? '' : fixed(soft_per_bone, 2));
      if (published) {
        ratio.append(' ', element('small', words.bonePublished(fixed(published.low, 2), fixed(published.high, 2))));
        ratio.title = published.source;
      }
      line.append(name, element('td', directionWords(at_rest_mm) || '0.0'), ratio);
    }
  }
}
