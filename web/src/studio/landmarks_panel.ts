// SPDX-License-Identifier: GPL-3.0-or-later
// The landmarks of the scan, dragged over the skin at rest; the server lays them onto it and doubts what is hardly
// plausible.
import { at, button, element } from '../page/dom';
import { Undoing } from '../page/listeners';
import { landmarkName, naturally, upper } from '../page/format';
import type { Vec3 } from '../replay/data';
import { Marks } from '../replay/face/marks';
import type { FaceViewer } from '../replay/face/viewer';
import { Refused, type Connection } from './connection';
import type { LandmarkInfo } from './messages';
import type { StudioState } from './studio_state';
import { words } from './words';

/** How near a pointer must be to take a point. */
const nearPx = 14;
/** What an arrow key moves a point by, pixels. */
const stepPx = 3;

/** Two names of one place are one point; names that people know go first. */
function distinct(landmarks: LandmarkInfo[]): LandmarkInfo[] {
  const known = landmarks.filter(({ name }) => !name.startsWith('ibug68_'));
  const numbered = landmarks.filter(({ name }) => name.startsWith('ibug68_'));
  const near = (a: Vec3, b: Vec3) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) < 1e-6;
  return [...known, ...numbered.filter(({ position }) => !known.some((other) => near(other.position, position)))];
}

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

  constructor(
    private readonly state: StudioState, private readonly connection: Connection, private readonly into: HTMLElement,
    private readonly viewer: () => FaceViewer | null,
  ) {
    this.begin.title = words.landmarksCorrectHint;
    const label = element('label', '', 'landmark-choice');
    label.append(element('span', words.landmarkChosen), this.select);
    const done = button(words.landmarksDone, 'primary', () => void this.finish());
    done.title = words.landmarksDoneHint;
    const buttons = element('div', '', 'landmark-buttons');
    buttons.append(
      done, button(words.landmarkReset, 'quiet', () => void this.move(this.chosen, null)),
      button(words.landmarksLeave, 'quiet', () => void this.leave()));
    this.doubts.setAttribute('role', 'status');
    this.problem.setAttribute('role', 'alert');
    this.problem.hidden = true;
    this.tools.append(element('p', words.landmarksSay, 'why'), label, buttons, this.doubts);
    this.tools.hidden = true;
    this.select.addEventListener('change', () => this.choose(this.chosen));
    into.append(this.count, this.begin, this.tools, this.problem);
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
    this.marks = new Marks(this.landmarks.map(({ position }) => [...position]));
    viewer.showMarks(this.marks);
    this.rest(viewer);
    this.choose(this.chosen);
    this.tools.hidden = false;
    this.begin.hidden = true;
    this.doubts.replaceChildren();
    this.listen(viewer);
    at('face').focus();
  }

  /** The points lie on the face at rest: whatever else is chosen ends this. */
  private rest(viewer: FaceViewer): void {
    viewer.showLive({ face: 0, displacement: new Float32Array(this.state.source.replay.points.length) });
    this.undoing.add(this.state.shown.onChange(() => this.end()), this.state.playback.onChange(() => this.end()));
  }

  private choose(i: number): void {
    this.select.value = String(i);
    this.marks?.choose(i);
    this.viewer()?.redraw();
  }

  private listen(viewer: FaceViewer): void {
    const canvas = at('face');
    const { signal } = this.undoing;
    let dragged = -1;
    // Before the view's own listeners: what takes a point does not turn the face.
    canvas.addEventListener('pointerdown', (event) => {
      dragged = this.nearest(viewer, event.clientX, event.clientY);
      if (dragged < 0) return;
      viewer.turning = false;
      canvas.setPointerCapture(event.pointerId);
      this.choose(dragged);
    }, { signal, capture: true });
    canvas.addEventListener('pointermove', (event) => {
      if (dragged >= 0) this.put(viewer, dragged, event.clientX, event.clientY);
    }, { signal });
    const letGo = () => {
      if (dragged < 0) return;
      const moved = dragged;
      dragged = -1;
      viewer.turning = true;
      void this.move(moved, this.marks!.points[moved]);
    };
    canvas.addEventListener('pointerup', letGo, { signal });
    canvas.addEventListener('pointercancel', letGo, { signal });
    canvas.addEventListener('keydown', (event) => {
      const steps: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
      if (!(event.key in steps) || event.shiftKey || event.ctrlKey || !this.marks) return;
      event.preventDefault();
      event.stopPropagation(); // else they step through the frames
      const from = viewer.inWindow(this.marks.points[this.chosen]);
      const [x, y] = steps[event.key];
      if (this.put(viewer, this.chosen, from.x + stepPx * x, from.y + stepPx * y))
        void this.move(this.chosen, this.marks.points[this.chosen]);
    }, { signal });
  }

  private nearest(viewer: FaceViewer, x: number, y: number): number {
    const far = this.marks!.points.map((point) => {
      const there = viewer.inWindow(point);
      return Math.hypot(there.x - x, there.y - y);
    });
    const least = far.indexOf(Math.min(...far));
    return far[least] <= nearPx ? least : -1;
  }

  private put(viewer: FaceViewer, i: number, x: number, y: number): boolean {
    const place = viewer.skinAt(x, y);
    if (!place || !this.marks) return false;
    this.marks.points[i] = [place.x, place.y, place.z];
    this.marks.place(i);
    viewer.redraw();
    return true;
  }

  /** null: where it was found. */
  private async move(i: number, position: Vec3 | null): Promise<void> {
    this.problem.hidden = true;
    try {
      const answer = await this.connection.ask('move_landmark', { name: this.landmarks[i].name, ...(position && { position }) });
      const { marks } = this;
      if (!marks) return;
      marks.points[i] = answer.position as Vec3;
      marks.place(i);
      this.viewer()?.redraw();
      this.doubts.replaceChildren(...(answer.warnings as string[]).map((text) => element('li', upper(text))));
    } catch (error) {
      this.tell(error);
    }
  }

  private async finish(): Promise<void> {
    try {
      await this.connection.ask('landmarks_done', {});
      this.end();
    } catch (error) {
      this.tell(error);
    }
  }

  /** All as they were found. */
  private async leave(): Promise<void> {
    const moved = this.landmarks.filter(({ position }, i) => {
      const now = this.marks?.points[i];
      return now && now.some((x, k) => x !== position[k]);
    });
    this.end();
    for (const { name } of moved) await this.connection.ask('move_landmark', { name }).catch(() => {});
  }

  private tell(error: unknown): void {
    if (!(error instanceof Refused)) return;
    this.problem.textContent = error.message;
    this.problem.hidden = false;
  }

  private end(): void {
    this.undoing.undo();
    this.undoing = new Undoing();
    this.marks = null;
    const viewer = this.viewer();
    if (viewer) {
      viewer.turning = true;
      viewer.showMarks(null);
      viewer.showLive(null);
    }
    this.tools.hidden = true;
    this.begin.hidden = false;
  }
}
