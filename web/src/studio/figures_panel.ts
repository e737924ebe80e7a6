// SPDX-License-Identifier: GPL-3.0-or-later
// How far both corners of the mouth move, now and at most, in each face, and the change against base; the curves.
import type { Chart } from '../charts/chart_options';
import { TimeChart } from '../charts/time_chart';
import { button, element } from '../page/dom';
import { faceColour } from '../page/face_colour';
import { sides, type Side } from '../page/side_words';
import { apartAgainstFloor, changeBandMm, cornerChange, cornersOf, farthestMm, jitterUnknown, mm, sameMm, valueAt, type Corners } from '../replay/corners';
import { cornerCurves, filterHz } from '../replay/curves/corner_card';
import { symmetryCurves } from '../replay/curves/symmetry_charts';
import { disagreement, plainFigures } from '../replay/curves/symmetry_words';
import { chooseFace } from '../replay/face/face_chooser';
import { nearestVertex } from '../replay/face/deform';
import { placeWords } from '../replay/farthest';
import { headUncertainty, headWords } from '../replay/head_pose';
import { isNumber } from '../replay/tables/figure_table';
import { variantsOf } from '../replay/variants';
import { dark } from '../page/theme';
import type { Answer } from './answer';
import { changeLine } from './change_line';
import { remarksOf, sentenceOf } from './remarks';
import type { StudioState } from './studio_state';
import { words } from './words';

/** Remarks on the inputs of the figures. */
const restOn = /^(landmarks|recording|sides|skin|head|symmetry|forces)\./;

export class FiguresPanel {
  private readonly table = element('table', '', 'corner-table');
  private readonly remark = element('p', '', 'remark');
  private readonly doubts = element('ul', '', 'doubts');
  private readonly charts = element('div', '', 'charts');
  private plots: { chart: TimeChart; made: () => Omit<Chart, 'title'>[] }[] = [];
  private corners: (Corners | null)[] = [];
  private now: { cells: Record<Side, HTMLElement>; corners: Corners; face: number }[] = [];
  private live: { face: number; mm: Record<Side, number> } | null = null;
  private cornerVertex: Record<Side, number> | null = null;

  constructor(private readonly state: StudioState, into: HTMLElement, private readonly answer: Answer) {
    this.doubts.setAttribute('aria-label', words.doubts);
    into.append(this.table, this.remark, this.doubts, this.charts);
    state.shown.onChange(() => this.change());
    dark.addEventListener('change', () => this.plots.forEach(({ chart }) => chart.draw()));
  }

  /** Before another face. */
  clear(): void {
    for (const { chart } of this.plots.splice(0)) chart.remove();
    this.cornerVertex = null;
    this.corners = [];
    this.now = [];
  }

  /** Called for a new face: makes the charts again. */
  build(): void {
    this.clear();
    this.refresh();
    const { state } = this;
    const { replay } = state.source;
    const add = (title: string, heightPx: number, made: () => Omit<Chart, 'title'>[], caption = () => '') => {
      const compact = () => made().map((chart) => ({ ...chart, caption: caption(), heightPx }));
      const [first] = compact();
      if (!first) return;
      const card = element('article', '', 'plot-card');
      this.charts.append(card);
      this.plots.push({ chart: new TimeChart(card, { ...first, title }, (t) => state.playback.seek(t)), made: compact });
    };
    add(words.corners, 130, () => cornerCurves(replay, state.shown));
    add(words.symmetry, 140, () => symmetryCurves(replay, state.shown),
      () => [plainFigures(replay, state.shown), disagreement(replay, state.shown)].filter(Boolean).join(' '));
  }

  /** Called after a new motion. */
  refresh(): void {
    const { replay } = this.state.source;
    this.live = null;
    this.corners = replay.faces.map((_, i) => cornersOf(replay, i));
    this.fill();
    this.tellDoubts();
    this.change();
  }

  /** At the time shown. */
  mark(): void {
    const { timeS } = this.state.playback;
    this.answer.mark(this.live);
    for (const { chart } of this.plots) chart.mark(timeS);
    const hz = filterHz(this.state.source.replay);
    for (const { cells, corners, face } of this.now)
      for (const side of sides) {
        const value = this.live?.face === face ? this.live.mm[side] : valueAt(corners.timeS, corners[side], timeS);
        const text = value === null ? '' : words.nowIs(mm(value), hz > 0);
        if (cells[side].textContent === text) continue;
        cells[side].textContent = text;
        cells[side].title = words.nowHint(hz);
      }
  }

  /** A face's shape while a slider is pulled: displacements in metres; null: none any more. */
  showLive(face: number, displacement: Float32Array | null): void {
    this.live = null;
    const at = displacement && (this.cornerVertex ??= this.findCorners());
    if (displacement && at) {
      const length = (v: number) => 1e3 * Math.hypot(...displacement.subarray(3 * v, 3 * v + 3));
      this.live = { face, mm: { left: length(at.left), right: length(at.right) } };
    }
    this.mark();
  }

  private findCorners(): Record<Side, number> | null {
    const { points, landmarks } = this.state.source.replay;
    const vertex = (...names: string[]): number => {
      const i = landmarks.names.findIndex((name) => names.includes(name));
      return i < 0 ? -1 : nearestVertex(points, landmarks.positions.subarray(3 * i, 3 * i + 3)).vertex;
    };
    const found = { left: vertex('cheilion_L', 'ibug68_54'), right: vertex('cheilion_R', 'ibug68_48') };
    return found.left >= 0 && found.right >= 0 ? found : null;
  }

  private change(): void {
    const edited = this.state.edited;
    for (const row of this.table.querySelectorAll<HTMLElement>('tbody tr')) row.classList.toggle('shown', Number(row.dataset.face) === edited);
    for (const { chart, made } of this.plots) {
      const [next] = made();
      if (next) chart.change(next);
    }
    this.tellRemark();
    this.answer.show(this.corners, this.doubts.children.length);
    this.mark();
  }

  private fill(): void {
    const { table, corners } = this;
    const [base] = corners;
    table.replaceChildren();
    this.now = [];
    if (!base) return;
    table.createCaption().textContent = words.cornersTitle;
    const head = table.createTHead().insertRow();
    const heads = [words.face, words.sideNames.R, words.sideNames.L].map((text, i) => {
      const cell = element('th', text, ['', 'right', 'left'][i]);
      cell.scope = 'col';
      return cell;
    });
    head.append(...heads);
    const body = table.createTBody();
    this.state.source.replay.faces.forEach(({ name }, i) => {
      const own = corners[i];
      if (!own) return;
      const row = body.insertRow();
      row.dataset.face = String(i);
      row.style.setProperty('--face', faceColour(i));
      const title = element('th');
      title.scope = 'row';
      const choose = element('button', '', 'face-name');
      choose.type = 'button';
      choose.append(element('i'), i === 0 ? words.base : name);
      choose.addEventListener('click', () => chooseFace(this.state.shown, i));
      title.append(choose);
      row.append(title);
      const cells = {} as Record<Side, HTMLElement>;
      for (const side of sides) cells[side] = this.cell(row, own, side, i);
      this.now.push({ cells, corners: own, face: i });
      const differs = this.differsMost(i);
      if (!differs) return;
      const below = body.insertRow();
      below.className = 'differs';
      below.dataset.face = String(i);
      below.style.setProperty('--face', faceColour(i));
      const cell = below.insertCell();
      cell.colSpan = 3;
      const seek = button(differs, 'seek-most', () => {
        const { replay } = this.state.source;
        this.state.playback.seek(replay.timeS[replay.faces[i].maxDifferenceFrame] ?? 0);
      });
      seek.title = words.mostHint;
      cell.append(seek);
    });
    if (this.state.source.replay.faces.length > 1 && !this.bandsKnown()) {
      const note = table.createTFoot().insertRow().insertCell();
      note.colSpan = 3;
      note.className = 'no-band';
      note.textContent = words.noBand;
    }
  }

  /** The largest distance in large type, its change against base, and the distance now. */
  private cell(row: HTMLTableRowElement, own: Corners, side: Side, i: number): HTMLElement {
    const cell = row.insertCell();
    const change = i > 0 ? cornerChange(this.state.source.replay, i, side) : null;
    const most = farthestMm(own, side);
    cell.append(element('b', mm(change?.toMm ?? most)));
    cell.dataset.side = side;
    cell.dataset.mm = String(most);
    if (change) cell.append(changeLine(change));
    const now = element('small', '', 'now-is');
    cell.append(now);
    return now;
  }

  private bandsKnown(): boolean {
    const { replay } = this.state.source;
    return replay.faces.every((_, i) => i === 0 || jitterUnknown(replay, i) || changeBandMm(replay, i, 'left') !== null);
  }

  private differsMost(i: number): string {
    const { replay } = this.state.source;
    const most = replay.faces[i].maxDifferenceMm;
    if (i === 0 || !(most >= sameMm)) return '';
    const place = placeWords(replay, i, variantsOf(replay)?.table.find(({ name }) => name === replay.faces[i].name));
    const when = words.atTime((replay.timeS[replay.faces[i].maxDifferenceFrame] ?? 0).toFixed(3));
    return words.most(mm(most), place, when);
  }

  /** Remarks on the inputs of the figures: scan, landmarks, recording, the head's pose. */
  private tellDoubts(): void {
    const { replay } = this.state.source;
    const { summary } = replay;
    const pose = headUncertainty(replay);
    const head = pose ? [headWords(pose)] : [];
    const inputs = remarksOf(summary).filter(({ severity, variant, id }) => severity === 'warning' && variant === '' && restOn.test(id));
    this.doubts.replaceChildren(...[...inputs.map((remark) => sentenceOf(remark, words.remarks)), ...head].map((text) => element('li', text)));
    this.doubts.hidden = this.doubts.children.length === 0;
  }

  private tellRemark(): void {
    const own = this.corners[this.state.edited];
    if (!this.corners[0]) this.remark.textContent = words.noCorners;
    else if (own?.undecided && isNumber(own.floorMm) && own.floorMm > 0) {
      const { own: apart, limit } = apartAgainstFloor(own);
      this.remark.textContent = words.undecided(apart, limit);
    } else this.remark.textContent = '';
    this.remark.hidden = this.remark.textContent === '';
  }
}
