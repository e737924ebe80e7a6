// SPDX-License-Identifier: GPL-3.0-or-later
// The controls of the paint panel: they show the present patch and tool, and report each action.
import { button, element } from '../page/dom';
import type { Region } from './messages';
import { depthOf, factorOf, thicknessKey, volumeOf, type Factor, type Painted, type Patch, type Row } from './patches';
import { regionChooser } from './region_chooser';
import { factorSlider, volumeSlider } from './region_sliders';
import { linear, logarithmic, Slider, threeDigits } from './slider';
import type { StudioState } from './studio_state';
import { words } from './words';

export type Tool = 'turn' | 'paint' | 'erase' | 'scar';
const tools: Tool[] = ['turn', 'paint', 'erase', 'scar'];

/** A kind of patch: a factor of the stiffness with its source. */
export interface Kind {
  name: string;
  factor: number;
  source: string;
}

/** Of a brush; hardness and strength in per cent. */
export interface Size {
  widthMm: number;
  hardness: number;
  strength: number;
}

export interface PaintActions {
  choosePainted(painted: Painted): void;
  chooseTool(tool: Tool): void;
  choosePatch(patch: number): void;
  /** `done`: the slider was released. */
  setFactor(factor: Factor, value: number, done: boolean): void;
  setVolume(ml: number, done: boolean): void;
  setDepth(mm: number, done: boolean): void;
  setSize(key: keyof Size, value: number): void;
  fill(region: string): void;
  mirror(): void;
  clear(): void;
}

/** What the controls show. */
export interface PaintShown {
  painted: Painted;
  patches: Patch[];
  chosen: number;
  /** Of the chosen patch. */
  row: Row;
  /** The chosen patch has paint. */
  there: boolean;
  canMirror: boolean;
}

export const ownDepthMm = 10;

export class PaintControls {
  readonly both = element('input');
  private readonly toolButtons = new Map<Tool, HTMLButtonElement>();
  private readonly painted = element('select');
  private readonly patch = element('select');
  private readonly kind = element('select');
  private readonly source = element('p', '', 'why');
  private readonly problem = element('p', '', 'problem');
  private readonly ofAll = element('p', words.paintThicknessOfAll, 'why');
  private readonly factors: Record<Factor, Slider>;
  private readonly volume: Slider;
  private readonly depth: Slider;
  private readonly width: Slider;
  private readonly feel: { key: 'hardness' | 'strength'; slider: Slider }[] = [];
  private readonly mirrorButton: HTMLButtonElement;
  private readonly clearButton: HTMLButtonElement;
  /** Shown for tissue only. */
  private readonly ofTissue: HTMLElement[] = [];

  /** Fills `into`. */
  constructor(into: HTMLElement, private readonly kinds: Kind[], private readonly state: StudioState, private readonly actions: PaintActions) {
    this.factors = {
      young: this.factor('young', words.paintStiffness, words.paintStiffnessHint),
      viscosity: this.factor('viscosity', words.paintViscosity, words.paintViscosityHint),
    };
    this.volume = volumeSlider(state, { live: (ml) => actions.setVolume(ml, false), done: (ml) => actions.setVolume(ml ?? 0, true) });
    this.volume.element.dataset.paint = 'volume';
    const depths = state.boundsOf(thicknessKey, 'thickness_mm');
    this.depth = new Slider({
      name: words.paintThickness, unit: 'mm', hint: words.paintThicknessHint, course: logarithmic(depths.low, depths.high), round: threeDigits, bounds: depths,
      live: (value) => actions.setDepth(value, false),
      done: (value) => actions.setDepth(value ?? ownDepthMm, true),
    });
    this.depth.element.dataset.paint = 'thickness';
    this.width = this.size('widthMm', words.paintWidth, 'mm', words.paintWidthHint, logarithmic(3, 80), threeDigits, 1, 80);
    this.mirrorButton = button(words.paintMirror, 'quiet', () => actions.mirror());
    this.clearButton = button(words.paintClear, 'quiet', () => actions.clear());
    this.problem.setAttribute('role', 'alert');
    this.problem.hidden = true;
    into.replaceChildren(
      this.paintedChoice(), this.ofAll, this.toolRow(), this.patchRow(), this.brushRow(), this.factorRow(), this.source, this.fillBox(state.regions),
      this.problem, element('p', words.paintKeys, 'why paint-keys'));
  }

  show({ painted, patches, chosen, row, there, canMirror }: PaintShown): void {
    const thickness = painted === 'thickness';
    this.painted.value = painted;
    this.patch.replaceChildren(
      ...patches.map((one, i) => new Option(
        thickness ? words.paintPatchDepth(i + 1, depthOf(one.row)) : words.paintPatchName(i + 1, factorOf(one.row, 'young'), volumeOf(one.row)), String(i))),
      new Option(words.paintNew, String(patches.length)));
    this.patch.value = String(chosen);
    const young = factorOf(row, 'young');
    const known = this.kinds.findIndex(({ factor }) => factor === young);
    this.kind.value = known < 0 ? '' : String(known);
    this.source.textContent = known < 0 ? words.paintOwnSource : this.kinds[known].source;
    this.factors.young.set(young, null);
    this.factors.viscosity.set(factorOf(row, 'viscosity'), null);
    this.volume.set(volumeOf(row), null);
    this.depth.set(depthOf(row) || ownDepthMm, null);
    for (const one of this.ofTissue) one.hidden = thickness;
    this.depth.element.hidden = this.ofAll.hidden = !thickness;
    this.both.disabled = !canMirror;
    this.mirrorButton.disabled = !there || !canMirror;
    this.clearButton.disabled = !there;
  }

  showTool(chosen: Tool): void {
    for (const [tool, made] of this.toolButtons) made.setAttribute('aria-pressed', String(tool === chosen));
  }

  showSize(size: Size): void {
    this.width.set(size.widthMm, null);
    for (const { key, slider } of this.feel) slider.set(size[key], null);
  }

  /** An empty text: none. */
  report(problem: string): void {
    this.problem.textContent = problem;
    this.problem.hidden = problem === '';
  }

  private factor(factor: Factor, name: string, hint: string): Slider {
    const slider = factorSlider(this.state, `${factor}_factor`, {
      name, hint,
      live: (value) => this.actions.setFactor(factor, value, false),
      done: (value) => this.actions.setFactor(factor, value ?? 1, true),
    });
    slider.element.dataset.paint = factor;
    return slider;
  }

  private size(
    key: keyof Size, name: string, unit: string, hint: string, course: ReturnType<typeof linear>, round: (value: number) => number, low: number, high: number,
  ): Slider {
    const slider = new Slider({
      name, unit, hint, course, round, bounds: { low, high, above: false },
      live: (value) => this.actions.setSize(key, value),
      done: (value) => {
        if (value !== null) this.actions.setSize(key, value);
      },
    });
    slider.element.dataset.paint = key === 'widthMm' ? 'width' : key;
    return slider;
  }

  private paintedChoice(): HTMLElement {
    const label = element('label', '', 'part');
    label.title = words.paintWhatHint;
    label.append(element('span', words.paintWhat), this.painted);
    this.painted.id = 'paint-what';
    this.painted.replaceChildren(new Option(words.paintWhatTissue, 'tissue'), new Option(words.paintWhatThickness, 'thickness'));
    this.painted.addEventListener('change', () => this.actions.choosePainted(this.painted.value as Painted));
    return label;
  }

  private toolRow(): HTMLElement {
    const row = element('div', '', 'paint-tools');
    const segments = element('div', '', 'segments');
    segments.setAttribute('role', 'group');
    segments.setAttribute('aria-label', words.paintTools);
    for (const tool of tools) {
      const made = button(words.paintToolNames[tool], '', () => this.actions.chooseTool(tool));
      made.title = words.paintToolHints[tool];
      made.dataset.tool = tool;
      this.toolButtons.set(tool, made);
      if (tool === 'scar') this.ofTissue.push(made);
      segments.append(made);
    }
    Object.assign(this.both, { type: 'checkbox', id: 'paint-both' });
    const label = element('label', '', 'check');
    label.title = words.paintBothHint;
    label.append(this.both, words.paintBoth);
    row.append(segments, label);
    return row;
  }

  private patchRow(): HTMLElement {
    const row = element('div', '', 'paint-patch');
    const choose = element('label', '', 'part');
    choose.append(element('span', words.paintPatch), this.patch);
    this.patch.id = 'paint-patch';
    this.patch.addEventListener('change', () => this.actions.choosePatch(Number(this.patch.value)));
    const kind = element('label', '', 'part');
    kind.append(element('span', words.paintKind), this.kind);
    this.kind.id = 'paint-kind';
    this.kind.replaceChildren(
      new Option(words.paintOwn, ''), ...this.kinds.map(({ name, factor }, i) => new Option(words.paintTimes(name, factor), String(i))));
    this.kind.addEventListener('change', () => {
      const known = this.kinds[Number(this.kind.value)];
      if (this.kind.value !== '' && known) this.actions.setFactor('young', known.factor, true);
    });
    row.append(choose, kind);
    this.ofTissue.push(kind, this.source);
    return row;
  }

  private brushRow(): HTMLElement {
    const box = element('div', '', 'paint-brush');
    for (const [key, name, hint, low, high] of [
      ['hardness', words.paintHardness, words.paintHardnessHint, 0, 95], ['strength', words.paintStrength, words.paintStrengthHint, 5, 100],
    ] as const) this.feel.push({ key, slider: this.size(key, name, '%', hint, linear(low, high), Math.round, low, high) });
    box.append(this.width.element, ...this.feel.map(({ slider }) => slider.element));
    return box;
  }

  private factorRow(): HTMLElement {
    const box = element('div', '', 'paint-brush');
    const { young, viscosity } = this.factors;
    box.append(young.element, viscosity.element, this.volume.element, this.depth.element);
    this.ofTissue.push(young.element, viscosity.element, this.volume.element);
    return box;
  }

  private fillBox(regions: Region[]): HTMLElement {
    const box = element('div', '', 'region paint-fill');
    const region = regionChooser(regions);
    region.id = 'paint-region';
    const fill = button(words.paintFill, 'quiet', () => this.actions.fill(region.value));
    fill.title = words.paintFillHint;
    const row = element('div', '', 'part');
    const label = element('label', '', 'part');
    label.append(element('span', words.regionChoose), region);
    row.append(label, fill);
    this.mirrorButton.title = words.paintMirrorHint;
    this.clearButton.title = words.paintClearHint;
    const buttons = element('div', '', 'landmark-buttons');
    buttons.append(this.mirrorButton, this.clearButton);
    box.append(row, buttons);
    return box;
  }
}
