// SPDX-License-Identifier: GPL-3.0-or-later
// Ties the parts together: data, clock, stage, plots, and the keyboard.
import '../page/style.css';
import './report.css';
import type { Replay } from './data';
import { pageSource } from './data_source';
import { frameAt } from './face/deform';
import { at, element, startPage } from '../page/dom';
import { number } from '../page/format';
import { markWhatGoesOn } from '../page/scrolled_row';
import { wireKeys } from './keys';
import { Playback } from './playback';
import { Plots } from './curves/plots';
import { wirePrinting } from './printing';
import { Shown } from './shown';
import { Stage } from './face/stage';
import { transportKeys, wireTransport } from './transport';
import { fillNotes, fillSummary, fillWarnings } from './summary';
import { fillTables } from './tables/tables';

function fillPage(replay: Replay): void {
  const title = replay.title || 'A face in motion';
  document.title = title;
  at('title').textContent = title;
  const frames = replay.timeS.length;
  const lasts = frames > 1 ? replay.timeS[frames - 1] - replay.timeS[0] : 0;
  at('facts').textContent = [
    `${frames} frames over ${number(lasts)} s`,
    `${number(replay.points.length / 3)} skin vertices`,
    `largest displacement ${replay.maxDisplacementMm.toFixed(1)} mm`,
  ].join('  ·  ');
  const { summary, notes } = replay;
  const warnings = Array.isArray(summary.warnings) ? summary.warnings.length : 0;
  if (warnings > 0) {
    const link = element('a', warnings === 1 ? '1 warning' : `${warnings} warnings`, 'warning');
    link.setAttribute('href', '#note-list');
    at('facts').append('  ·  ', link);
  }
  at('summary').hidden = notes.length === 0 && Object.keys(summary).length === 0;
  fillWarnings(summary.warnings, at('warning-list'));
  fillNotes(notes, summary.warnings, at('note-list'));
  fillSummary(summary, at('summary-tables'));
  at('foot').textContent =
    `Replayed from ${replay.modes.length} displacement modes, exact to ` +
    `${number(Number(replay.maxErrorMm.toPrecision(2)))} mm. Made by Hyperex; needs no network.`;
}

function start(): void {
  const source = pageSource();
  const { replay } = source;
  fillPage(replay);
  const { timeS } = replay;
  const playback = new Playback(timeS[0] ?? 0, timeS[timeS.length - 1] ?? 0);
  const shown = new Shown(replay.faces.length);
  const stage = new Stage(replay, shown);
  const plots = new Plots(replay, shown, at('plots'), (t) => playback.seek(t));
  fillTables(replay, shown, at('tables'));
  for (const row of ['chips', 'faces', 'view-tools']) markWhatGoesOn(at(row));
  wirePrinting(stage, plots, at('canvas-host').closest('main')!);
  const showTransport = wireTransport(source, playback, shown);
  const show = () => {
    stage.moveTo(frameAt(timeS, playback.timeS), playback);
    plots.mark(playback.timeS);
    showTransport();
  };
  const keys = [...transportKeys(source, playback, shown), ...stage.keys()];
  wireKeys(keys, at<HTMLDialogElement>('help'), at<HTMLButtonElement>('open-help'), at<HTMLInputElement>('keys-on'));
  // Where nothing moves, the peak shows most.
  const still = !stage.playsByItself;
  if (still) playback.seek(timeS[replay.peakFrame] ?? 0);
  playback.onChange(show);
  shown.onChange(showTransport);
  show();
  document.documentElement.dataset.ready = 'true';
  if (!still) playback.play();
}

startPage(start);
