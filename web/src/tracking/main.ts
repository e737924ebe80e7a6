// SPDX-License-Identifier: GPL-3.0-or-later
// Ties the parts together: data, cursor, charts and the page's controls.
import '../page/style.css';
import './tracking.css';
import type { Chart } from '../charts/chart_options';
import { at, button, element, startPage } from '../page/dom';
import { number } from '../page/format';
import { whenPrinting } from '../page/printing';
import { dark } from '../page/theme';
import { TimeChart } from '../charts/time_chart';
import { headAndDistances, residuals, type Section } from './charts';
import { Cursor, listenToKeys } from './cursor';
import { faultAt, faultSpans, readTracking, type Tracking } from './data';
import { commonRange, firstCaption, firstPairs, unitChart, unitChooser, unitPairs } from './units';

function factsText(t: Tracking): string {
  const count = t.timeS.length;
  const lasts = count > 1 ? t.timeS[count - 1] : 0;
  const lost = t.frames - t.valid;
  const valid = lost === 0 ? 'all valid' : `${number(t.valid)} valid, ${number(lost)} not`;
  const rate = lasts > 0 ? `, ${number(Number(((count - 1) / lasts).toPrecision(3)))} frames a second` : '';
  const scale = t.metric
    ? 'Lengths are metric: they come from measured depth.'
    : `There was no depth: lengths are scaled by a stated distance of ${number(t.eye_distance_mm)} mm between the outer eye corners.`;
  return (
    `${number(t.frames)} frames over ${lasts.toFixed(2)} s (${valid})${rate}; followed with the ${t.model.name} ` +
    `face model of ${number(t.model.vertices)} vertices and ${number(t.model.units)} action units. ${scale}`
  );
}

function notes(t: Tracking): (string | { text: string; frame: number })[] {
  const skipped = t.frames - t.timeS.length;
  return [
    ...t.faults.map((f) => ({
      frame: f.first,
      text:
        `Not valid: ${f.first === f.last ? 'frame' : 'frames'} ${t.index[f.first]}` +
        `${f.first === f.last ? '' : ` to ${t.index[f.last]}`} (${t.timeS[f.first].toFixed(2)} s): ${f.fault || 'no reason given'}`,
    })),
    ...(skipped > 0 ? [`${number(skipped)} frames are left out: their time does not rise.`] : []),
    ...(t.start_s !== 0 ? [`0 s here is ${t.start_s.toFixed(6).replace(/\.?0+$/, '')} s of the recording’s clock.`] : []),
    ...t.notes,
  ];
}

function fillHead(t: Tracking, cursor: Cursor): void {
  const title = `Tracking of ${t.recording}`;
  document.title = title;
  at('title').textContent = title;
  at('facts').textContent = factsText(t);
  for (const note of notes(t)) {
    const item = element('li');
    if (typeof note === 'string') item.textContent = note;
    else {
      item.append(button(note.text, 'link', () => cursor.goTo(note.frame)));
    }
    at('note-list').append(item);
    at('notes').hidden = false;
  }
  at('foot').textContent =
    'Keys: ← → a frame, with Shift ten; + − a shorter or longer stretch of time, 0 all. ' +
    'Numbers here are rounded; the CSV files have them whole. Made by Hyperex; needs no network.';
}

/** All charts of the page; those of units change with the choice. */
class Charts {
  private readonly charts = new Set<TimeChart>();
  private readonly shaded: [number, number][];

  constructor(private readonly tracking: Tracking, private readonly cursor: Cursor) {
    this.shaded = faultSpans(tracking);
    cursor.onChange(() => this.mark());
    dark.addEventListener('change', () => this.redraw());
    whenPrinting(() => this.redraw());
  }

  section({ title, caption, charts }: Section): { head: HTMLElement; grid: HTMLElement } {
    const section = element('section', '', 'group');
    section.setAttribute('aria-label', title);
    const head = element('div', '', 'group-head');
    head.append(element('h2', title), element('p', caption));
    const grid = element('div', '', 'grid');
    section.append(head, grid);
    at('plots').append(section);
    for (const chart of charts) this.add(grid, chart);
    return { head, grid };
  }

  add(grid: HTMLElement, chart: Chart): TimeChart {
    const card = element('article', '', 'plot-card');
    grid.append(card);
    const made = new TimeChart(
      card, { ...chart, shaded: this.shaded }, (t) => this.cursor.seek(t), () => this.mark(),
    );
    this.charts.add(made);
    this.markOne(made);
    return made;
  }

  remove(chart: TimeChart): void {
    this.charts.delete(chart);
    chart.remove();
  }

  mark(): void {
    for (const chart of this.charts) this.markOne(chart);
  }

  private markOne(chart: TimeChart): void {
    chart.show(this.cursor.window);
    chart.mark(this.tracking.timeS[this.cursor.frame]);
  }

  private redraw(): void {
    for (const chart of this.charts) chart.draw();
  }
}

function addUnits(tracking: Tracking, charts: Charts): void {
  const pairs = unitPairs(tracking);
  if (pairs.length === 0) return;
  const chosen = firstPairs(pairs);
  const range = commonRange(pairs);
  const { head, grid } = charts.section({
    title: 'Action units',
    caption: `${firstCaption(pairs)}, all on one scale. Left and right are the person’s own.`,
    charts: [],
  });
  const shown = new Map<(typeof pairs)[number], TimeChart>();
  const show = () => {
    for (const [pair, chart] of shown)
      if (!chosen.has(pair)) {
        charts.remove(chart);
        shown.delete(pair);
      }
    for (const pair of pairs.filter((p) => chosen.has(p))) {
      const made = shown.get(pair) ?? charts.add(grid, unitChart(pair, tracking.timeS, range));
      shown.set(pair, made);
      grid.append(made.card);
    }
  };
  head.append(unitChooser(pairs, chosen, show));
  show();
}

function wireTransport(tracking: Tracking, cursor: Cursor): void {
  const slider = at<HTMLInputElement>('frame');
  slider.max = String(cursor.last);
  slider.addEventListener('input', () => cursor.goTo(Number(slider.value)));
  at('zoom-in').addEventListener('click', () => cursor.zoom(0.5));
  at('zoom-out').addEventListener('click', () => cursor.zoom(2));
  at('zoom-all').addEventListener('click', () => cursor.zoom(0));
  const show = () => {
    const fault = faultAt(tracking, cursor.frame);
    const text =
      `frame ${tracking.index[cursor.frame]}  ·  ${tracking.timeS[cursor.frame].toFixed(3)} s` +
      (fault === null ? '' : `  ·  not valid: ${fault || 'no reason given'}`);
    slider.value = String(cursor.frame);
    slider.setAttribute('aria-valuetext', text);
    at('frame-label').textContent = text;
    at('transport').classList.toggle('not-valid', fault !== null);
    at<HTMLButtonElement>('zoom-all').disabled = at<HTMLButtonElement>('zoom-out').disabled = cursor.window === null;
  };
  cursor.onChange(show);
  show();
  listenToKeys(cursor);
}

function start(): void {
  const tracking = readTracking();
  const cursor = new Cursor(tracking.timeS);
  fillHead(tracking, cursor);
  if (tracking.timeS.length > 1) {
    const charts = new Charts(tracking, cursor);
    for (const section of headAndDistances(tracking)) charts.section(section);
    addUnits(tracking, charts);
    charts.section(residuals(tracking));
    wireTransport(tracking, cursor);
  } else {
    at('transport').hidden = true;
    at('plots').textContent = 'Fewer than two frames: there is nothing to plot over time.';
  }
  // What is drawn now is on the screen two frames later.
  requestAnimationFrame(() => requestAnimationFrame(() => {
    document.documentElement.dataset.readyMs = performance.now().toFixed(0);
    document.documentElement.dataset.ready = 'true';
  }));
}

startPage(start);
