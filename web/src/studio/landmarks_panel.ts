// SPDX-License-Identifier: GPL-3.0-or-later
// The landmarks of the scan, dragged over the skin at rest; the server projects them onto it and reports implausible
// ones.
import { at, button, element } from '../page/dom';
import { Undoing } from '../page/listeners';
import { landmarkName, naturally, upper } from '../page/format';
import type { Vec3 } from '../replay/data';
import { nearestVertex } from '../replay/face/deform';
import { Marks } from '../replay/face/marks';
import type { FaceViewer } from '../replay/face/viewer';
import { Refused, type Connection } from './connection';
import { Magnifier } from './magnifier';
import type { LandmarkInfo } from './messages';
import type { StudioState } from './studio_state';
import { words } from './words';

/** How near a pointer must be to pick a point, pixels. */
const nearPx = 14;
/** What an arrow key moves a point by, pixels. */
const stepPx = 3;

/** Two names of one place are one point; plain names come first. */
function distinct(landmarks: LandmarkInfo[]): LandmarkInfo[] {
  const known = landmarks.filter(({ name }) => !name.startsWith('ibug68_'));
  const numbered = landmarks.filter(({ name }) => name.startsWith('ibug68_'));
  const near = (a: Vec3, b: Vec3) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) < 1e-6;
  return [...known, ...numbered.filter(({ position }) => !known.some((other) => near(other.position, position)))];
}

/** A move of one point; one step of the undo history. */
interface Move {
  i: number;
  from: Vec3;
  to: Vec3;
}

const samePlace = (a: Vec3, b: Vec3): boolean => a.every((x, k) => x === b[k]);

export class LandmarksPanel {
  private landmarks: LandmarkInfo[] = [];
  private readonly count = element('p', '', 'why');
  private readonly begin = button(words.landmarksCorrect, 'quiet', () => this.start());
  private readonly tools = element('div', '', 'landmark-tools');
  private readonly select = element('select');
  private readonly doubts = element('ul', '', 'doubts');
  private readonly problem = element('p', '', 'problem');
  private marks: Marks | null = null;
  private undoing = new Undoing();
  private past: Move[][] = [];
  private future: Move[][] = [];
  private readonly undoOne = button(words.undo, 'quiet', () => void this.step(this.past, this.future));
  private readonly redoOne = button(words.redo, 'quiet', () => void this.step(this.future, this.past));
  private readonly resetOne = button(words.landmarkReset, 'quiet', () => void this.reset());
  private readonly mirrorOne = button(words.landmarkMirror, 'quiet', () => void this.mirror());
  private readonly load = button(words.landmarksLoad, 'quiet', () => this.picker.click());
  private readonly picker = element('input');

  /** `editing`: called when points begin and end to be shown over the face. */
  constructor(
    private readonly state: StudioState, private readonly connection: Connection, private readonly into: HTMLElement,
    private readonly viewer: () => FaceViewer | null, private readonly editing: (on: boolean) => void,
  ) {
    this.begin.title = words.landmarksCorrectHint;
    const label = element('label', '', 'landmark-choice');
    label.append(element('span', words.landmarkChosen), this.select);
    const done = button(words.landmarksDone, 'primary', () => void this.finish());
    done.title = words.landmarksDoneHint;
    const buttons = element('div', '', 'landmark-buttons');
    buttons.append(
      done, this.undoOne, this.redoOne, this.resetOne, this.mirrorOne,
      button(words.landmarksLeave, 'quiet', () => void this.leave()));
    this.undoOne.title = words.landmarkUndoHint;
    this.redoOne.title = words.landmarkRedoHint;
    this.mirrorOne.title = words.landmarkMirrorHint;
    this.load.title = words.landmarksLoadHint;
    Object.assign(this.picker, { type: 'file', accept: '.json', hidden: true, id: 'landmarks-picker' });
    this.picker.setAttribute('aria-label', words.landmarksLoad);
    this.picker.addEventListener('change', () => {
      const [file] = this.picker.files ?? [];
      this.picker.value = '';
      if (file) void this.loadFrom(file);
    });
    const status = element('div');
    status.setAttribute('role', 'status');
    status.append(this.doubts);
    this.problem.setAttribute('role', 'alert');
    this.problem.hidden = true;
    this.tools.append(element('p', words.landmarksSay, 'why'), label, buttons, status);
    this.tools.hidden = true;
    this.select.addEventListener('change', () => this.choose(this.chosen));
    const start = element('div', '', 'landmark-buttons');
    start.append(this.begin, this.load, this.picker);
    into.append(this.count, start, this.tools, this.problem);
  }

  /** Of a new face. */
  build(landmarks: LandmarkInfo[]): void {
    this.end();
    this.landmarks = distinct(landmarks).sort((a, b) => naturally(landmarkName(a.name), landmarkName(b.name)));
    this.into.hidden = this.landmarks.length === 0;
    this.count.textContent = words.landmarkCount(this.landmarks.length);
    this.select.replaceChildren(...this.landmarks.map(({ name }, i) => new Option(upper(landmarkName(name)), String(i))));
  }

  private get chosen(): number {
    return Number(this.select.value);
  }

  private start(): void {
    const viewer = this.viewer();
    if (!viewer) return;
    const { state } = this;
    state.shown.set({ mode: 'single', first: 0 });
    state.playback.seek(state.source.replay.timeS[0]);
    this.editing(true);
    this.marks = new Marks(this.landmarks.map(({ position }) => [...position]));
    viewer.showMarks(this.marks);
    this.rest(viewer);
    this.choose(this.chosen);
    this.tools.hidden = false;
    this.begin.hidden = this.load.hidden = true;
    this.problem.hidden = true;
    this.doubts.replaceChildren();
    this.past = [];
    this.future = [];
    this.tellSteps();
    this.listen(viewer);
    at('face').focus();
  }

  /** The points lie on the face at rest. Another choice of the user ends this; a message of the server does not. */
  private rest(viewer: FaceViewer): void {
    const { state } = this;
    const { shown, playback, source } = state;
    const still = () => viewer.showLive({ face: 0, displacement: new Float32Array(source.replay.points.length) });
    const end = () => {
      const same = shown.mode === 'single' && shown.first === 0 && !playback.playing && playback.timeS === source.replay.timeS[0];
      if (!same) this.end();
    };
    still();
    this.undoing.add(shown.onChange(end), playback.onChange(end), source.onChange((change) => {
      if (change === 'motion') still();
    }));
  }

  private choose(i: number): void {
    this.select.value = String(i);
    this.marks?.choose(i);
    this.viewer()?.redraw();
    this.tellSteps();
  }

  private listen(viewer: FaceViewer): void {
    const canvas = at('face');
    const { signal } = this.undoing;
    let dragged = -1;
    let from: Vec3 = [0, 0, 0];
    const glass = new Magnifier(viewer);
    this.undoing.add(() => glass.remove());
    // Runs before the view's own listeners, so that picking a point does not turn the face.
    canvas.addEventListener('pointerdown', (event) => {
      dragged = this.nearest(viewer, event.clientX, event.clientY);
      if (dragged < 0) return;
      viewer.turning = false;
      canvas.setPointerCapture(event.pointerId);
      this.choose(dragged);
      from = [...this.marks!.points[dragged]];
      glass.show(event.clientX, event.clientY);
    }, { signal, capture: true });
    canvas.addEventListener('pointermove', (event) => {
      if (dragged < 0) return;
      this.put(viewer, dragged, event.clientX, event.clientY);
      glass.show(event.clientX, event.clientY);
    }, { signal });
    const letGo = () => {
      if (dragged < 0) return;
      const moved = dragged;
      dragged = -1;
      viewer.turning = true;
      glass.hide();
      const to = this.marks!.points[moved];
      if (!samePlace(from, to)) void this.take([{ i: moved, from, to }]);
    };
    canvas.addEventListener('pointerup', letGo, { signal });
    canvas.addEventListener('pointercancel', letGo, { signal });
    canvas.addEventListener('keydown', (event) => {
      const steps: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
      if (!(event.key in steps) || event.shiftKey || event.ctrlKey || !this.marks) return;
      event.preventDefault();
      event.stopPropagation(); // else they step through the frames
      const before: Vec3 = [...this.marks.points[this.chosen]];
      const seen = viewer.pick.inWindow(before);
      const [x, y] = steps[event.key];
      if (this.put(viewer, this.chosen, seen.x + stepPx * x, seen.y + stepPx * y))
        void this.take([{ i: this.chosen, from: before, to: this.marks.points[this.chosen] }]);
    }, { signal });
    // While points are moved, undo acts on them.
    document.addEventListener('keydown', (event) => {
      if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
      const key = event.key.toLowerCase();
      if (key !== 'z' && key !== 'y') return;
      event.preventDefault();
      event.stopImmediatePropagation();
      void (key === 'y' || event.shiftKey ? this.step(this.future, this.past) : this.step(this.past, this.future));
    }, { signal, capture: true });
  }

  /** Records a move as a step of the history. */
  private async take(moves: Move[]): Promise<void> {
    this.past.push(moves);
    this.future = [];
    for (const move of moves) await this.move(move.i, move.to);
    this.tellSteps();
  }

  /** Takes back the last step of `from`, which goes to `to`. */
  private async step(from: Move[][], to: Move[][]): Promise<void> {
    const moves = from.pop();
    if (!moves || !this.marks) return;
    to.push(moves.map(({ i, from: there, to: here }) => ({ i, from: here, to: there })).reverse());
    for (const { i, from: back } of moves) await this.move(i, back);
    this.choose(moves[0].i);
  }

  private async reset(): Promise<void> {
    const i = this.chosen;
    const [from, to] = [this.marks!.points[i], this.landmarks[i].position];
    if (!samePlace(from, to)) await this.take([{ i, from: [...from], to }]);
  }

  /** The point's own place of the other side, where the chosen point's mirror image lies. */
  private async mirror(): Promise<void> {
    const other = this.otherOf(this.chosen);
    const image = this.marks && this.imageOf(this.marks.points[this.chosen]);
    if (other < 0 || !image) return;
    await this.take([{ i: other, from: [...this.marks!.points[other]], to: image }]);
  }

  private otherOf(i: number): number {
    const { name, other } = this.landmarks[i] ?? { name: '', other: '' };
    return other === name ? -1 : this.landmarks.findIndex((one) => one.name === other);
  }

  private imageOf(point: Vec3): Vec3 | null {
    const { mirror, points } = this.state.source.replay;
    if (!mirror) return null;
    const { vertex } = nearestVertex(points, point);
    const image = [0, 0, 0];
    let all = 0;
    for (let k = 3 * vertex; k < 3 * vertex + 3; ++k) {
      const v = mirror.vertices[k];
      if (v < 0) continue;
      all += mirror.weights[k];
      for (let c = 0; c < 3; ++c) image[c] += mirror.weights[k] * points[3 * v + c];
    }
    if (all === 0) return null;
    // The point's offset from its vertex, mirrored.
    const off = point.map((x, c) => x - points[3 * vertex + c]);
    const along = 2 * off.reduce((sum, x, c) => sum + x * mirror.normal[c], 0);
    return image.map((x, c) => x / all + off[c] - along * mirror.normal[c]) as Vec3;
  }

  private tellSteps(): void {
    this.undoOne.disabled = this.past.length === 0;
    this.redoOne.disabled = this.future.length === 0;
    const point = this.marks?.points[this.chosen];
    this.resetOne.disabled = !point || samePlace(point, this.landmarks[this.chosen].position);
    this.mirrorOne.disabled = this.otherOf(this.chosen) < 0 || !this.state.source.replay.mirror;
  }

  /** Landmarks of a file take the place of those found. */
  private async loadFrom(file: File): Promise<void> {
    this.problem.hidden = true;
    try {
      const name = await this.connection.upload(file);
      await this.connection.request('set', { changes: { 'scan.landmarks': name, 'scan.landmarks_unit': null }, face: 0, live: false, time_s: 0 });
    } catch (error) {
      this.report(error);
    }
  }

  private nearest(viewer: FaceViewer, x: number, y: number): number {
    const far = this.marks!.points.map((point) => {
      const there = viewer.pick.inWindow(point);
      return Math.hypot(there.x - x, there.y - y);
    });
    const least = far.indexOf(Math.min(...far));
    return far[least] <= nearPx ? least : -1;
  }

  private put(viewer: FaceViewer, i: number, x: number, y: number): boolean {
    const place = viewer.pick.skinAt(x, y);
    if (!place || !this.marks) return false;
    this.marks.points[i] = [place.x, place.y, place.z];
    this.marks.place(i);
    viewer.redraw();
    return true;
  }

  private async move(i: number, position: Vec3): Promise<void> {
    this.problem.hidden = true;
    const found = samePlace(position, this.landmarks[i].position);
    try {
      const answer = await this.connection.request('move_landmark', { name: this.landmarks[i].name, ...(!found && { position }) });
      const { marks } = this;
      if (!marks) return;
      marks.points[i] = answer.position as Vec3;
      marks.place(i);
      this.viewer()?.redraw();
      this.tellSteps();
      this.doubts.replaceChildren(...(answer.warnings as string[]).map((text) => element('li', upper(text))));
    } catch (error) {
      this.report(error);
    }
  }

  private async finish(): Promise<void> {
    try {
      await this.connection.request('landmarks_done', {});
      this.end();
    } catch (error) {
      this.report(error);
    }
  }

  /** Resets all moved points and ends. */
  private async leave(): Promise<void> {
    const moved = this.landmarks.filter(({ position }, i) => {
      const now = this.marks?.points[i];
      return now && now.some((x, k) => x !== position[k]);
    });
    this.end();
    for (const { name } of moved) await this.connection.request('move_landmark', { name }).catch(() => {});
  }

  private report(error: unknown): void {
    if (!(error instanceof Refused)) return;
    this.problem.textContent = error.message;
    this.problem.hidden = false;
  }

  private end(): void {
    this.undoing.undo();
    this.undoing = new Undoing();
    const { marks } = this;
    this.marks = null;
    const viewer = this.viewer();
    if (viewer) {
      viewer.turning = true;
      if (marks && viewer.shows(marks)) viewer.showMarks(null);
      viewer.showLive(null);
    }
    this.tools.hidden = true;
    this.begin.hidden = this.load.hidden = false;
    if (marks) this.editing(false);
  }
}
