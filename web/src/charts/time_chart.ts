// SPDX-License-Identifier: GPL-3.0-or-later
// One chart of curves over time, with a cursor at the time shown; pressing on it seeks.
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import './charts.css';
import { csvOf, pictureOf } from './chart_export';
import { chartOptions, type Chart, type Size } from './chart_options';
import { button, element } from '../page/dom';
import { printing } from '../page/printing';
import { fileName, save, saveButton, subject } from '../page/save';

/** On paper a chart is drawn larger and shrunk by the style sheet (charts.css), so that its lines are fine. */
const paper = { scale: 3, shrunk: 0.3, heightPx: 150 };

/** One chart in its card. It is made again when its curves or the colours of the page change. */
export class TimeChart {
  private plot: uPlot | null = null;
  private readonly host = document.createElement('div');
  private readonly caption = document.createElement('p');
  private readonly now = document.createElement('div');
  /** Labels of curves that the reader has hidden. */
  private readonly hidden = new Set<string>();
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
    const head = element('div', '', 'plot-head');
    head.append(element('h3', chart.title), this.tools());
    this.host.className = 'plot';
    this.host.style.minHeight = `${this.heightPx}px`;
    this.now.className = 'now';
    card.append(head, this.caption, this.host);
    this.draw();
    this.watch.observe(this.host);
  }

  /** Its title stays. */
  change(chart: Partial<Omit<Chart, 'title'>>): void {
    this.chart = { ...this.chart, ...chart };
    this.draw();
  }

  draw(): void {
    this.plot?.destroy();
    const { chart } = this;
    this.caption.textContent = chart.caption;
    this.caption.hidden = chart.caption === '';
    const data = [chart.timeS, ...chart.curves.map((c) => c.values)] as uPlot.AlignedData;
    this.plot = new uPlot(this.options(), data, this.host);
    this.plot.over.append(this.now);
    this.listen(this.plot.over);
    const picture = this.plot.ctx.canvas;
    picture.setAttribute('role', 'img');
    picture.setAttribute('aria-label', [chart.title, chart.yLabel, chart.caption].filter(Boolean).join('. '));
    this.makeButtons(this.plot);
    this.show(this.window);
  }

  /** Removes the chart from the page. */
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
    this.showFigures(plot, false);
  }

  /** The figures in the legend, unless the pointer shows others or they are up to date. */
  private showFigures(plot: uPlot, anew: boolean): void {
    const idx = plot.valToIdx(this.timeS);
    if (!plot.over.matches(':hover') && (anew || plot.legend.idx !== idx)) plot.setLegend({ idx }, false);
  }

  /** After drawing, the plot can place the cursor, and its legend is empty. */
  private afterDrawing(): void {
    const { plot, timeS } = this;
    if (!plot || Number.isNaN(timeS)) return;
    this.mark(timeS);
    this.showFigures(plot, true);
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
    const { widthPx } = this.size;
    if (!this.plot || this.host.clientWidth === 0 || widthPx === this.plot.width) return;
    this.plot.setSize({ width: widthPx, height: this.plot.height });
  }

  private get heightPx(): number {
    return this.chart.heightPx ?? 190;
  }

  private get size(): Size {
    const widthPx = Math.max(this.host.clientWidth, 200);
    if (!printing) return { widthPx, heightPx: this.heightPx, scale: 1 };
    const { scale, shrunk, heightPx } = paper;
    return { widthPx: Math.floor(widthPx / shrunk), heightPx: Math.round(heightPx / shrunk), scale };
  }

  private options(): uPlot.Options {
    const options = chartOptions(this.chart, this.size, this.hidden);
    options.hooks!.draw!.push(() => queueMicrotask(() => this.afterDrawing()));
    options.hooks!.setSeries = [(plot) => this.remember(plot)];
    return options;
  }

  /** Makes the buttons that hide and show curves accessible without a mouse. */
  private makeButtons(plot: uPlot): void {
    [...plot.root.querySelectorAll('.u-series')].slice(1).forEach((row, i) => {
      row.classList.toggle('hatched', this.chart.curves[i].under !== undefined);
      const head = row.querySelector('th')!;
      const toggle = button('', '', () => {}); // the press bubbles to the head, where uPlot listens
      toggle.title = 'Show or hide this curve; with Ctrl all others';
      toggle.append(...head.childNodes);
      head.append(toggle);
      toggle.setAttribute('aria-pressed', String(!this.hidden.has(this.chart.curves[i].label)));
    });
  }

  private remember(plot: uPlot): void {
    const buttons = plot.root.querySelectorAll('.u-series button');
    this.chart.curves.forEach(({ label }, i) => {
      const { show } = plot.series[i + 1];
      if (show) this.hidden.delete(label);
      else this.hidden.add(label);
      buttons[i]?.setAttribute('aria-pressed', String(show));
    });
  }

  /** The chart without the curves that the reader has hidden. */
  private get plotted(): Chart {
    // The others keep their colours.
    const curves = this.chart.curves.map((curve, i) => ({ ...curve, hue: curve.hue ?? i }));
    return { ...this.chart, curves: curves.filter((curve) => !this.hidden.has(curve.label)) };
  }

  private tools(): HTMLElement {
    const tools = element('span', '', 'plot-tools');
    const add = (name: string, says: string, press: () => void) =>
      tools.append(saveButton(name, says, this.chart.title, press));
    const file = (ending: string) => fileName(subject(), this.chart.title, ending);
    add('CSV', 'Save the plotted values', () => save(csvOf(this.plotted), file('csv')));
    add('PNG', 'Save the plot as a picture', () => {
      void pictureOf(this.plotted, this.window).then((picture) => save(picture, file('png')));
    });
    return tools;
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
}
