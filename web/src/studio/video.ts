// SPDX-License-Identifier: GPL-3.0-or-later
// The view as a video: the motion once from its start, or what is live until it is ended. WebM, made by the browser.
import { at } from '../page/dom';
import { fileName, save, subject } from '../page/save';
import type { FaceViewer } from '../replay/face/viewer';
import { theme } from '../page/theme';
import { faceHue } from '../page/face_colour';
import type { StudioState } from './studio_state';
import { words } from './words';

const types = ['video/webm;codecs=vp9', 'video/webm;codecs=vp8', 'video/webm'];
const framesPerS = 30;
const bitsPerS = 6e6;

/** What this browser can write; none: no video. */
const supported = (): string | undefined =>
  typeof MediaRecorder === 'undefined' ? undefined : types.find((type) => MediaRecorder.isTypeSupported(type));

export class ViewVideo {
  private stop: (() => void) | null = null;

  constructor(
    private readonly state: StudioState, private readonly button: HTMLButtonElement,
    private readonly viewer: () => FaceViewer | null, private readonly live: () => boolean,
  ) {
    button.hidden = !supported();
    button.addEventListener('click', () => (this.stop ? this.stop() : this.start()));
    state.source.onChange((change) => {
      if (change === 'face') this.stop?.();
    });
  }

  private start(): void {
    const viewer = this.viewer();
    const type = supported();
    if (!viewer || !type) return;
    const host = at('canvas-host');
    const canvas = document.createElement('canvas');
    // Codecs want even numbers.
    [canvas.width, canvas.height] = [host.clientWidth & ~1, host.clientHeight & ~1];
    const draw = () => this.draw(canvas);
    const undraw = viewer.onDraw(draw);
    const recorder = new MediaRecorder(canvas.captureStream(framesPerS), { mimeType: type, videoBitsPerSecond: bitsPerS });
    const parts: Blob[] = [];
    recorder.ondataavailable = ({ data }) => parts.push(data);
    recorder.onstop = () => {
      const { faces } = this.state.source.replay;
      const named = faces.length > 1 ? this.state.shown.visible.flatMap((i) => faces[i]?.name ?? []) : [];
      save(new Blob(parts, { type: 'video/webm' }), fileName(subject(), ...named, 'webm'));
    };
    const { playback } = this.state;
    const { loop } = playback;
    let unplay = () => {};
    this.stop = () => {
      this.stop = null;
      undraw();
      unplay();
      playback.loop = loop;
      recorder.stop();
      this.showState(false);
    };
    this.showState(true);
    viewer.redraw();
    recorder.start();
    if (this.live()) return;
    const { timeS } = this.state.source.replay;
    playback.seek(timeS[0] ?? 0);
    playback.loop = false;
    playback.play();
    const last = timeS[timeS.length - 1] ?? 0;
    unplay = playback.onChange(() => {
      if (playback.playing) return;
      // Paused before the end: so far. At the end the last picture is drawn first.
      unplay();
      window.setTimeout(() => this.stop?.(), playback.timeS >= last ? 200 : 0);
    });
  }

  /** The stage on the page's own background, with names and time. */
  private draw(canvas: HTMLCanvasElement): void {
    const on = canvas.getContext('2d')!;
    const { width, height } = canvas;
    const style = getComputedStyle(document.documentElement);
    const colour = (name: string) => style.getPropertyValue(name).trim();
    on.fillStyle = colour('--card');
    on.fillRect(0, 0, width, height);
    on.drawImage(at<HTMLCanvasElement>('face'), 0, 0, width, height);
    const { shown, source, playback } = this.state;
    on.font = "14px system-ui, 'Segoe UI', 'DejaVu Sans', sans-serif";
    on.fillStyle = colour('--ink');
    if (!this.live()) on.fillText(`${playback.timeS.toFixed(3)} s`, 12, height - 14);
    if (source.replay.faces.length < 2) return;
    const { palette } = theme();
    shown.visible.forEach((face, i) => {
      const x = 12 + (i * width) / 2;
      on.fillStyle = palette[faceHue(face)];
      on.beginPath();
      on.arc(x + 5, 20, 5, 0, 2 * Math.PI);
      on.fill();
      on.fillStyle = colour('--ink');
      on.fillText(face === 0 ? words.base : this.state.nameOf(face), x + 16, 25, width / 2 - 40);
    });
  }

  private showState(on: boolean): void {
    this.button.textContent = on ? words.endVideo : words.saveVideo;
    this.button.setAttribute('aria-pressed', String(on));
  }
}
