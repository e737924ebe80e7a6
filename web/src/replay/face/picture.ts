// SPDX-License-Identifier: GPL-3.0-or-later
// The stage as a picture to save: with title, names, time and colour bar, on the page's own background.
import { rampStops } from './colour';
import { ticksOf, type Scale } from './colouring';
import { drawSideMarks, type SideMark } from './side_marks';
import { linesOf } from '../../page/lines';

export interface PictureParts {
  /** The faces as drawn, `scale` times the size of the stage. */
  stage: HTMLCanvasElement;
  scale: number;
  /** Of the subject's own sides, in pixels of the stage. */
  marks: SideMark[];
  title: string;
  time: string;
  /** One or two faces, left one first. */
  faces: { name: string; changes: string[]; colour: string }[];
  /** Where two faces are divided, from 0 to 1. */
  divided: number | null;
  colours: Scale | null;
}

const margin = 18;
const headHeight = 58;
const footHeight = 76;
const remarkHeight = 16;
/** Of what a face changes; the face is below. */
const mostLines = 8;
const bandWords = '±: from jitter (95 %) and mesh (one sample) alone.';
const family = "system-ui, 'Segoe UI', 'DejaVu Sans', sans-serif";

/** A drawing context in the page's pixels. */
class Pen {
  readonly canvas = document.createElement('canvas');
  readonly on: CanvasRenderingContext2D;
  private readonly style = getComputedStyle(document.documentElement);

  constructor(readonly width: number, readonly height: number, scale: number) {
    this.canvas.width = Math.round(width * scale);
    this.canvas.height = Math.round(height * scale);
    this.on = this.canvas.getContext('2d')!;
    this.on.scale(scale, scale);
    this.on.textBaseline = 'middle';
  }

  colour(name: string): string {
    return this.style.getPropertyValue(name).trim();
  }

  fill(colour: string | CanvasGradient, x: number, y: number, width: number, height: number, radius = 0): void {
    this.on.fillStyle = colour;
    this.on.beginPath();
    this.on.roundRect(x, y, width, height, radius);
    this.on.fill();
  }

  /** Shortened to `most` pixels; returns where it ends. */
  text(what: string, x: number, y: number, px: number, colour: string, options: {
    weight?: number; align?: CanvasTextAlign; most?: number;
  } = {}): number {
    const { on } = this;
    on.font = `${options.weight ?? 400} ${px}px ${family}`;
    on.textAlign = options.align ?? 'left';
    on.fillStyle = colour;
    const most = options.most ?? Infinity;
    let shown = what;
    while (shown.length > 1 && on.measureText(shown).width > most) shown = `${shown.slice(0, -2).trimEnd()}…`;
    on.fillText(shown, x, y);
    return x + on.measureText(shown).width;
  }
}

/** As the stage of the page: lighter behind the face. */
function drawBackground(pen: Pen, stageHeight: number): void {
  const { width, height, on } = pen;
  pen.fill(pen.colour('--card'), 0, 0, width, height);
  on.save();
  on.beginPath();
  on.rect(0, headHeight, width, stageHeight);
  on.clip();
  // To the farthest corner, as style sheets do it.
  const [x, y] = [0.5 * width, 0.38 * stageHeight];
  const [rx, ry] = [0.5 * width * Math.SQRT2, 0.62 * stageHeight * Math.SQRT2];
  on.translate(x, headHeight + y);
  on.scale(1, ry / rx);
  const fade = on.createRadialGradient(0, 0, 0, 0, 0, rx);
  fade.addColorStop(0, pen.colour('--stage-top'));
  fade.addColorStop(1, pen.colour('--stage-bottom'));
  on.fillStyle = fade;
  on.fillRect(-2 * width, -2 * height * (rx / ry), 4 * width, 4 * height * (rx / ry));
  on.restore();
}

function drawName(pen: Pen, face: PictureParts['faces'][number], x: number, most: number, right: boolean): void {
  const { on } = pen;
  const y = headHeight + 12;
  const small = most < 220; // no room for what differs
  const px = small ? 12 : 14;
  on.font = `600 ${px}px ${family}`;
  const nameWidth = on.measureText(face.name).width + 19;
  on.font = `400 12px ${family}`;
  const lines = small ? [] : face.changes.flatMap((text) => linesOf(on, text, most - 20));
  if (lines.length > mostLines) lines.splice(mostLines - 1, Infinity, `${lines[mostLines - 1]} …`);
  const inner = Math.min(Math.max(nameWidth, ...lines.map((line) => on.measureText(line).width)), most - 20);
  const left = right ? x + most - inner - 20 : x;
  on.globalAlpha = 0.85;
  pen.fill(pen.colour('--card'), left, y, inner + 20, lines.length > 0 ? 30 + 16 * lines.length : 29, 8);
  on.globalAlpha = 1;
  pen.fill(face.colour, left + 10, y + 9, 11, 11, 5.5);
  pen.text(face.name, left + 29, y + 15, px, pen.colour('--ink'), { weight: 600, most: inner - 18 });
  lines.forEach((line, i) => pen.text(line, left + 10, y + 34 + 16 * i, 12, pen.colour('--ink-soft'), { most: inner + 1 }));
}

function drawScale(pen: Pen, scale: Scale, top: number): void {
  const { on, width } = pen;
  const barWidth = Math.min(340, width - 2 * margin);
  const x = width - margin - barWidth;
  const fade = on.createLinearGradient(x, 0, x + barWidth, 0);
  const stops = rampStops(scale.ramp);
  stops.forEach((stop, i) => fade.addColorStop(i / (stops.length - 1), stop));
  pen.text(`${scale.title}, ${scale.unit}`, x, top + 15, 13, pen.colour('--ink'), { weight: 600, most: barWidth });
  pen.fill(fade, x, top + 27, barWidth, 11, 3);
  ticksOf(scale).forEach(({ text, share }) => {
    const align = share === 0 ? 'left' : share === 1 ? 'right' : 'center';
    pen.text(text, x + share * barWidth, top + 50, 12, pen.colour('--ink-soft'), { align });
  });
  pen.text(scale.remark, x, top + 68, 12, pen.colour('--ink-soft'), { most: barWidth });
}

export function drawPicture(parts: PictureParts): HTMLCanvasElement {
  const { stage, scale, faces, divided } = parts;
  const width = stage.width / scale;
  const stageHeight = stage.height / scale;
  // Beside the bar there is no room for words in a narrow picture.
  const narrow = width < 620;
  const foot = footHeight + (narrow && parts.colours ? 30 : 0) + (parts.colours?.remark ? remarkHeight : 0);
  const pen = new Pen(width, headHeight + stageHeight + foot, scale);
  drawBackground(pen, stageHeight);
  pen.on.drawImage(stage, 0, headHeight, width, stageHeight);

  const ink = pen.colour('--ink');
  drawSideMarks(pen.on, parts.marks.map((mark) => ({ ...mark, y: headHeight + mark.y })), ink, pen.colour('--card'));
  const soft = pen.colour('--ink-soft');
  pen.on.font = `400 14px ${family}`;
  const timeWidth = pen.on.measureText(parts.time).width;
  pen.text(parts.title, margin, headHeight / 2, narrow ? 16 : 19, ink, { weight: 650, most: width - 3 * margin - timeWidth });
  pen.text(parts.time, width - margin, headHeight / 2, 14, soft, { align: 'right' });

  if (divided !== null) {
    const x = Math.min(Math.max(divided * width, 2), width - 2);
    pen.on.globalAlpha = 0.65;
    pen.fill(pen.colour('--card'), x - 1.75, headHeight, 3.5, stageHeight);
    pen.on.globalAlpha = 1;
    pen.fill(ink, x - 0.75, headHeight, 1.5, stageHeight);
  }
  const room = (faces.length > 1 ? width / 2 : width) - 24;
  faces.forEach((face, i) => drawName(pen, face, i === 0 ? 12 : width / 2 + 12, room, i > 0));

  const top = headHeight + stageHeight;
  if (parts.colours) drawScale(pen, parts.colours, top);
  const uncertain = faces.some(({ changes }) => changes.some((text) => text.includes('±')));
  const words = narrow && parts.colours ? top + foot - 18 : top + 24;
  if (narrow) {
    pen.text('Made by Hyperex, a research tool and no medical device.', margin, words, 11, soft, { most: width - 2 * margin });
    if (uncertain) pen.text(bandWords, margin, words + 13, 11, soft);
  } else {
    pen.text('Made by Hyperex', margin, words, 12, soft);
    pen.text('A research tool and no medical device.', margin, words + 20, 12, soft);
    if (uncertain) pen.text(bandWords, margin, words + 40, 12, soft);
  }
  return pen.canvas;
}

export const pngOf = (canvas: HTMLCanvasElement): Promise<Blob> =>
  new Promise((done, fail) =>
    canvas.toBlob((blob) => (blob ? done(blob) : fail(new Error('the browser makes no picture'))), 'image/png'));
