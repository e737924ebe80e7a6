// SPDX-License-Identifier: GPL-3.0-or-later
// "What if …": another face of base, or another change of the face shown, chosen from one list: weaker muscles by side,
// branch of the facial nerve or name, presets with their sources, moved bones, filler, a copy.
import { at } from '../page/dom';
import { upper } from '../page/format';
import { menuOf, type Menu } from '../page/menu';
import { volumeWords } from '../replay/surgery';
import { boneKey, boneParts, moveOf, movesOf, withMove } from './bone_moves';
import { inPercent } from './bounds';
import { briefName } from './brief_name';
import { fillChooser, type Amount, type Choice } from './chooser';
import type { Edits } from './edits';
import { isRecord, type Preset, type Values } from './messages';
import { nameOfRegion, sidesAndBoth } from './region_chooser';
import { gainKey, type StudioState } from './studio_state';
import { tryChange } from './try_change';
import { words } from './words';

const regionKey = 'tissue.region';
/** What a choice sets where no number is typed: a weakened muscle, a moved bone, a syringe of filler. */
const usual = { percent: 50, mm: 6, ml: 1 };
type Take = (gain: string, percent: number) => void;

export class WhatIf {
  presets: Preset[] = [];
  readonly menu: Menu;

  /** `showBones` and `showTissue` open these panels, the latter at a part of the face. `strengthChanged` is called with the name of a muscle, branch or side after a variant with another strength of it was added. */
  constructor(private readonly state: StudioState, private readonly edits: Edits, private readonly strengthChanged: (gain: string) => void,
    private readonly showBones: () => void, private readonly showTissue: (region: string) => void,
  ) {
    this.menu = menuOf(at('what-if'), words.whatIf, (sheet, close) => {
      const [sides, ...muscles] = this.strengths((gain, percent) => tryChange(() => this.addWeaker(gain, percent)));
      fillChooser(sheet, [...sides, ...this.presetChoices(), ...this.boneChoices(), ...this.volumeChoices(), ...muscles.flat(), this.copy()], close);
    });
  }

  /** Fills a sheet with what else the face shown may change; `instead`: in the place of that strength. */
  fillChange(sheet: HTMLElement, close: () => void, instead: string | null): void {
    const { gains } = this.edits;
    const present = instead ? Math.round(100 * (gains[instead] ?? 1)) : usual.percent;
    const take: Take = (gain, percent) => {
      const { [instead ?? '']: _before, ...kept } = this.edits.gains;
      void this.edits.commit({ [gainKey]: { ...kept, [gain]: percent / 100 } });
    };
    fillChooser(sheet, this.strengths(take, present).flat(), close);
  }

  /** Moves the keyboard focus to a face's tab. */
  private focus(face: number): void {
    at('tabs').querySelector<HTMLElement>(`.tab-name[data-face="${face}"]`)?.focus();
  }

  private async addWeaker(gain: string, percent: number): Promise<void> {
    const values = this.state.valuesOf(0);
    const changes = { [gainKey]: { ...this.state.gainsOf(0), [gain]: Number((percent / 100).toFixed(3)) } };
    const face = await this.edits.addFace(briefName(changes, values, this.state.muscles) || words.newVariant, 0);
    this.focus(face);
    await this.edits.change(face, changes);
    this.strengthChanged(gain);
  }

  /** What muscles.gain may name: sides with branches, and single muscles. */
  private strengths(take: Take, percent = usual.percent): Choice[][] {
    const { muscles } = this.state;
    const amount: Amount = { unit: '%', usual: percent, bounds: inPercent(this.state.boundsOf(gainKey)) };
    const both = (group: string, stem: string, called: (side: string) => string): Choice[] =>
      (['R', 'L'] as const).map((side) => ({
        group, value: `${stem}_${side}`, text: upper(called(words.sideNames[side])), detail: words.atPercent, amount,
        take: (chosen) => take(`${stem}_${side}`, chosen),
      }));
    const branches = [...new Set(muscles.map(({ branch }) => branch))].flatMap((branch) => {
      const brief = words.branchNames[branch] ?? upper(branch);
      return both(words.branches, branch, (side) => words.ofSide(words.weakerBranch(brief), side));
    });
    return [
      [...both(words.wholeSide, 'side', words.weakerSide), ...branches],
      muscles.flatMap(({ name, latin }) => both(words.weakerMuscles, name, (side) => words.ofSide(latin, side))),
    ];
  }

  /** Each makes a variant of base: together with other changes, of muscles for example, a preset's values would not be
   *  valid. */
  private presetChoices(): Choice[] {
    return this.presets.map(({ name, summary, source, assumed }) => {
      const stem = name.replace(/_[LR]$/, '');
      const plain = stem.replaceAll('_', ' ');
      const called = name === stem ? plain : words.ofSide(plain, words.sideNames[name.slice(-1) as 'L' | 'R']);
      return {
        group: words.presetsTitle, value: name, text: upper(called), detail: summary, says: words.presetSource(source, assumed),
        take: () => tryChange(async () => this.focus(await this.edits.addFace(called, 0, name))),
      };
    });
  }

  private boneChoices(): Choice[] {
    const inBase = movesOf(this.state.valuesOf(0)[boneKey]);
    const amount: Amount = { unit: 'mm', usual: usual.mm, bounds: this.state.boundsOf(boneKey, 'move_mm') };
    return boneParts.map((part) => ({
      group: words.boneGroup, value: `bone ${part}`, text: words.boneParts[part], detail: words.boneAmount, amount,
      take: (mm) => tryChange(() => this.addSurgery({ [boneKey]: withMove(inBase, { ...moveOf([], part), move_mm: [0, 0, mm] }) }, this.showBones)),
    }));
  }

  private volumeChoices(): Choice[] {
    const inBase = this.state.valuesOf(0)[regionKey];
    const amount: Amount = { unit: 'ml', usual: usual.ml, bounds: this.state.boundsOf(regionKey, 'volume_ml') };
    const before = Array.isArray(inBase) ? inBase.filter(isRecord) : [];
    return this.state.regions.flatMap(({ name }) => sidesAndBoth.map((side) => {
      const region = side ? `${name}_${side}` : name;
      const others = before.filter((row) => row.name !== region);
      const own = before.find((row) => row.name === region) ?? { name: region };
      return {
        group: words.volumeGroup, value: `volume ${region}`, text: nameOfRegion(name, side), detail: volumeWords, amount,
        take: (ml: number) => tryChange(() => this.addSurgery({ [regionKey]: [...others, { ...own, volume_ml: ml }] }, () => this.showTissue(region))),
      };
    }));
  }

  /** Adds a face with these changes and calls `show`, which opens the panel where the user can edit them. If the server
   *  refuses the changes, the face is removed again. */
  private async addSurgery(changes: Values, show: () => void): Promise<void> {
    const face = await this.edits.addFace(briefName(changes, this.state.valuesOf(0), this.state.muscles) || words.newVariant, 0);
    this.focus(face);
    show();
    try {
      await this.edits.change(face, changes);
    } catch (error) {
      await this.edits.removeFace(face);
      throw error;
    }
  }

  private copy(): Choice {
    return {
      group: words.emptyTitle, value: 'copy', text: words.emptyAdd, detail: '',
      take: () => tryChange(async () => this.focus(await this.edits.addFace(words.newVariant, this.state.edited))),
    };
  }
}
