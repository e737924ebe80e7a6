// SPDX-License-Identifier: GPL-3.0-or-later
// The curves over time, each with a cursor at the time shown; pressing on one seeks.
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { landmarkTracksMm, type Replay } from './data';
import { landmarkName } from './format';

interface Curve {
  label: string;
  values: (number | null)[];
  dashed?: boolean;
}
interface Chart {
  title: string;
  caption: string;
  unit: string;
  timeS: number[];
  curves: Curve[];
  digits: number;
}

const palettes = {
  light: ['#0072b2', '#d55e00', '#009e73', '#b0569b', '#b58900', '#2f9bd0', '#7a5230', '#666666'],
  dark: ['#56b4e9', '#ff9248', '#3ad6a4', '#e497c9', '#f0e442', '#9ecbff', '#d2a679', '#b0b0b0'],
};

/** One chart in its card. Made anew when its curves or the colours of the page change. */
class Plot {
  private plot: uPlot | null = null;
  private readonly host = document.createElement('div');
  private readonly now = document.createElement('div');
  private timeS = NaN;

  constructor(
    readonly card: HTMLElement,
    private chart: Chart,
    private readonly seek: (timeS: number) => void,
  ) {
    const title = document.createElement('h2');
    title.textContent = chart.title;
    const caption = document.createElement('p');
    caption.textContent = chart.caption;
    this.host.className = 'plot';
    this.now.className = 'now';
    card.append(title, caption, this.host);
    this.draw();
    new ResizeObserver(() => this.resize()).observe(this.host);
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
    this.mark(this.timeS);
  }

  /** Puts the cursor and the figures in the legend at time t. */
  mark(t: number): void {
    this.timeS = t;
    const { plot } = this;
    if (!plot || Number.isNaN(t)) return;
    this.now.style.transform = `translateX(${plot.valToPos(t, 'x')}px)`;
    if (!plot.over.matches(':hover')) plot.setLegend({ idx: plot.valToIdx(t) }, false);
  }

  private resize(): void {
    const width = this.host.clientWidth;
    if (!this.plot || width === 0 || width === this.plot.width) return;
    this.plot.setSize({ width, height: this.plot.height });
    this.mark(this.timeS);
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
    over.addEventListener('pointerleave', () => requestAnimationFrame(() => this.mark(this.timeS)));
  }

  private options(): uPlot.Options {
    const { chart } = this;
    const style = getComputedStyle(document.documentElement);
    const ink = style.getPropertyValue('--ink-soft').trim();
    const grid = style.getPropertyValue('--line').trim();
    const palette = dark.matches ? palettes.dark : palettes.light;
    const show = (v: number | null) =>
      v === null || v === undefined ? '–' : v.toFixed(chart.digits).replace('-', '−') + chart.unit;
    const axis = { stroke: ink, grid: { stroke: grid, width: 1 }, ticks: { stroke: grid, size: 5 }, font };
    return {
      width: Math.max(this.host.clientWidth, 200),
      height: 190,
      cursor: { drag: { x: false, y: false }, y: false, points: { size: 6 }, sync: { key: 'time' } },
      scales: { x: { time: false } },
      legend: { live: true },
      axes: [
        { ...axis, size: 34, values: (_u, ticks) => ticks.map((t, i) => (i === ticks.length - 1 ? `${t} s` : `${t}`)) },
        { ...axis, size: 46, values: (_u, ticks) => ticks.map((t) => String(Number(t.toPrecision(6))).replace('-', '−')) },
      ],
      series: [
        { label: 't', value: (_u, v) => (v === null || v === undefined ? '–' : `${v.toFixed(3)} s`) },
        ...chart.curves.map((curve, i) => ({
          label: curve.label,
          stroke: curve.dashed ? ink : palette[i % palette.length],
          width: curve.dashed ? 1 : 2,
          dash: curve.dashed ? [5, 4] : i >= palette.length ? [8, 3] : undefined,
          points: { show: false },
          value: (_u: uPlot, v: number | null) => show(v),
        })),
      ],
    };
  }
}

const dark = window.matchMedia('(prefers-color-scheme: dark)');
const font = '11px system-ui, sans-serif';

function symmetryCharts(replay: Replay): Chart[] {
  const curve = replay.symmetry;
  if (!curve || curve.time_s.length < 2) return [];
  const floor = Math.log(curve.floor);
  return [
    {
      title: 'Symmetry of motion, S(t)',
      caption:
        'S = ln |ξL − ξR|; smaller is more symmetric. ' +
        `Dashed: the floor ln ${curve.floor.toExponential()} = ${floor.toFixed(2).replace('-', '−')}, below which sides are not told apart.`,
      unit: '', digits: 2, timeS: curve.time_s,
      curves: [
        { label: 'S', values: curve.s },
        { label: 'floor', values: curve.time_s.map(() => floor), dashed: true },
      ],
    },
    {
      title: 'Stretch of either side, ξ(t)',
      caption: 'Relative change of the distances from the mouth corner to eye, lid, nose and lip, summed.',
      unit: '', digits: 4, timeS: curve.time_s,
      curves: [
        { label: 'ξL (left)', values: curve.xi_left },
        { label: 'ξR (right)', values: curve.xi_right },
      ],
    },
  ];
}

/** Points to show first: those that drive, else those that move most; at most seven. */
function firstTracks(replay: Replay, tracks: (number | null)[][]): Set<number> {
  const { names } = replay.landmarks;
  const driven = replay.driven.names.map((name) => names.indexOf(name)).filter((i) => i >= 0);
  if (driven.length > 0) return new Set(driven.slice(0, 7));
  const most = tracks.map((track) => Math.max(0, ...track.map((v) => v ?? 0)));
  const order = names.map((_, i) => i).sort((a, b) => most[b] - most[a]);
  return new Set(order.slice(0, 5));
}

function trackChooser(names: string[], chosen: Set<number>, changed: () => void): HTMLElement {
  const details = document.createElement('details');
  details.className = 'chooser';
  const summary = document.createElement('summary');
  summary.textContent = `Choose points (${names.length})`;
  const list = document.createElement('div');
  names.forEach((name, i) => {
    const label = document.createElement('label');
    const box = document.createElement('input');
    box.type = 'checkbox';
    box.checked = chosen.has(i);
    box.addEventListener('change', () => {
      if (box.checked) chosen.add(i);
      else chosen.delete(i);
      changed();
    });
    label.append(box, landmarkName(name));
    list.append(label);
  });
  details.append(summary, list);
  return details;
}

export class Plots {
  private readonly plots: Plot[] = [];

  constructor(replay: Replay, into: HTMLElement, private readonly seek: (timeS: number) => void) {
    for (const chart of symmetryCharts(replay)) this.add(into, chart);
    this.addTracks(replay, into);
    dark.addEventListener('change', () => this.plots.forEach((plot) => plot.draw()));
  }

  mark(timeS: number): void {
    for (const plot of this.plots) plot.mark(timeS);
  }

  private add(into: HTMLElement, chart: Chart): Plot {
    const card = document.createElement('article');
    card.className = 'plot-card';
    into.append(card);
    const plot = new Plot(card, chart, this.seek);
    this.plots.push(plot);
    return plot;
  }

  private addTracks(replay: Replay, into: HTMLElement): void {
    const { names, timeS } = replay.landmarks;
    if (names.length === 0 || timeS.length < 2) return;
    const tracks = landmarkTracksMm(replay);
    const chosen = firstTracks(replay, tracks);
    const curves = () =>
      [...chosen].map((i) => ({ label: landmarkName(names[i]), values: tracks[i] }));
    const plot = this.add(into, {
      title: 'Point tracks',
      caption: 'Distance of points on the skin from where they were in the first frame, mm.',
      unit: ' mm', digits: 2, timeS, curves: curves(),
    });
    plot.card.append(trackChooser(names, chosen, () => plot.setCurves(curves())));
  }
}
