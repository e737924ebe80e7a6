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
  /** Marks of the subject's own sides, in pixels of the stage. */
  marks: SideMark[];
  title: string;
  time: string;
  /** One or two faces, left one first. */
  faces: { name: string; changes: string[]; colour: string }[];
  /** Where two faces are divided, from 0 to 1. */
  divided: number | null;
  colours: Scale | null;
  /** What a reader of the figures must know, a line each. */
  cautions: string[];
}

const margin = 18;
const headHeight = 58;
const barWidth = 340;
const barHeight = 76;
const remarkHeight = 16;
/** Line height in the foot and below a face. */
const lineHeight = 16;
/** Most lines of the text below a face. */
const mostLines = 14;
const bandWords = '±: from jitter (95 %) and mesh (one sample) alone.';
const budgetWords = '95 %: with all errors of the error budget.';
const ofBudget = /(95 %: |at least )±/;
const ofBand = /(?<!95 %: |at least )±/;
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

/** The same background as on the page: lighter behind the face. */
function drawBackground(pen: Pen, top: number, stageHeight: number): void {
  const { width, on } = pen;
  on.save();
  on.beginPath();
  on.rect(0, top, width, stageHeight);
  on.clip();
  // To the farthest corner, as style sheets do it.
  const [x, y] = [0.5 * width, 0.38 * stageHeight];
  const [rx, ry] = [0.5 * width * Math.SQRT2, 0.62 * stageHeight * Math.SQRT2];
  on.translate(x, top + y);
  on.scale(1, ry / rx);
  const fade = on.createRadialGradient(0, 0, 0, 0, 0, rx);
  fade.addColorStop(0, pen.colour('--stage-top'));
  fade.addColorStop(1, pen.colour('--stage-bottom'));
  on.fillStyle = fade;
  on.fillRect(-2 * width, -2 * pen.height * (rx / ry), 4 * width, 4 * pen.height * (rx / ry));
  on.restore();
}

/** The text below a face: its name and its figures. */
interface Caption {
  face: PictureParts['faces'][number];
  lines: string[];
}

/** `most`: the width for each, in pixels. */
const captionsOf = (pen: Pen, faces: PictureParts['faces'], most: number): Caption[] =>
  faces.map((face) => {
    pen.on.font = `400 12px ${family}`;
    const lines = face.changes.flatMap((text) => linesOf(pen.on, text, most));
    if (lines.length > mostLines) lines.splice(mostLines - 1, Infinity, `${lines[mostLines - 1]} …`);
    return { face, lines };
  });

const captionHeight = (captions: Caption[]): number =>
  captions.length > 0 ? 36 + lineHeight * Math.max(...captions.map(({ lines }) => lines.length)) : 0;

function drawCaption(pen: Pen, { face, lines }: Caption, x: number, top: number, most: number): void {
  pen.fill(face.colour, x, top + 12, 11, 11, 5.5);
  pen.text(face.name, x + 19, top + 18, 14, pen.colour('--ink'), { weight: 600, most: most - 19 });
  lines.forEach((line, i) => pen.text(line, x, top + 38 + lineHeight * i, 12, pen.colour('--ink-soft')));
}

function drawScale(pen: Pen, scale: Scale, top: number): void {
  const { on, width } = pen;
  const long = Math.min(barWidth, width - 2 * margin);
  const x = width - margin - long;
  const fade = on.createLinearGradient(x, 0, x + long, 0);
  const stops = rampStops(scale.ramp);
  stops.forEach((stop, i) => fade.addColorStop(i / (stops.length - 1), stop));
  pen.text(`${scale.title}, ${scale.unit}`, x, top + 15, 13, pen.colour('--ink'), { weight: 600, most: long });
  pen.fill(fade, x, top + 27, long, 11, 3);
  ticksOf(scale).forEach(({ text, share }) => {
    const align = share === 0 ? 'left' : share === 1 ? 'right' : 'center';
    pen.text(text, x + share * long, top + 50, 12, pen.colour('--ink-soft'), { align });
  });
  pen.text(scale.remark, x, top + 68, 12, pen.colour('--ink-soft'), { most: long });
}

/** The words in the foot, as lines; beside the colour bar where there is room for both. */
function footOf(pen: Pen, { faces, colours, cautions }: PictureParts): { lines: string[]; below: number; height: number } {
  const narrow = pen.width < 620;
  const says = (what: RegExp) => faces.some(({ changes }) => changes.some((text) => what.test(text)));
  const words = [
    ...(narrow ? ['Made by Hyperex, a research tool and no medical device.'] : ['Made by Hyperex', 'A research tool and no medical device.']),
    ...(says(ofBand) ? [bandWords] : []), ...(says(ofBudget) ? [budgetWords] : []), ...cautions,
  ];
  pen.on.font = `400 12px ${family}`;
  const room = pen.width - 2 * margin - (colours && !narrow ? barWidth + margin : 0);
  const lines = words.flatMap((text) => linesOf(pen.on, text, room));
  const bar = colours ? barHeight + (colours.remark ? remarkHeight : 0) : 0;
  const below = narrow ? bar : 0;
  return { lines, below, height: Math.max(bar, below + 24 + lineHeight * lines.length) };
}

/** A line between two faces, through the stage alone. */
function drawDivision(pen: Pen, divided: number, top: number, stageHeight: number): void {
  const x = Math.min(Math.max(divided * pen.width, 2), pen.width - 2);
  pen.on.globalAlpha = 0.65;
  pen.fill(pen.colour('--card'), x - 1.75, top, 3.5, stageHeight);
  pen.on.globalAlpha = 1;
  pen.fill(pen.colour('--ink'), x - 0.75, top, 1.5, stageHeight);
}

export type StageParts = Pick<PictureParts, 'stage' | 'scale' | 'marks' | 'divided'>;

/** The faces on their background, from `top` on, with the letters of their sides `letterPx` high. */
function drawStage(pen: Pen, { stage, scale, marks, divided }: StageParts, top: number, letterPx?: number): void {
  const height = stage.height / scale;
  drawBackground(pen, top, height);
  pen.on.drawImage(stage, 0, top, pen.width, height);
  drawSideMarks(pen.on, marks.map((mark) => ({ ...mark, y: top + mark.y })), pen.colour('--ink'), pen.colour('--card'), letterPx);
  if (divided !== null) drawDivision(pen, divided, top, height);
}

/** The stage without words. */
export function drawStageAlone(parts: StageParts, letterPx: number): HTMLCanvasElement {
  const { stage, scale } = parts;
  const pen = new Pen(stage.width / scale, stage.height / scale, scale);
  drawStage(pen, parts, 0, letterPx);
  return pen.canvas;
}

function drawTitle(pen: Pen, title: string, most: number): void {
  pen.text(title, margin, headHeight / 2, pen.width < 620 ? 16 : 19, pen.colour('--ink'), { weight: 650, most });
}

/** The title alone, as a picture has it above the stage. */
export function titleStrip(title: string, width: number): HTMLCanvasElement {
  const pen = new Pen(width, headHeight, 1);
  pen.fill(pen.colour('--card'), 0, 0, width, headHeight);
  drawTitle(pen, title, width - 2 * margin);
  return pen.canvas;
}

/** The colour bar alone, as a picture has it below the stage. */
export function scaleStrip(scale: Scale, width: number): HTMLCanvasElement {
  const pen = new Pen(width, barHeight + (scale.remark ? remarkHeight : 0), 1);
  pen.fill(pen.colour('--card'), 0, 0, width, pen.height);
  drawScale(pen, scale, 0);
  return pen.canvas;
}

/** From the top: title and time, the stage, the text of each face, the foot. Nothing covers a face. */
export function drawPicture(parts: PictureParts): HTMLCanvasElement {
  const { stage, scale, faces } = parts;
  const width = stage.width / scale;
  const stageHeight = stage.height / scale;
  const column = faces.length > 1 ? width / 2 : width;
  const most = column - 2 * margin;
  // Its size depends on how the texts break, which a pen must measure.
  const measuring = new Pen(width, 1, 1);
  const captions = captionsOf(measuring, faces, most);
  const foot = footOf(measuring, parts);
  const captionTop = headHeight + stageHeight;
  const footTop = captionTop + captionHeight(captions);
  const pen = new Pen(width, footTop + foot.height, scale);
  pen.fill(pen.colour('--card'), 0, 0, pen.width, pen.height);
  drawStage(pen, parts, headHeight);

  const soft = pen.colour('--ink-soft');
  pen.on.font = `400 14px ${family}`;
  const timeWidth = pen.on.measureText(parts.time).width;
  drawTitle(pen, parts.title, width - 3 * margin - timeWidth);
  pen.text(parts.time, width - margin, headHeight / 2, 14, soft, { align: 'right' });
  captions.forEach((caption, i) => drawCaption(pen, caption, margin + i * column, captionTop, most));
  if (captions.length > 0) pen.fill(pen.colour('--line'), margin, footTop - 0.5, width - 2 * margin, 1);
  if (parts.colours) drawScale(pen, parts.colours, footTop);
  foot.lines.forEach((line, i) => pen.text(line, margin, footTop + foot.below + 20 + lineHeight * i, 12, soft));
  return pen.canvas;
}

export const pngOf = (canvas: HTMLCanvasElement): Promise<Blob> =>
  new Promise((done, fail) =>
    canvas.toBlob((blob) => (blob ? done(blob) : fail(new Error('the browser makes no picture'))), 'image/png'));
