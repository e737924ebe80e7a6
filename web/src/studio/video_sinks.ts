// SPDX-License-Identifier: GPL-3.0-or-later
// Make a video from pictures of a canvas, each with a given time instead of that of the clock: by the browser's encoder
// or, where it has none, by its recorder, which gets one picture after the other.
import { webmOf, type EncodedPicture, type WebmVideo } from './webm';

export interface VideoSink {
  /** The canvas as it is now, at a time from the first picture on, ms; rising. */
  add(timeMs: number): Promise<void>;
  end(): Promise<Blob>;
}

const recordedTypes = ['video/webm;codecs=vp9', 'video/webm;codecs=vp8', 'video/webm'];

/** What this browser can record; none: nothing. */
export const recordedType = (): string | undefined =>
  typeof MediaRecorder === 'undefined' ? undefined : recordedTypes.find((type) => MediaRecorder.isTypeSupported(type));

const codecs: [webCodecs: string, matroska: WebmVideo['codec']][] = [['vp09.00.41.08', 'V_VP9'], ['vp8', 'V_VP8']];
/** Frames between two key frames: the most that a player decodes to jump to a time. */
const keyEach = 60;
/** Greatest number of pictures that may wait for the encoder. */
const mostWaiting = 4;
const microseconds = 1e3;

const pause = (ms = 0): Promise<void> => new Promise((done) => setTimeout(done, ms));

export class EncodedVideo implements VideoSink {
  private readonly pictures: EncodedPicture[] = [];
  private readonly encoder: VideoEncoder;
  private count = 0;
  private lastMs = 0;
  private stepMs = 0;
  private broken: Error | null = null;

  private constructor(private readonly canvas: HTMLCanvasElement, config: VideoEncoderConfig, private readonly codec: WebmVideo['codec']) {
    this.encoder = new VideoEncoder({
      output: (chunk) => {
        const bytes = new Uint8Array(chunk.byteLength);
        chunk.copyTo(bytes);
        this.pictures.push({ timeMs: chunk.timestamp / microseconds, key: chunk.type === 'key', bytes });
      },
      error: (error) => (this.broken = error),
    });
    this.encoder.configure(config);
  }

  static possible(): boolean {
    return typeof VideoEncoder !== 'undefined';
  }

  /** Null where the browser has no encoder for it. */
  static async of(canvas: HTMLCanvasElement, bitrate: number): Promise<EncodedVideo | null> {
    if (!EncodedVideo.possible()) return null;
    const { width, height } = canvas;
    for (const [codec, matroska] of codecs) {
      const config: VideoEncoderConfig = { codec, width, height, bitrate, latencyMode: 'quality' };
      const { supported } = await VideoEncoder.isConfigSupported(config).catch(() => ({ supported: false }));
      if (supported) return new EncodedVideo(canvas, config, matroska);
    }
    return null;
  }

  async add(timeMs: number): Promise<void> {
    const frame = new VideoFrame(this.canvas, { timestamp: Math.round(timeMs * microseconds) });
    this.encoder.encode(frame, { keyFrame: this.count++ % keyEach === 0 });
    frame.close();
    [this.stepMs, this.lastMs] = [timeMs - this.lastMs, timeMs];
    // Keeps the page responsive and its memory small.
    do {
      if (this.broken) throw this.broken;
      await pause();
    } while (this.encoder.encodeQueueSize > mostWaiting);
  }

  async end(): Promise<Blob> {
    await this.encoder.flush();
    this.encoder.close();
    if (this.broken) throw this.broken;
    const { width, height } = this.canvas;
    const { pictures, codec } = this;
    return webmOf({ codec, width, height, pictures, durationMs: this.lastMs + this.stepMs });
  }
}

/** The recorder takes its times from the clock: pictures are passed to it no faster than they will be shown. Where
 *  drawing is slower, the video is slower too; no picture is left out. */
export class RecordedVideo implements VideoSink {
  private readonly recorder: MediaRecorder;
  private readonly track: CanvasCaptureMediaStreamTrack;
  private readonly parts: Blob[] = [];
  private lastMs = 0;
  private handedAt = 0;
  /** A picture that is passed sooner may be left out. */
  private static readonly leastMs = 25;

  constructor(canvas: HTMLCanvasElement, bitsPerS: number) {
    const stream = canvas.captureStream(0);
    [this.track] = stream.getVideoTracks() as CanvasCaptureMediaStreamTrack[];
    this.recorder = new MediaRecorder(stream, { mimeType: recordedType(), videoBitsPerSecond: bitsPerS });
    this.recorder.ondataavailable = ({ data }) => this.parts.push(data);
    this.recorder.start();
  }

  async add(timeMs: number): Promise<void> {
    const stepMs = Math.max(timeMs - this.lastMs, RecordedVideo.leastMs);
    this.lastMs = timeMs;
    await pause(Math.max(this.handedAt + stepMs - performance.now(), 0));
    this.track.requestFrame();
    this.handedAt = performance.now();
    // The canvas must stay as it is until the picture has been taken from it.
    await new Promise((done) => requestAnimationFrame(done));
    await pause();
  }

  async end(): Promise<Blob> {
    await pause(200);
    const stopped = new Promise((done) => (this.recorder.onstop = done));
    this.recorder.stop();
    await stopped;
    return new Blob(this.parts, { type: 'video/webm' });
  }
}
