// SPDX-License-Identifier: GPL-3.0-or-later
// The answer to the question: both corners of the mouth of the face that is edited, what it changes, whether the sides
// differ. All faces, and the curves, are in the panel of figures.
import { button, element } from '../page/dom';
import { sides, type Side } from '../page/side_words';
import { apartAgainstFloor, apartMm, bothRecorded, cornerChange, differenceWords, farthestMm, mm, sameMm, valueAt, type Corners } from '../replay/corners';
import { filterHz } from '../replay/curves/corner_card';
import { changeLine } from './change_line';
import type { StudioState } from './studio_state';
import { words } from './words';

export class Answer {
  private own: Corners | null = null;
  private readonly now = {} as Record<Side, HTMLElement>;
  private readonly most = {} as Record<Side, HTMLElement>;
  private readonly change = {} as Record<Side, HTMLElement>;
  private readonly box = element('div', '', 'answer-sides');
  private readonly apart = element('p', '', 'answer-apart');
  private readonly doubts: HTMLButtonElement;

  /** `showDoubts`: opens the list of doubts about the figures. */
  constructor(private readonly state: StudioState, into: HTMLElement, showDoubts: () => void) {
    this.doubts = button('', 'answer-doubts', showDoubts);
    for (const side of sides) this.box.append(this.side(side));
    into.append(this.box, this.apart);
    this.show([], 0);
  }

  private side(side: Side): HTMLElement {
    const box = element('div', '', `answer-side side-${side === 'right' ? 'R' : 'L'}`);
    box.dataset.side = side;
    const title = element('h3', words.sideNames[side === 'right' ? 'R' : 'L']);
    title.append(this.now[side] = element('small'));
    box.append(title, this.most[side] = element('b', '', 'answer-mm'), this.change[side] = element('div', '', 'answer-change'));
    return box;
  }

  /** `corners`: of all faces; `doubts`: how many there are about the figures. */
  show(corners: (Corners | null)[], doubts: number): void {
    const { edited } = this.state;
    const own = corners[edited] ?? null;
    this.own = own;
    for (const side of sides) {
      const change = edited > 0 && own ? cornerChange(this.state.source.replay, edited, side) : null;
      this.most[side].textContent = own ? mm(change?.toMm ?? farthestMm(own, side)) : '–';
      this.change[side].replaceChildren(...(change ? [changeLine(change)] : []));
    }
    this.apart.replaceChildren(...(own ? this.apartWords(own) : corners.length > 0 ? [words.noCorners] : []));
    this.doubts.textContent = words.doubtCount(doubts);
    if (doubts > 0) this.apart.append(' ', this.doubts);
  }

  private apartWords(own: Corners): (string | HTMLElement)[] {
    const { own: apart, limit } = apartAgainstFloor(own);
    if (!bothRecorded(own)) return [differenceWords(own)];
    if (own.undecided) return [words.sidesApart, ' ', element('b', apart), ' ', element('small', words.apartUndecided(limit), 'undecided')];
    if (apartMm(own) < sameMm) return [element('b', words.apartNone)];
    if (own.cannotTell) return [words.sidesApart, ' ', element('b', apart), ' ', element('small', words.apartCannotTell, 'undecided')];
    const decided = own.floorMm > 0 ? [' ', element('small', words.apartDecided(limit))] : [];
    return [words.sidesApart, ' ', element('b', apart), ...decided];
  }

  /** At the time shown; `live`: of a face whose slider is pulled. */
  mark(live: { face: number; mm: Record<Side, number> } | null): void {
    const { own, state } = this;
    const hz = own ? filterHz(state.source.replay) : 0;
    for (const side of sides) {
      const value = live?.face === state.edited ? live.mm[side] : own ? valueAt(own.timeS, own[side], state.playback.timeS) : null;
      const text = value === null ? '' : words.nowIs(mm(value), hz > 0);
      if (this.now[side].textContent === text) continue;
      this.now[side].textContent = text;
      this.now[side].title = words.nowHint(hz);
    }
  }
}
