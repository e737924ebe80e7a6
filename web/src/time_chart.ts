// SPDX-License-Identifier: GPL-3.0-or-later
// One chart of curves over time, with a cursor at the time shown; pressing on it seeks.
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';

export interface Curve {
  label: string;
  values: (number | null)[];
  /** A thin line in the ink's colour, for what is only there to compare with. */
  dashed?: boolean;
  /** Place in the palette; else its place among the curves. */
  hue?: number;
  /** Drawn in dashes, to be told from another without colours. */
  broken?: boolean;
}
export interface Chart {
  title: string;
  caption: string;
  unit: string;
  timeS: number[];
  curves: Curve[];
  digits: number;
  /** What the upright axis shows, with its unit; the time axis is then named too. */
  yLabel?: string;
  heightPx?: number;
  /** Limits of the upright axis; else those of the curves. */
  range?: [number, number];
  /** Stretches of time that are shaded. */
  shaded?: [fromS: number, toS: number][];
}

const palettes = {
  light: ['#0072b2', '#d55e00', '#009e73', '#b0569b', '#b58900', '#2f9bd0', '#7a5230', '#666666'],
  dark: ['#56b4e9', '#ff9248', '#3ad6a4', '#e497c9', '#f0e442', '#9ecbff', '#d2a679', '#b0b0b0'],
};
const font = '11px system-ui, sans-serif';
export const dark = window.matchMedia('(prefers-color-scheme: dark)');

/** While the page is printed colours are the light ones, whatever the screen shows. */
let printing = false;
export function setPrinting(on: boolean): void {
  printing = on;
}

/** "−1.50": a true minus sign, as everywhere on the pages. */
export const signed = (text: string): string => text.replace('-', '−');

/** One chart in its card. Made anew when its curves or the colours of the page change. */
export class TimeChart {
  private plot: uPlot | null = null;
  private readonly host = document.createElement('div');
  private readonly now = document.createElement('div');
  private timeS = NaN;
  private window: [number, number] | null = null;
  private readonly watch = new ResizeObserver(() => this.resize());

  /** `left`: the pointer has left the chart. */
  constructor(
    readonly card: HTMLElement,
    private chart: Chart,
    private readonly seek: (timeS: number) => void,
    private readonly left: () => void = () => this.mark(this.timeS),
  ) {
    const title = document.createElement('h2');
    title.textContent = chart.title;
    const caption = document.createElement('p');
    caption.textContent = chart.caption;
    caption.hidden = chart.caption === '';
    this.host.className = 'plot';
    this.host.style.minHeight = `${this.heightPx}px`;
    this.now.className = 'now';
    card.append(title, caption, this.host);
    this.draw();
    this.watch.observe(this.host);
  }

  setCurves(curves: Curve[]): void {
    this.chart = { ...this.chart, curves };
    this.draw();
  }

  draw(): void {
    this.plot?.destroy();
    const { chart } = this;
    const data = [chart.timeS, ...chart.curves.map((c) => c.values)] as uPlot.AlignedData;
    this.plot = new uPlot(this.options(), data, this.host);
    this.plot.over.append(this.now);
    this.listen(this.plot.over);
    const picture = this.plot.ctx.canvas;
    picture.setAttribute('role', 'img');
    picture.setAttribute('aria-label', [chart.title, chart.yLabel, chart.caption].filter(Boolean).join('. '));
    this.show(this.window);
  }

  /** Takes the chart off the page for good. */
  remove(): void {
    this.watch.disconnect();
    this.plot?.destroy();
    this.plot = null;
    this.card.remove();
  }

  /** Puts the cursor and the figures in the legend at time t. */
  mark(t: number): void {
    this.timeS = t;
    const { plot } = this;
    if (!plot || Number.isNaN(t)) return;
    const { min, max } = plot.scales.x;
    this.now.hidden = min != null && max != null && (t < min || t > max);
    this.now.style.transform = `translateX(${plot.valToPos(t, 'x')}px)`;
    if (!plot.over.matches(':hover')) plot.setLegend({ idx: plot.valToIdx(t) }, false);
  }

  /** Shows this stretch of time; null: all. */
  show(window: [number, number] | null): void {
    const { timeS } = this.chart;
    if (window === null && this.window === null) return;
    this.window = window;
    const [min, max] = window ?? [timeS[0], timeS[timeS.length - 1]];
    this.plot?.setScale('x', { min, max });
  }

  /** Fits the chart to its card. */
  resize(): void {
    const width = this.host.clientWidth;
    if (!this.plot || width === 0 || width === this.plot.width) return;
    this.plot.setSize({ width, height: this.plot.height });
  }

  private get heightPx(): number {
    return this.chart.heightPx ?? 190;
  }

  private listen(over: HTMLElement): void {
    const go = (event: PointerEvent) => {
      const at = event.clientX - over.getBoundingClientRect().left;
      this.seek(this.plot!.posToVal(at, 'x'));
    };
    over.addEventListener('pointerdown', (event) => {
      over.setPointerCapture(event.pointerId);
      go(event);
    });
    over.addEventListener('pointermove', (event) => {
      if (event.buttons & 1) go(event);
    });
    over.addEventListener('pointerleave', () => requestAnimationFrame(() => this.left()));
  }

  /** Under the curves, over the whole height. */
  private shade(plot: uPlot, colour: string): void {
    const { ctx, bbox } = plot;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    ctx.fillStyle = colour;
    for (const [from, to] of this.chart.shaded ?? []) {
      const x = plot.valToPos(from, 'x', true);
      ctx.fillRect(x, bbox.top, Math.max(plot.valToPos(to, 'x', true) - x, 1), bbox.height);
    }
    ctx.restore();
  }

  private options(): uPlot.Options {
    const { chart } = this;
    const style = getComputedStyle(document.documentElement);
    const ink = style.getPropertyValue('--ink-soft').trim();
    const grid = style.getPropertyValue('--line').trim();
    const shading = style.getPropertyValue('--shading').trim();
    const palette = dark.matches && !printing ? palettes.dark : palettes.light;
    const show = (v: number | null) =>
      v === null || v === undefined ? '–' : signed(v.toFixed(chart.digits)) + chart.unit;
    const axis = {
      stroke: ink, grid: { stroke: grid, width: 1 }, ticks: { stroke: grid, size: 5 },
      font, labelFont: font, labelSize: 16, labelGap: 0,
    };
    const named = chart.yLabel !== undefined;
    const seconds = (ticks: number[]) =>
      ticks.map((t, i) => (i === ticks.length - 1 && !named ? `${t} s` : `${Number(t.toPrecision(6))}`));
    return {
      width: Math.max(this.host.clientWidth, 200),
      height: this.heightPx,
      cursor: { drag: { x: false, y: false }, y: false, points: { size: 6 }, sync: { key: 'time' } },
      scales: { x: { time: false }, ...(chart.range && { y: { range: chart.range } }) },
      legend: { live: true },
      axes: [
        { ...axis, size: named ? 26 : 34, label: named ? 'time (s)' : undefined, values: (_u, ticks) => seconds(ticks) },
        {
          ...axis, size: 46, label: chart.yLabel, space: this.heightPx < 170 ? 18 : 30,
          values: (_u, ticks) => ticks.map((t) => signed(String(Number(t.toPrecision(6))))),
        },
      ],
      series: [
        { label: 't', value: (_u, v) => (v === null || v === undefined ? '–' : `${v.toFixed(3)} s`) },
        ...chart.curves.map((curve, i) => ({
          label: curve.label,
          stroke: curve.dashed ? ink : palette[(curve.hue ?? i) % palette.length],
          width: curve.dashed ? 1 : 2,
          dash: curve.dashed ? [5, 4] : curve.broken || i >= palette.length ? [8, 3] : undefined,
          points: { show: false },
          value: (_u: uPlot, v: number | null) => show(v),
        })),
      ],
      hooks: {
        drawClear: [(plot) => this.shade(plot, shading)],
        // Only once drawn does the plot know where a time lies; then it empties its legend.
        draw: [() => queueMicrotask(() => this.mark(this.timeS))],
      },
    };
  }
}
