// SPDX-License-Identifier: GPL-3.0-or-later
// The face live: a camera, or the scene's recording played as one. Drawn as it arrives, with frame rate and delay; a
// take is recorded, trimmed and becomes the scene's motion.
import { button, element } from '../page/dom';
import type { FaceViewer } from '../replay/face/viewer';
import { Refused, type Connection } from './connection';
import type { Places } from './messages';
import type { LiveEvent, LiveStartRequest, Requests } from './protocol';
import type { StudioState } from './studio_state';
import { TrimCurve } from './trim_curve';
import { words } from './words';

/** Digits that change faster cannot be read, and each layout of the page delays the face. */
const figuresEachMs = 100;

export class LivePanel {
  private device: string | null = null;
  private running = false;
  private recorded = false;
  private measuredAt = 0;
  private readonly choices = element('div', '', 'choices');
  private readonly status = element('p', '', 'why');
  private readonly figures = element('dl', '', 'live-figures');
  private readonly tools = element('div', '', 'landmark-buttons');
  private readonly neutral = button(words.liveNeutral, 'quiet', () => void this.request('live_neutral', {}));
  private readonly record = button(words.liveRecord, 'quiet', () => void this.toggleTake());
  private readonly trim = element('div', '', 'trim');
  private readonly curve = new TrimCurve(words.takeCurve, [words.takeFrom, words.takeTo]);
  private readonly problem = element('p', '', 'problem');

  constructor(
    private readonly state: StudioState, private readonly connection: Connection, private readonly into: HTMLElement,
    private readonly viewer: () => FaceViewer | null, private readonly measure: (face: number, displacement: Float32Array | null) => void,
  ) {
    this.neutral.title = words.liveNeutralHint;
    this.record.title = words.liveRecordHint;
    this.tools.append(this.neutral, this.record, button(words.liveEnd, 'quiet', () => void this.request('live_stop', {})));
    this.status.setAttribute('role', 'status');
    this.problem.setAttribute('role', 'alert');
    const use = button(words.takeUse, 'primary', () => void this.useTake());
    use.title = words.takeUseHint;
    this.trim.append(this.curve.element, use);
    into.append(this.choices, this.status, this.figures, this.tools, this.trim, this.problem);
    this.problem.hidden = this.trim.hidden = this.tools.hidden = this.figures.hidden = true;
    state.sceneChanged.add(() => this.offer());
    state.source.onChange((change) => {
      if (change === 'face') this.trim.hidden = true;
    });
    connection.on('live', (status) => this.showStatus(status));
    connection.on('live_shape', ({ face, frame, step_m, values, block }) => {
      if (!state.source.open || values.count !== state.source.replay.points.length) return;
      const displacement = new Float32Array(block.int16(values));
      for (let i = 0; i < displacement.length; ++i) displacement[i] *= step_m;
      this.show(face, displacement, frame);
    });
    connection.on('take', ({ time_s, moved_mm }) => {
      this.curve.show(time_s as number[], moved_mm as number[]);
      this.trim.hidden = (time_s as number[]).length < 2;
    });
  }

  /** Whether shapes arrive. */
  get live(): boolean {
    return this.running;
  }

  greet({ device }: Places): void {
    this.device = device;
    this.offer();
  }

  /** Sets the sources that can be followed. */
  private offer(): void {
    const recording = this.state.valuesOf(0)['motion.recording'];
    const choices = [];
    if (this.device) choices.push(button(words.liveCamera(this.device.replace(/^(play:).*\//, '$1')), 'quiet', () => void this.start('device')));
    if (typeof recording === 'string' && recording)
      choices.push(button(words.livePlay, 'quiet', () => void this.start('recording')));
    for (const choice of choices) choice.disabled = this.running;
    this.choices.replaceChildren(...choices);
    this.into.hidden = choices.length === 0;
  }

  private async start(what: LiveStartRequest['what']): Promise<void> {
    const { state } = this;
    this.trim.hidden = true;
    this.status.textContent = words.liveStates.looking;
    state.playback.pause();
    const face = state.edited;
    state.shown.set({ mode: 'single', first: face });
    if (!(await this.request('live_start', { what, face }))) this.status.textContent = '';
  }

  private show(face: number, displacement: Float32Array, frame: number): void {
    const { state } = this;
    const viewer = this.viewer();
    if (state.playback.playing) state.playback.pause();
    if (face < state.source.replay.faces.length && !state.shown.visible.includes(face)) state.shown.set({ mode: 'single', first: face });
    viewer?.showLive({ face, displacement }, true);
    const now = performance.now();
    if (now - this.measuredAt >= figuresEachMs) {
      this.measuredAt = now;
      this.measure(face, displacement);
    }
    // requestAnimationFrame runs before the drawing, the task after it.
    requestAnimationFrame(() => setTimeout(() => void this.request('live_drawn', { frame })));
  }

  private showStatus(status: LiveEvent): void {
    const { state, problem, drawn_a_second, delay_ms, delay_95_ms, dropped, not_drawn, frames, valid, recording, take_s } = status;
    const was = this.running;
    this.running = state !== 'ended';
    if (was !== this.running) {
      this.offer();
      if (!this.running) {
        this.viewer()?.showLive(null);
        this.measure(0, null);
      }
    }
    this.into.dataset.live = state;
    this.status.textContent = words.liveStates[state];
    this.tools.hidden = !this.running;
    this.neutral.disabled = state !== 'following';
    this.recorded = recording;
    this.record.textContent = recording ? words.liveRecorded(take_s.toFixed(1)) : words.liveRecord;
    this.record.setAttribute('aria-pressed', String(recording));
    this.report(problem);
    const ms = (value: unknown) => (typeof value === 'number' ? `${value.toFixed(0)} ms` : '–');
    const rows: [string, string][] = [
      [words.liveRate, `${drawn_a_second}`], [words.liveDelay, ms(delay_ms)], [words.liveDelayMost, ms(delay_95_ms)],
      [words.liveDropped, `${dropped + not_drawn}`], [words.liveFollowed, words.liveOf(valid, frames)],
    ];
    this.figures.hidden = frames === 0;
    this.figures.replaceChildren(...rows.flatMap(([name, value]) => [element('dt', name), element('dd', value)]));
  }

  private async toggleTake(): Promise<void> {
    const on = !this.recorded;
    if (on) this.trim.hidden = true;
    await this.request('live_record', { on });
  }

  private async useTake(): Promise<void> {
    const [from_s, to_s] = this.curve.range;
    await this.request('live_take', { from_s, to_s });
  }

  /** False where the server refuses; the reason is then shown. */
  private async request<K extends keyof Requests>(name: K, fields: Requests[K]['fields']): Promise<boolean> {
    try {
      await this.connection.request(name, fields);
      return true;
    } catch (error) {
      if (error instanceof Refused) this.report(error.message);
      return false;
    }
  }

  private report(problem: string): void {
    this.problem.textContent = problem;
    this.problem.hidden = problem === '';
  }
}
