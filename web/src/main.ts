// SPDX-License-Identifier: GPL-3.0-or-later
// Ties the parts together: data, clock, viewer, plots, and the page's controls.
import './style.css';
import { drawColourBar, niceCeiling } from './colour';
import { readReplay, type Replay } from './data';
import { frameAt } from './deform';
import { defineFaceColours } from './face_colour';
import { number } from './format';
import { Playback } from './playback';
import { Plots } from './plots';
import { fillSummary } from './summary';
import { FaceViewer, type Colouring, type View } from './viewer';

const at = <T extends HTMLElement>(id: string): T => document.getElementById(id) as T;

/** A row of buttons of which one is pressed. */
function segments(group: HTMLElement, key: 'view' | 'colouring', chosen: (value: string) => void): void {
  const buttons = [...group.querySelectorAll('button')];
  for (const button of buttons)
    button.addEventListener('click', () => {
      for (const other of buttons) other.setAttribute('aria-pressed', String(other === button));
      chosen(button.dataset[key]!);
    });
}

function makeViewer(replay: Replay): FaceViewer | null {
  const top = niceCeiling(replay.maxDisplacementMm);
  const bar = at('colour-bar');
  let viewer: FaceViewer;
  try {
    viewer = new FaceViewer(at<HTMLCanvasElement>('face'), at('canvas-host'), replay, top);
  } catch {
    at('no-webgl').hidden = false;
    at('face').hidden = true;
    bar.hidden = true;
    return null;
  }
  drawColourBar(bar, top);
  viewer.setColouring('displacement');
  segments(at('views'), 'view', (view) => viewer.lookFrom(view as View));
  segments(at('colouring'), 'colouring', (colouring) => {
    viewer.setColouring(colouring as Colouring);
    bar.hidden = colouring !== 'displacement';
  });
  for (const overlay of viewer.overlays) {
    const label = document.createElement('label');
    const box = document.createElement('input');
    box.type = 'checkbox';
    box.dataset.overlay = overlay.name;
    box.addEventListener('change', () => viewer.showOverlay(overlay.name, box.checked));
    const swatch = document.createElement('i');
    swatch.style.background = overlay.colour;
    label.append(box, swatch, overlay.label);
    at('overlays').append(label);
  }
  return viewer;
}

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
  if (replay.notes.length > 0) {
    at('notes').hidden = false;
    for (const note of replay.notes) {
      const item = document.createElement('li');
      item.textContent = note;
      at('note-list').append(item);
    }
  }
  if (Object.keys(replay.summary).length > 0) {
    at('summary').hidden = false;
    fillSummary(replay.summary, at('summary-tables'));
  }
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
  document.addEventListener('keydown', (event) => {
    const target = event.target as HTMLElement;
    if (event.key !== ' ' || target.closest('button, select, summary, input[type=checkbox]')) return;
    event.preventDefault();
    toggle();
  });
  return () => {
    const frame = Math.round(frameAt(replay.timeS, playback.timeS));
    if (slider.value !== String(frame)) slider.value = String(frame);
    const text = `frame ${frame} / ${last}  ·  ${playback.timeS.toFixed(3)} s`;
    label.textContent = text;
    slider.setAttribute('aria-valuetext', text);
    play.classList.toggle('playing', playback.playing);
    play.setAttribute('aria-label', playback.playing ? 'Pause' : 'Play');
  };
}

function start(): void {
  const replay = readReplay();
  defineFaceColours();
  fillPage(replay);
  const { timeS } = replay;
  const playback = new Playback(timeS[0] ?? 0, timeS[timeS.length - 1] ?? 0);
  const viewer = makeViewer(replay);
  const plots = new Plots(replay, at('plots'), (t) => playback.seek(t));
  const showTransport = wireTransport(replay, playback);
  const show = () => {
    viewer?.moveTo(frameAt(timeS, playback.timeS));
    plots.mark(playback.timeS);
    showTransport();
  };
  playback.onChange(show);
  show();
  document.documentElement.dataset.ready = 'true';
  if (!window.matchMedia('(prefers-reduced-motion: reduce)').matches) playback.play();
}

try {
  start();
} catch (error) {
  at('title').textContent = error instanceof Error ? error.message : String(error);
}
