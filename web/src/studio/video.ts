// SPDX-License-Identifier: GPL-3.0-or-later
// The view as a video: the motion once from its start, one picture per frame however long drawing takes; or the live
// face, as it arrives, until it is ended. WebM, made by the browser.
import { at } from '../page/dom';
import { fileName, save, subject } from '../page/save';
import type { Scale } from '../replay/face/colouring';
import { scaleStrip, titleStrip } from '../replay/face/picture';
import { drawSideMarks } from '../replay/face/side_marks';
import type { FaceViewer } from '../replay/face/viewer';
import { theme } from '../page/theme';
import { faceHue } from '../page/face_colour';
import type { StudioState } from './studio_state';
import { EncodedVideo, RecordedVideo, recordedType, type VideoSink } from './video_sinks';
import { words } from './words';

/** What is drawn on: the stage, and above and below it what does not change while it moves. */
interface Sheet {
  canvas: HTMLCanvasElement;
  stageHeight: number;
  above: HTMLCanvasElement | null;
  below: HTMLCanvasElement | null;
}

const framesPerS = 30;
const bitsPerS = 6e6;

export class ViewVideo {
  private stop: (() => void) | null = null;

  constructor(
    private readonly state: StudioState, private readonly button: HTMLButtonElement,
    private readonly viewer: () => FaceViewer | null, private readonly colours: () => Scale | null,
    private readonly live: () => boolean,
  ) {
    button.hidden = !recordedType() && !EncodedVideo.possible();
    button.addEventListener('click', () => {
      if (this.stop) this.stop();
      else if (this.live()) this.recordLive();
      else void this.renderMotion();
    });
    state.source.onChange((change) => {
      if (change === 'face') this.stop?.();
    });
  }

  /** Frame by frame, by the video's own clock. */
  private async renderMotion(): Promise<void> {
    const viewer = this.viewer();
    if (!viewer) return;
    const { playback, source } = this.state;
    const { timeS } = source.replay;
    const before = { timeS: playback.timeS, playing: playback.playing };
    let ended = false;
    this.stop = () => (ended = true);
    const sheet = this.sheet(true);
    const { canvas } = sheet;
    const sink: VideoSink = (await EncodedVideo.of(canvas, bitsPerS)) ?? new RecordedVideo(canvas, bitsPerS);
    try {
      for (let frame = 0; frame < timeS.length && !ended; ++frame) {
        this.showState(words.videoFrames(frame + 1, timeS.length));
        playback.seek(timeS[frame]);
        this.draw(sheet, viewer.snapshot(1, true));
        await sink.add((1e3 * (timeS[frame] - timeS[0])) / playback.speed);
      }
      this.keep(await sink.end());
    } finally {
      this.stop = null;
      this.showState(null);
      playback.seek(before.timeS);
      if (before.playing) playback.play();
    }
  }

  private recordLive(): void {
    const viewer = this.viewer();
    const type = recordedType();
    if (!viewer || !type) return;
    const sheet = this.sheet(false);
    const undraw = viewer.onDraw(() => this.draw(sheet, at<HTMLCanvasElement>('face')));
    const recorder = new MediaRecorder(sheet.canvas.captureStream(framesPerS), { mimeType: type, videoBitsPerSecond: bitsPerS });
    const parts: Blob[] = [];
    recorder.ondataavailable = ({ data }) => parts.push(data);
    recorder.onstop = () => this.keep(new Blob(parts, { type: 'video/webm' }));
    this.stop = () => {
      this.stop = null;
      undraw();
      recorder.stop();
      this.showState(null);
    };
    this.showState('');
    viewer.redraw();
    recorder.start();
  }

  /** A canvas of the stage's width. If `worded`, it has a strip for the title, and one for the colour bar if a colour
   *  scale is shown. Width and height of the stage are rounded down to even numbers, which video codecs require. */
  private sheet(worded: boolean): Sheet {
    const host = at('canvas-host');
    const canvas = document.createElement('canvas');
    const [width, stageHeight] = [host.clientWidth & ~1, host.clientHeight & ~1];
    const colours = worded ? this.colours() : null;
    const above = worded ? titleStrip(subject(), width) : null;
    const below = colours ? scaleStrip(colours, width) : null;
    [canvas.width, canvas.height] = [width, (above?.height ?? 0) + stageHeight + (below?.height ?? 0)];
    return { canvas, stageHeight, above, below };
  }

  private keep(video: Blob): void {
    const { faces } = this.state.source.replay;
    const named = faces.length > 1 ? this.state.shown.visible.flatMap((i) => faces[i]?.name ?? []) : [];
    save(video, fileName(subject(), ...named, 'webm'));
  }

  /** The stage between its title and its colour bar. */
  private draw({ canvas, stageHeight, above, below }: Sheet, stage: HTMLCanvasElement): void {
    const on = canvas.getContext('2d')!;
    const top = above?.height ?? 0;
    on.save();
    on.translate(0, top);
    this.drawStage(on, canvas.width, stageHeight, stage);
    on.restore();
    if (above) on.drawImage(above, 0, 0);
    if (below) on.drawImage(below, 0, top + stageHeight);
  }

  /** The stage on the page's own background, with sides, names and time. */
  private drawStage(on: CanvasRenderingContext2D, width: number, height: number, stage: HTMLCanvasElement): void {
    const style = getComputedStyle(document.documentElement);
    const colour = (name: string) => style.getPropertyValue(name).trim();
    on.fillStyle = colour('--card');
    on.fillRect(0, 0, width, height);
    on.drawImage(stage, 0, 0, width, height);
    drawSideMarks(on, this.viewer()!.sideMarks, colour('--ink'), colour('--card'));
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

  /** `progress`: null where none is being made. */
  private showState(progress: string | null): void {
    this.button.textContent = progress === null ? words.saveVideo : [words.endVideo, progress].filter(Boolean).join(' · ');
    this.button.setAttribute('aria-pressed', String(progress !== null));
  }
}
