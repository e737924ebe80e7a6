// SPDX-License-Identifier: GPL-3.0-or-later
// Ties the parts together: data, clock, stage, plots, and the keyboard.
import '../page/style.css';
import { readReplay, type Replay } from './data';
import { frameAt } from './face/deform';
import { at, element, startPage } from '../page/dom';
import { number } from '../page/format';
import { wireKeys, type Key } from './keys';
import { Playback } from './playback';
import { Plots } from './curves/plots';
import { Shown } from './shown';
import { Stage } from './face/stage';
import { fillNotes, fillSummary } from './summary';
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
  fillNotes(notes, summary.warnings, at('note-list'));
  fillSummary(summary, at('summary-tables'));
  at('foot').textContent =
    `Replayed from ${replay.modes.length} displacement modes, exact to ` +
    `${number(Number(replay.maxErrorMm.toPrecision(2)))} mm. Made by Hyperex; needs no network.`;
}

function wireTransport(replay: Replay, playback: Playback): () => void {
  const slider = at<HTMLInputElement>('frame');
  const label = at<HTMLOutputElement>('frame-label');
  const play = at<HTMLButtonElement>('play');
  const speed = at<HTMLSelectElement>('speed');
  const last = Math.max(replay.timeS.length - 1, 0);
  slider.max = String(last);
  slider.addEventListener('input', () => playback.seek(replay.timeS[Number(slider.value)]));
  const toggle = () => (playback.playing ? playback.pause() : playback.play());
  play.addEventListener('click', toggle);
  speed.addEventListener('change', () => (playback.speed = Number(speed.value)));
  at('to-peak').addEventListener('click', () => playback.seek(replay.timeS[replay.peakFrame]));
  return () => {
    const frame = Math.round(frameAt(replay.timeS, playback.timeS));
    if (slider.value !== String(frame)) slider.value = String(frame);
    const [where, when] = [`frame ${frame} / ${last}  ·  `, `${playback.timeS.toFixed(3)} s`];
    if (label.textContent !== where + when) label.replaceChildren(element('span', where), when);
    const text = where + when;
    slider.setAttribute('aria-valuetext', text);
    play.classList.toggle('playing', playback.playing);
    play.setAttribute('aria-label', playback.playing ? 'Pause' : 'Play');
  };
}

function transportKeys(replay: Replay, playback: Playback): Key[] {
  const { timeS, peakFrame } = replay;
  const last = timeS.length - 1;
  const step = (by: number) => {
    const frame = frameAt(timeS, playback.timeS) + by;
    playback.seek(timeS[Math.min(Math.max(by > 0 ? Math.floor(frame + 1e-9) : Math.ceil(frame - 1e-9), 0), last)]);
  };
  const steps: Record<string, number> = { ArrowLeft: -1, ArrowRight: 1 };
  return [
    {
      shown: 'Space', does: 'play, pause', when: [' '],
      act: () => (playback.playing ? playback.pause() : playback.play()),
    },
    {
      shown: '← or →', does: 'a frame back, on',
      when: (event) => !event.shiftKey && event.key in steps, act: ({ key }) => step(steps[key]),
    },
    {
      shown: 'Home or End', does: 'first, last frame',
      when: ['Home', 'End'], act: ({ key }) => playback.seek(timeS[key === 'Home' ? 0 : last]),
    },
    { shown: 'p', does: 'where the driven points moved most', when: ['p'], act: () => playback.seek(timeS[peakFrame]) },
  ];
}

function start(): void {
  const replay = readReplay();
  fillPage(replay);
  const { timeS } = replay;
  const playback = new Playback(timeS[0] ?? 0, timeS[timeS.length - 1] ?? 0);
  const shown = new Shown(replay.faces.length);
  const stage = new Stage(replay, shown);
  const plots = new Plots(replay, shown, at('plots'), (t) => playback.seek(t));
  fillTables(replay, shown, at('tables'));
  const showTransport = wireTransport(replay, playback);
  const show = () => {
    stage.moveTo(frameAt(timeS, playback.timeS), playback);
    plots.mark(playback.timeS);
    showTransport();
  };
  const keys = [...transportKeys(replay, playback), ...stage.keys()];
  wireKeys(keys, at<HTMLDialogElement>('help'), at<HTMLButtonElement>('open-help'), at<HTMLInputElement>('keys-on'));
  // What stands still shows most where most has moved.
  const still = window.matchMedia('(prefers-reduced-motion: reduce)').matches;
  if (still) playback.seek(timeS[replay.peakFrame] ?? 0);
  playback.onChange(show);
  show();
  document.documentElement.dataset.ready = 'true';
  if (!still) playback.play();
}

startPage(start);
