// SPDX-License-Identifier: GPL-3.0-or-later
// Strengths of muscles by side, branch and muscle, as in the key muscles.gain. The muscle's line is highlighted on the
// face while its slider is dragged.
import { button, element } from '../page/dom';
import { upper } from '../page/format';
import { rememberFold } from '../page/remember';
import { ActivationCurves } from './activation_curves';
import type { Edits } from './edits';
import type { MuscleInfo } from './messages';
import type { Control, RemarkPanel } from './remark_places';
import { differingGains, type Remark } from './remarks';
import type { Slider } from './slider';
import { strengthSlider } from './strength_slider';
import { gainKey, type StudioState } from './studio_state';
import { words } from './words';

type Gains = Record<string, number>;
type Side = 'R' | 'L';
/** As in the view of the face: its right side is on the left. */
const sides: Side[] = ['R', 'L'];
const motionGain = 'motion.gain';

/** The controls of one name that gains may have: "side_R", "zygomatic_L", "zyg_major_R". */
interface Handle {
  /** Holds both sides of the muscle. */
  row: HTMLElement;
  slider: Slider;
  mute?: HTMLButtonElement;
  solo?: HTMLButtonElement;
}

export class MusclesPanel implements RemarkPanel {
  readonly key = 'muscles';
  readonly sections = ['muscles', 'motion'];
  readonly element = element('div', '', 'panel muscles-panel');
  readonly curves: ActivationCurves;
  private readonly handles = new Map<string, Handle>();
  private gain: Slider | null = null;
  private readonly resetAll = button(words.resetMuscles, 'quiet', () => this.set({}));
  private readonly note = element('p', '', 'why');
  /** The strength of a muted muscle, and the strengths of all muscles of a face before one of them was set to solo. */
  private readonly before = new Map<string, number>();
  private readonly beforeSolo = new Map<string, Gains>();

  /** `light`: the muscles with these names, with their sides. */
  constructor(
    private readonly state: StudioState, private readonly edits: Edits, private readonly light: (names: ReadonlySet<string>) => void,
  ) {
    this.curves = new ActivationCurves(state, this.element);
    state.sceneChanged.add(() => this.update());
    state.shown.onChange(() => this.update());
  }

  /** Once the muscles of the face are known. */
  build(): void {
    this.handles.clear();
    this.curves.clear();
    this.element.replaceChildren();
    const known = this.state.keys.get(motionGain);
    if (known) {
      this.gain = strengthSlider(this.state.boundsOf(motionGain), {
        name: words.keyNames[motionGain], hint: known.description,
        live: (value) => this.edits.live({ [motionGain]: value / 100 }),
        done: (value) => void this.edits.commit({ [motionGain]: value === null ? null : value / 100 }),
      });
      this.gain.element.dataset.key = motionGain;
      this.element.append(this.gain.element);
    }
    const { muscles } = this.state;
    this.note.textContent = words.noMuscles;
    this.note.hidden = true;
    this.element.append(this.note, this.head());
    this.element.append(this.row(words.wholeSide, 'side', muscles));
    const branches = [...new Set(muscles.map(({ branch }) => branch))];
    this.element.append(this.group(words.branches, true,
      branches.map((branch) => this.row(
        words.branchNames[branch] ?? upper(branch), branch, muscles.filter((muscle) => muscle.branch === branch)))));
    for (const name of [...new Set(muscles.map(({ group }) => group))]) {
      const own = muscles.filter(({ group }) => group === name);
      this.element.append(this.group(upper(name), false, own.map((muscle) =>
        this.row(upper(muscle.latin), muscle.name, [muscle], { mute: true }))));
    }
    this.element.append(this.resetAll);
    this.update();
    this.curves.draw();
  }

  /** Of muscles.gain: the sliders of the strengths that the face changes. */
  controlsOf({ key, variant }: Remark): Control[] {
    if (key === motionGain && this.gain) return [this.gain.control];
    if (key !== gainKey) return [];
    const face = this.state.faceCalled(variant);
    const changed = differingGains(this.state.gainsOf(face), face === 0 ? {} : this.state.gainsOf(0));
    return changed.flatMap((name) => {
      const handle = this.handles.get(name);
      return handle ? [{ box: handle.row, inputs: [handle.slider.range] }] : [];
    });
  }

  /** Brings the slider of a strength into view: "zyg_major_L". */
  reveal(gain: string): void {
    const handle = this.handles.get(gain);
    if (!handle) return;
    const group = handle.row.closest('details');
    if (group) group.open = true;
    // Within the panel: the page itself stays where it is.
    const panel = this.element.parentElement!;
    const [row, around] = [handle.row.getBoundingClientRect(), panel.getBoundingClientRect()];
    panel.scrollTop += row.top + row.height / 2 - around.top - around.height / 2;
  }

  private head(): HTMLElement {
    const head = element('div', '', 'strength-head');
    head.append(element('span', words.strengths));
    for (const side of sides) head.append(element('b', words.sideNames[side], `side-${side}`));
    return head;
  }

  private group(title: string, open: boolean, rows: HTMLElement[]): HTMLElement {
    const details = element('details', '', 'muscle-group');
    details.open = open;
    details.append(element('summary', title), ...rows);
    rememberFold(details, `muscles.${title}`);
    return details;
  }

  /** Both sides of what gains may name; `moves`: the muscles that it moves. */
  private row(title: string, name: string, moves: MuscleInfo[], { mute = false } = {}): HTMLElement {
    const row = element('div', '', 'strength');
    const groupId = `muscle-${name}`;
    row.setAttribute('role', 'group');
    row.setAttribute('aria-labelledby', groupId);
    const label = element('span', title, 'strength-name');
    label.id = groupId;
    label.title = moves.map(({ latin }) => upper(latin)).join('\n');
    const head = element('div', '', 'strength-title');
    head.append(label);
    row.append(head);
    for (const side of sides) row.append(this.side(title, `${name}_${side}`, side, moves, row, head, mute));
    return row;
  }

  /** Its slider; its switches are put into `head`. */
  private side(
    title: string, name: string, side: Side, moves: MuscleInfo[], row: HTMLElement, head: HTMLElement, mute: boolean,
  ): HTMLElement {
    const spoken = words.ofSide(title, words.sideNames[side]);
    const slider = strengthSlider(this.state.boundsOf(gainKey), {
      name: spoken, hint: spoken, bare: true,
      live: (value) => this.edits.live({ [gainKey]: this.with(name, value / 100) }),
      done: (value) => this.set(this.with(name, value === null ? 1 : value / 100)),
    });
    slider.range.dataset.gain = name;
    const handle: Handle = { row, slider };
    const box = element('div', '', `strength-side side-${side}`);
    box.append(slider.element);
    if (mute) box.append(this.curves.add(name, spoken));
    const lines = new Set(moves.map((muscle) => `${muscle.name}_${side}`));
    const lit = () => this.light(lines);
    const dark = () => {
      if (!box.contains(document.activeElement) && !box.matches(':hover')) this.light(new Set());
    };
    const toggle = (text: string, hint: string, press: () => void) => {
      const made = button(`${side} ${text}`, `small-toggle side-${side}`, press);
      made.title = hint;
      made.setAttribute('aria-label', `${side} ${text}: ${hint}`);
      made.setAttribute('aria-pressed', 'false');
      made.addEventListener('pointerenter', lit);
      made.addEventListener('pointerleave', dark);
      head.append(made);
      return made;
    };
    if (mute) handle.mute = toggle(words.mute, words.muteHint(spoken), () => this.mute(name));
    if (mute) handle.solo = toggle(words.solo, words.soloHint(spoken), () => this.solo(name));
    box.addEventListener('pointerenter', lit);
    box.addEventListener('pointerleave', dark);
    box.addEventListener('focusin', lit);
    box.addEventListener('focusout', () => requestAnimationFrame(dark));
    this.handles.set(name, handle);
    return box;
  }

  private with(name: string, gain: number): Gains {
    const next = { ...this.edits.gains, [name]: gain };
    if (gain === 1) delete next[name];
    return next;
  }

  private set(gains: Gains): void {
    void this.edits.commit({ [gainKey]: gains });
  }

  private mute(name: string): void {
    const now = this.edits.gains[name] ?? 1;
    if (now === 0) {
      this.set(this.with(name, this.before.get(name) ?? 1));
      return;
    }
    this.before.set(name, now);
    this.set(this.with(name, 0));
  }

  /** All muscles with their sides. */
  private get names(): string[] {
    return this.state.muscles.flatMap(({ name }) => sides.map((side) => `${name}_${side}`));
  }

  /** The one muscle that pulls; empty where several do. */
  private aloneIn(gains: Gains): string {
    const pulling = this.names.filter((name) => gains[name] !== 0);
    return pulling.length === 1 ? pulling[0] : '';
  }

  private solo(name: string): void {
    const { gains } = this.edits;
    const face = this.state.nameOf(this.state.edited);
    const alone = this.aloneIn(gains);
    const before = this.beforeSolo.get(face) ?? {};
    if (alone === name) {
      this.set(before);
      return;
    }
    const own = alone === '' ? gains : before;
    this.beforeSolo.set(face, own);
    const all: Gains = Object.fromEntries(this.names.filter((other) => other !== name).map((other) => [other, 0]));
    if (own[name]) all[name] = own[name];
    this.set(all);
  }

  private update(): void {
    const { state } = this;
    if (!state.scene) return;
    const { gains } = this.edits;
    const base = state.edited === 0 ? {} : state.gainsOf(0);
    const alone = this.aloneIn(gains);
    for (const [name, { slider, mute, solo }] of this.handles) {
      const value = gains[name] ?? 1;
      slider.set(100 * value, 100 * (base[name] ?? 1));
      mute?.setAttribute('aria-pressed', String(value === 0 && alone === ''));
      solo?.setAttribute('aria-pressed', String(alone === name));
    }
    const gainBefore = state.edited === 0 ? 1 : Number(state.valuesOf(0)[motionGain] ?? 1);
    this.gain?.set(100 * Number(this.edits.value(motionGain) ?? 1), 100 * gainBefore);
    this.resetAll.disabled = Object.keys(gains).length === 0;
    // It keeps its space after the first change makes muscles drive, so that nothing moves under the pointer.
    const carried = state.scene.drive !== 'muscles';
    this.note.hidden &&= !carried;
    this.note.style.visibility = carried ? '' : 'hidden';
  }
}
