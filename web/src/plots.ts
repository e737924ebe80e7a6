// SPDX-License-Identifier: GPL-3.0-or-later
// The curves over time, each with a cursor at the time shown; pressing on one seeks.
import { landmarkTracksMm, type Replay } from './data';
import { landmarkName } from './format';
import { dark, signed, TimeChart, type Chart } from './time_chart';

function symmetryCharts(replay: Replay): Chart[] {
  const curve = replay.symmetry;
  if (!curve || curve.time_s.length < 2) return [];
  const floor = Math.log(curve.floor);
  return [
    {
      title: 'Symmetry of motion, S(t)',
      caption:
        'S = ln |ξL − ξR|; smaller is more symmetric. ' +
        `Dashed: the floor ln ${curve.floor.toExponential()} = ${signed(floor.toFixed(2))}, below which sides are not told apart.`,
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
  private readonly plots: TimeChart[] = [];

  constructor(replay: Replay, into: HTMLElement, private readonly seek: (timeS: number) => void) {
    for (const chart of symmetryCharts(replay)) this.add(into, chart);
    this.addTracks(replay, into);
    dark.addEventListener('change', () => this.plots.forEach((plot) => plot.draw()));
  }

  mark(timeS: number): void {
    for (const plot of this.plots) plot.mark(timeS);
  }

  private add(into: HTMLElement, chart: Chart): TimeChart {
    const card = document.createElement('article');
    card.className = 'plot-card';
    into.append(card);
    const plot = new TimeChart(card, chart, this.seek);
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
