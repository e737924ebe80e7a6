// SPDX-License-Identifier: GPL-3.0-or-later
// The description of a chart, and its options for uPlot.
import type uPlot from 'uplot';
import { signed } from '../page/format';
import { theme } from '../page/theme';

export interface Curve {
  label: string;
  values: (number | null)[];
  /** A thin line in the text's colour, for curves that serve only as a reference. */
  dashed?: boolean;
  /** Place in the palette; past its end the colours repeat, dotted. Else its place among the curves. */
  hue?: number;
  /** Dashed, to differ from another without colours. */
  broken?: boolean;
  /** Drawn thicker than others. */
  strong?: boolean;
  /** The area under the curve is hatched and has this name. */
  under?: string;
  /** Its name in the CSV file, with the unit; else label and unit. */
  column?: string;
}
export interface Chart {
  title: string;
  caption: string;
  unit: string;
  timeS: number[];
  curves: Curve[];
  digits: number;
  /** Title of the vertical axis, with its unit; the time axis then has a title too. */
  yLabel?: string;
  heightPx?: number;
  /** Limits of the vertical axis; default: those of the curves. */
  range?: [number, number];
  /** Stretches of time that are shaded. */
  shaded?: [fromS: number, toS: number][];
}

type Range = uPlot.Range.MinMax;

export function lineOf(curve: Curve, i: number): { colour: string; widthPx: number; dash: number[] } {
  const { inkSoft, palette } = theme();
  if (curve.dashed) return { colour: inkSoft, widthPx: 1, dash: [5, 4] };
  const hue = curve.hue ?? i;
  const dash = [...(curve.broken ? [8, 3] : []), ...(hue >= palette.length ? [2, 3] : [])];
  return { colour: palette[hue % palette.length], widthPx: curve.strong ? 3 : 2, dash };
}

/** A pattern of slanted lines in the soft text colour. */
function hatching(scale: number): CanvasPattern | string {
  const { inkSoft } = theme();
  const size = Math.round(7 * scale * devicePixelRatio);
  const tile = document.createElement('canvas');
  tile.width = tile.height = size;
  const pen = tile.getContext('2d');
  if (!pen) return 'transparent';
  pen.strokeStyle = inkSoft;
  pen.globalAlpha = 0.45;
  pen.lineWidth = size / 8;
  for (const shift of [-size, 0, size]) {
    pen.beginPath();
    pen.moveTo(shift - 1, size + 1);
    pen.lineTo(shift + size + 1, -1);
    pen.stroke();
  }
  return pen.createPattern(tile, 'repeat') ?? 'transparent';
}

/** Under the curves, over the whole height. */
function shade(plot: uPlot, spans: [number, number][]): void {
  const { ctx, bbox } = plot;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.fillStyle = theme().shading;
  for (const [from, to] of spans) {
    const x = plot.valToPos(from, 'x', true);
    ctx.fillRect(x, bbox.top, Math.max(plot.valToPos(to, 'x', true) - x, 1), bbox.height);
  }
  ctx.restore();
}

/** The name of what is hatched, at the plot's lower right, on a patch of the card's colour. */
function nameHatched(plot: uPlot, chart: Chart, font: string): void {
  const i = chart.curves.findIndex((curve) => curve.under !== undefined);
  if (i < 0 || !plot.series[i + 1].show) return;
  const text = chart.curves[i].under!;
  const { ctx, bbox } = plot;
  ctx.save();
  ctx.font = font.replace(/(\d+)px/, (_m, px: string) => `${Number(px) * devicePixelRatio}px`);
  const { width, fontBoundingBoxAscent: up, fontBoundingBoxDescent: down } = ctx.measureText(text);
  const pad = (up + down) / 4;
  const [x, y] = [bbox.left + bbox.width - 3 * pad, bbox.top + bbox.height - 2 * pad];
  ctx.fillStyle = theme().card;
  ctx.fillRect(x - width - pad, y - up - down, width + 2 * pad, up + down + pad);
  ctx.fillStyle = theme().inkSoft;
  ctx.textAlign = 'right';
  ctx.textBaseline = 'alphabetic';
  ctx.fillText(text, x, y - down / 2);
  ctx.restore();
}

/** A little room above and below, so that the area under the lowest curve is visible. */
const withRoom = (_plot: uPlot, least: number | null, most: number | null): Range =>
  least === null || most === null ? [null, null] : [least - 0.13 * (most - least || 1), most + 0.06 * (most - least || 1)];

export interface Size {
  widthPx: number;
  heightPx: number;
  /** Scale of letters and lines; 1 on the page. */
  scale: number;
}

export const figure = (chart: Chart, v: number | null | undefined): string =>
  v === null || v === undefined ? '–' : signed(v.toFixed(chart.digits)) + chart.unit;

export function chartOptions(chart: Chart, size: Size, hidden: ReadonlySet<string>): uPlot.Options {
  const { inkSoft, line } = theme();
  const { scale } = size;
  const font = `${11 * scale}px system-ui, sans-serif`;
  const axis = {
    stroke: inkSoft, grid: { stroke: line, width: scale }, ticks: { stroke: line, size: 5 * scale, width: scale },
    gap: 5 * scale, font, labelFont: font, labelSize: 16 * scale, labelGap: 0,
  };
  const named = chart.yLabel !== undefined;
  const hatched = chart.curves.some((curve) => curve.under !== undefined);
  const range = chart.range ?? (hatched ? withRoom : undefined);
  const seconds = (ticks: number[]) =>
    ticks.map((t, i) => (i === ticks.length - 1 && !named ? `${t} s` : `${Number(t.toPrecision(6))}`));
  return {
    width: size.widthPx,
    height: size.heightPx,
    cursor: { drag: { x: false, y: false }, y: false, points: { size: 6 }, sync: { key: 'time' } },
    scales: { x: { time: false }, ...(range && { y: { range } }) },
    legend: {
      live: true,
      markers: {
        dash: (_u, i) => (chart.curves[i - 1].dashed || chart.curves[i - 1].broken ? 'dashed' : 'solid'),
        fill: (_u, i) => (chart.curves[i - 1].under ? 'repeating-linear-gradient(-45deg, currentColor 0 1px, transparent 1px 4px)' : ''),
      },
    },
    axes: [
      {
        ...axis, size: (named ? 26 : 34) * scale, space: 50 * scale,
        label: named ? 'time (s)' : undefined, values: (_u, ticks) => seconds(ticks),
      },
      {
        ...axis, size: 46 * scale, label: chart.yLabel, space: (size.heightPx < 170 * scale ? 18 : 30) * scale,
        values: (_u, ticks) => ticks.map((t) => signed(String(Number(t.toPrecision(6))))),
      },
    ],
    series: [
      { label: 't', value: (_u, v) => (v === null || v === undefined ? '–' : `${v.toFixed(3)} s`) },
      ...chart.curves.map((curve, i) => {
        const { colour, widthPx, dash } = lineOf(curve, i);
        return {
          label: curve.label,
          show: !hidden.has(curve.label),
          stroke: colour,
          width: widthPx * scale,
          dash: dash.map((length) => length * scale),
          points: { show: false },
          value: (_u: uPlot, v: number | null) => figure(chart, v),
          ...(curve.under !== undefined && {
            fill: () => hatching(scale),
            fillTo: (plot: uPlot) => plot.scales.y.min!,
          }),
        };
      }),
    ],
    hooks: {
      drawClear: [(plot) => shade(plot, chart.shaded ?? [])],
      draw: [(plot) => nameHatched(plot, chart, font)],
    },
  };
}
