// SPDX-License-Identifier: GPL-3.0-or-later
// Controls of the playback: play, time, speed; by mouse and by keys.
import { mm, sameMm } from './corners';
import type { Face, Replay } from './data';
import { frameAt } from './face/deform';
import { at, element } from '../page/dom';
import type { Key } from './keys';
import type { Playback } from './playback';
import type { Shown } from './shown';

/** The variant that differs most from base, among those shown or else among all; null: none differs. */
function mostDifferent({ faces }: Replay, { visible }: Shown): Face | null {
  const differing = faces.filter(({ maxDifferenceMm }) => maxDifferenceMm >= sameMm);
  const seen = differing.filter((face) => visible.includes(faces.indexOf(face)));
  const [most] = (seen.length > 0 ? seen : differing).sort((a, b) => b.maxDifferenceMm - a.maxDifferenceMm);
  return most ?? null;
}

function seekMost({ replay }: { readonly replay: Replay }, playback: Playback, shown: Shown): void {
  const most = mostDifferent(replay, shown);
  if (most) playback.seek(replay.timeS[most.maxDifferenceFrame] ?? 0);
}

/** Wires the row below the face: play, time, speed; returns what shows the time. The replay may get other frames. */
export function wireTransport(source: { readonly replay: Replay }, playback: Playback, shown: Shown): () => void {
  const slider = at<HTMLInputElement>('frame');
  const label = at<HTMLOutputElement>('frame-label');
  const play = at<HTMLButtonElement>('play');
  const speed = at<HTMLSelectElement>('speed');
  slider.addEventListener('input', () => playback.seek(source.replay.timeS[Number(slider.value)]));
  const toggle = () => (playback.playing ? playback.pause() : playback.play());
  play.addEventListener('click', toggle);
  speed.addEventListener('change', () => (playback.speed = Number(speed.value)));
  at('to-peak').addEventListener('click', () => playback.seek(source.replay.timeS[source.replay.peakFrame]));
  const toMost = at<HTMLButtonElement>('to-most');
  toMost.addEventListener('click', () => seekMost(source, playback, shown));
  return () => {
    const most = mostDifferent(source.replay, shown);
    toMost.hidden = !most;
    const hint = most ? `Where ${most.name} differs most from the unchanged face: by ${mm(most.maxDifferenceMm)}` : '';
    if (toMost.title !== hint) toMost.title = hint;
    const last = Math.max(source.replay.timeS.length - 1, 0);
    if (slider.max !== String(last)) slider.max = String(last);
    const frame = Math.round(frameAt(source.replay.timeS, playback.timeS));
    if (slider.value !== String(frame)) slider.value = String(frame);
    const [where, when] = [`frame ${frame} / ${last}  ·  `, `${playback.timeS.toFixed(3)} s`];
    if (label.textContent !== where + when) label.replaceChildren(element('span', where), when);
    const text = where + when;
    slider.setAttribute('aria-valuetext', text);
    play.classList.toggle('playing', playback.playing);
    play.setAttribute('aria-label', playback.playing ? 'Pause' : 'Play');
  };
}

export function transportKeys(source: { readonly replay: Replay }, playback: Playback, shown: Shown): Key[] {
  const step = (by: number) => {
    const { timeS } = source.replay;
    const last = timeS.length - 1;
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
      when: ['Home', 'End'], act: ({ key }) => playback.seek(source.replay.timeS[key === 'Home' ? 0 : source.replay.timeS.length - 1]),
    },
    { shown: 'd', does: 'where the variant shown differs most from the unchanged face', when: ['d'], act: () => seekMost(source, playback, shown) },
    { shown: 'p', does: 'where the driven points moved most', when: ['p'], act: () => playback.seek(source.replay.timeS[source.replay.peakFrame]) },
  ];
}
