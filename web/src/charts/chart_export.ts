// SPDX-License-Identifier: GPL-3.0-or-later
// Export of a chart: its values as CSV, and a picture with title and legend.
import uPlot from 'uplot';
import { chartOptions, lineOf, type Chart } from './chart_options';
import { linesOf } from '../page/lines';
import { csvFile, subject } from '../page/save';
import { theme } from '../page/theme';

/** One row per time; values are not rounded as they are in the legend. */
export function csvOf(chart: Chart): Blob {
  const unit = chart.unit.trim();
  const names = chart.curves.map((c) => c.column ?? (unit ? `${c.label} (${unit})` : c.label));
  const rows = chart.timeS.map((t, row) => [t, ...chart.curves.map((c) => c.values[row] ?? null)]);
  return csvFile([['time (s)', ...names], ...rows]);
}

const width = 1800;
const height = 760;
const scale = 2;
const margin = 32;

/** The curves alone, larger than on the page. */
function plotOf(chart: Chart, window: [number, number] | null): Promise<uPlot> {
  const ratio = devicePixelRatio;
  const size = { widthPx: (width - 2 * margin) / ratio, heightPx: height / ratio, scale: scale / ratio };
  const options = chartOptions(chart, size, new Set());
  const data = [chart.timeS, ...chart.curves.map((c) => c.values)] as uPlot.AlignedData;
  return new Promise((done) => {
    options.hooks!.ready = [(plot) => queueMicrotask(() => done(plot))];
    options.legend = { show: false };
    if (window) options.scales!.x = { time: false, min: window[0], max: window[1] };
    new uPlot(options, data, document.createElement('div'));
  });
}

const letters = (px: number, weight = '') => `${weight} ${px * scale}px system-ui, sans-serif`.trim();

interface Entry {
  label: string;
  x: number;
  row: number;
  line: ReturnType<typeof lineOf>;
}

/** Where each curve's sample and name go, row by row. */
function legendOf(pen: CanvasRenderingContext2D, chart: Chart): Entry[] {
  let [x, row] = [margin, 0];
  return chart.curves.map((curve, i) => {
    const room = 56 + pen.measureText(curve.label).width;
    if (x > margin && x + room > width - margin) [x, row] = [margin, row + 1];
    const entry = { label: curve.label, x, row, line: lineOf(curve, i) };
    x += room + 40;
    return entry;
  });
}

function drawLegend(pen: CanvasRenderingContext2D, entries: Entry[], top: number, ink: string): void {
  for (const { label, x, row, line } of entries) {
    const y = top + 36 * row;
    pen.strokeStyle = line.colour;
    pen.lineWidth = line.widthPx * scale;
    pen.setLineDash(line.dash.map((length) => length * scale));
    pen.beginPath();
    pen.moveTo(x, y);
    pen.lineTo(x + 44, y);
    pen.stroke();
    pen.fillStyle = ink;
    pen.fillText(label, x + 56, y);
  }
}

/** Title, caption, curves and legend in the page's present colours. */
export async function pictureOf(chart: Chart, window: [number, number] | null): Promise<Blob> {
  const plot = await plotOf(chart, window);
  const { card, ink, inkSoft } = theme();
  const canvas = document.createElement('canvas');
  const pen = canvas.getContext('2d')!;
  pen.font = letters(15, '600');
  const title = linesOf(pen, `${subject()}: ${chart.title}`, width - 2 * margin);
  pen.font = letters(12);
  const caption = chart.caption ? linesOf(pen, chart.caption, width - 2 * margin) : [];
  const entries = legendOf(pen, chart);
  const captionTop = margin + 38 * title.length;
  const top = captionTop + 32 * caption.length + 18;
  canvas.width = width;
  canvas.height = top + height + 24 + 36 * (entries.length > 0 ? entries[entries.length - 1].row + 1 : 0) + margin / 2;
  pen.fillStyle = card;
  pen.fillRect(0, 0, canvas.width, canvas.height);
  pen.textBaseline = 'middle';
  pen.fillStyle = ink;
  pen.font = letters(15, '600');
  title.forEach((text, i) => pen.fillText(text, margin, margin + 14 + 38 * i));
  pen.fillStyle = inkSoft;
  pen.font = letters(12);
  caption.forEach((text, i) => pen.fillText(text, margin, captionTop + 20 + 32 * i));
  pen.drawImage(plot.ctx.canvas, margin, top);
  drawLegend(pen, entries, top + height + 24, ink);
  plot.destroy();
  return new Promise((done, fail) =>
    canvas.toBlob((blob) => (blob ? done(blob) : fail(new Error('the browser makes no picture'))), 'image/png'));
}
