// SPDX-License-Identifier: GPL-3.0-or-later
// The curves over time, each with a cursor at the time shown; pressing on one seeks.
import type { Chart } from '../../charts/chart_options';
import type { Replay } from '../data';
import { element } from '../../page/dom';
import { Undoing } from '../../page/listeners';
import type { Shown } from '../shown';
import { cornerCurves, dressCornerCard } from './corner_card';
import { addedCurves, stretchCurves, symmetryCurves } from './symmetry_charts';
import { dark } from '../../page/theme';
import { TimeChart } from '../../charts/time_chart';
import { ExcursionCurves, sideChooser } from './excursion_chart';
import { MuscleCurves, muscleChooser } from './muscle_chart';
import { TrackCurves, trackChooser } from './track_chart';

export class Plots {
  private readonly plots: TimeChart[] = [];
  private readonly undoing = new Undoing();

  constructor(
    replay: Replay, private readonly shown: Shown, private readonly into: HTMLElement,
    private readonly seek: (timeS: number) => void,
  ) {
    const corners = this.add('Corners of the mouth', () => cornerCurves(replay, shown));
    if (corners) this.undoing.add(dressCornerCard(replay, shown, corners.card));
    this.addExcursions(replay);
    this.add('Stretch of either side, ξ(t)', () => stretchCurves(replay, shown));
    this.add('Symmetry of motion, S(t)', () => symmetryCurves(replay, shown));
    this.add('What each variant adds, Δ(ξL − ξR)', () => addedCurves(replay, shown));
    this.addMuscles(replay);
    this.addTracks(replay);
    dark.addEventListener('change', () => this.draw(), { signal: this.undoing.signal });
  }

  /** Takes all charts off the page. */
  dispose(): void {
    this.undoing.undo();
    for (const plot of this.plots.splice(0)) plot.remove();
  }

  /** After the page's colours have changed. */
  draw(): void {
    for (const plot of this.plots) plot.draw();
  }

  mark(timeS: number): void {
    for (const plot of this.plots) plot.mark(timeS);
  }

  /** Follows what is shown; `made` returns the present chart, or always nothing. */
  private add(title: string, made: () => Omit<Chart, 'title'>[]): TimeChart | null {
    const [chart] = made();
    if (!chart) return null;
    const card = element('article', '', 'plot-card');
    this.into.append(card);
    const plot = new TimeChart(card, { ...chart, title }, this.seek);
    this.plots.push(plot);
    this.undoing.add(this.shown.onChange(() => plot.change(made()[0])));
    return plot;
  }

  private addExcursions(replay: Replay): void {
    const curves = ExcursionCurves.of(replay, this.shown);
    if (!curves) return;
    const plot = this.add('A corner of the mouth in all variants', () => [curves.now])!;
    const { box, show } = sideChooser(curves, () => plot.change(curves.now));
    plot.card.append(box);
    this.undoing.add(this.shown.onChange(show));
  }

  private addMuscles({ muscles, faces }: Replay): void {
    if (!muscles || muscles.groups.length === 0 || muscles.timeS.length < 2) return;
    const curves = new MuscleCurves(muscles, faces, this.shown);
    const plot = this.add('Muscles', () => [curves.now])!;
    plot.card.append(muscleChooser(curves, () => plot.change(curves.now)));
  }

  private addTracks(replay: Replay): void {
    const { names, timeS } = replay.landmarks;
    if (names.length === 0 || timeS.length < 2) return;
    const tracks = new TrackCurves(replay, this.shown);
    const plot = this.add('Point tracks', () => [tracks.now])!;
    plot.card.append(trackChooser(names, tracks.chosen, () => plot.change(tracks.now)));
  }
}
