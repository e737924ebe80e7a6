// SPDX-License-Identifier: GPL-3.0-or-later
// How far points on the skin are from where they began, of the faces that are shown.
import type { Chart, Curve } from '../../charts/chart_options';
import type { Replay } from '../data';
import { element, memberBox } from '../../page/dom';
import { leftHue, otherHue, rightHue } from '../../page/face_colour';
import { faceWords, landmarkName, naturally, upper } from '../../page/format';
import type { Shown } from '../shown';
import { variantsOf } from '../variants';

type Track = (number | null)[];

/** Distance of each landmark from its first sample, mm: one array a landmark, null where unknown. */
export function tracksMm(replay: Replay, face: number): Track[] {
  const { names, timeS } = replay.landmarks;
  const positions = replay.faces[face].landmarkPositions;
  const stride = 3 * names.length;
  return names.map((_, p) =>
    timeS.map((_t, f) => {
      const a = 3 * p;
      const b = f * stride + 3 * p;
      const d = Math.hypot(
        positions[b] - positions[a],
        positions[b + 1] - positions[a + 1],
        positions[b + 2] - positions[a + 2],
      );
      return Number.isFinite(d) ? 1e3 * d : null;
    }),
  );
}

/** By how much a point's track differs from the scene's own in any variant, mm. */
const spread = (own: Track, others: Track[]): number =>
  Math.max(0, ...others.flatMap((other) => other.map((v, f) => Math.abs((v ?? 0) - (own[f] ?? v ?? 0)))));

const corners: Record<string, 'L' | 'R'> = { cheilion_L: 'L', ibug68_54: 'L', cheilion_R: 'R', ibug68_48: 'R' };
/** The side whose corner of the mouth a point is: these have the colours of the sides everywhere. */
const sideOfCorner = (name: string): 'L' | 'R' | undefined => corners[name];

/** Points to show first. With variants: an input and a response point, and where they differ most, since driven points
 *  move alike in all. Else the driven points, or those that move most. */
function firstTracks(replay: Replay, of: (face: number) => Track[]): Set<number> {
  const { names } = replay.landmarks;
  const tracks = of(0);
  const variants = variantsOf(replay);
  if (variants) {
    const others = replay.faces.slice(1).map((_, i) => of(i + 1));
    const apart = tracks.map((track, p) => spread(track, others.map((other) => other[p])));
    const pair = [variants.driven_point, variants.response_point].map((name) => names.indexOf(name ?? '')).filter((i) => i >= 0);
    const order = names.map((_, i) => i).sort((a, b) => apart[b] - apart[a]);
    return new Set([...pair, ...order.slice(0, 3)]);
  }
  const driven = replay.driven.names.map((name) => names.indexOf(name)).filter((i) => i >= 0);
  if (driven.length > 0) return new Set(driven.slice(0, 7));
  const most = tracks.map((track) => Math.max(0, ...track.map((v) => v ?? 0)));
  const order = names.map((_, i) => i).sort((a, b) => most[b] - most[a]);
  return new Set(order.slice(0, 5));
}

/** The tracks of chosen points; where two faces are shown, of both. */
export class TrackCurves {
  readonly chosen: Set<number>;
  private readonly tracks = new Map<number, Track[]>();

  constructor(private readonly replay: Replay, private readonly shown: Shown) {
    this.chosen = firstTracks(replay, (face) => this.of(face));
  }

  get now(): Omit<Chart, 'title'> {
    const { faces } = this.replay;
    const [first, second] = this.shown.visible;
    const which =
      second !== undefined && second !== first
        ? ` Solid: ${faceWords(faces, first)}; dashed: ${faceWords(faces, second)}.`
        : faces.length > 1 ? ` These are the tracks of ${faceWords(faces, first)}.` : '';
    const curves = this.curvesOf(first, '', false);
    if (second !== undefined && second !== first)
      curves.push(...this.curvesOf(second, `${faceWords(faces, second)}: `, true));
    return {
      caption: `Distance of points on the skin from where they were in the first frame.${which}`,
      unit: ' mm', digits: 2, yLabel: 'distance (mm)', heightPx: 210, timeS: this.replay.landmarks.timeS, curves,
    };
  }

  private of(face: number): Track[] {
    const known = this.tracks.get(face) ?? tracksMm(this.replay, face);
    this.tracks.set(face, known);
    return known;
  }

  private curvesOf(face: number, whose: string, broken: boolean): Curve[] {
    const { faces, landmarks } = this.replay;
    const tracks = this.of(face);
    const file = faces.length > 1 ? `${faces[face].name}: ` : '';
    let others = 0;
    return [...this.chosen].map((point) => {
      const name = landmarks.names[point];
      const side = sideOfCorner(name);
      const hue = side === 'L' ? leftHue() : side === 'R' ? rightHue() : otherHue(others++);
      return { label: whose + landmarkName(name), column: `${file}${name} (mm)`, values: tracks[point], hue, broken };
    });
  }
}

/** Check boxes; `changed` is called after each change of `chosen`. */
export function trackChooser(names: string[], chosen: Set<number>, changed: () => void): HTMLElement {
  const details = element('details', '', 'chooser');
  const list = element('div');
  const order = names.map((_, i) => i).sort((a, b) => naturally(landmarkName(names[a]), landmarkName(names[b])));
  for (const i of order) {
    const label = element('label');
    label.append(memberBox(chosen, i, changed), upper(landmarkName(names[i])));
    label.title = names[i];
    list.append(label);
  }
  details.append(element('summary', `Choose points (${names.length})`), list);
  return details;
}
