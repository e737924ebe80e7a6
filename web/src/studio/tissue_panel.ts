// SPDX-License-Identifier: GPL-3.0-or-later
// Sliders of the tissue, made from the keys that the server sends; stiffness and added volume of one part of the face.
import { element } from '../page/dom';
import { volumeSentence } from '../replay/surgery';
import { variantsOf } from '../replay/variants';
import type { Edits } from './edits';
import { isRecord, type SceneKey } from './messages';
import type { Control, RemarkPanel } from './remark_places';
import { regionChooser } from './region_chooser';
import { factorSlider, volumeSlider } from './region_sliders';
import type { Remark } from './remarks';
import { linear, logarithmic, Slider, threeDigits, type Course, type SliderOptions } from './slider';
import type { StudioState } from './studio_state';
import { words } from './words';

const keys = ['tissue.young_kpa', 'tissue.viscosity_pa_s', 'tissue.poisson', 'tissue.density_kg_m3'];
const thickness = 'mesh.thickness_mm';
const regions = 'tissue.region';
type Row = Record<string, unknown>;
/** The keys of a region that this panel sets, each with the value at which it changes nothing. */
const neutral = { young_factor: 1, volume_ml: 0 };
type PartKey = keyof typeof neutral;

/** A decade to either side of the default within the range where that spans decades; else the range. */
function courseOf({ low = 0, high = 1, default: given }: SceneKey): Course {
  const middle = Number(given);
  const decades = high / Math.max(low, 1e-12) > 100 && middle > 0;
  if (!decades) return linear(Math.max(low, 0), high);
  const from = Math.max(middle / 20, low > 0 ? low : 0);
  return logarithmic(from, Math.min(middle * 20, high));
}

export class TissuePanel implements RemarkPanel {
  readonly key = 'tissue';
  readonly sections = ['tissue', 'mesh'];
  readonly element = element('div', '', 'panel tissue-panel');
  private readonly sliders = new Map<string, Slider>();
  private readonly auto = element('input');
  private readonly thicknessWhy = element('p', '', 'why');
  private readonly part = element('select');
  private readonly ofPart = new Map<PartKey, Slider>();
  /** What added volume does to the face at rest, once it was computed. */
  private readonly added = element('p', '', 'why');

  constructor(private readonly state: StudioState, private readonly edits: Edits) {
    state.sceneChanged.add(() => this.update());
    state.shown.onChange(() => this.update());
    state.source.onChange(() => this.showAdded());
  }

  /** Once the keys are known. */
  build(): void {
    this.element.replaceChildren();
    this.sliders.clear();
    for (const key of keys) {
      const known = this.state.keys.get(key);
      if (known) this.add(known, courseOf(known), {});
      // The most used key comes first.
      if (key === keys[0] && this.state.regions.length > 0) this.addRegion();
    }
    const depth = this.state.keys.get(thickness);
    if (depth) this.addThickness(depth);
    this.update();
  }

  /** By its name in tissue.region. */
  choosePart(region: string): void {
    this.part.value = region;
    this.update();
  }

  controlsOf({ key }: Remark): Control[] {
    const slider = key === regions ? this.ofPart.get('young_factor') : this.sliders.get(key);
    return slider ? [slider.control] : [];
  }

  private add(key: SceneKey, course: Course, { still = false }): Slider {
    const slider = new Slider({
      name: words.keyNames[key.name] ?? key.name, unit: key.unit.replace('^3', '³'), hint: key.description, course,
      round: threeDigits, bounds: this.state.boundsOf(key.name),
      live: (value) => {
        if (!still) this.edits.live({ [key.name]: value });
      },
      done: (value) => void this.edits.commit({ [key.name]: value }),
    });
    slider.element.dataset.key = key.name;
    this.sliders.set(key.name, slider);
    this.element.append(slider.element);
    return slider;
  }

  /** The stiffness of a part of the face relative to the rest, and the volume added there. */
  private addRegion(): void {
    regionChooser(this.state.regions, this.part);
    this.part.onchange = () => this.update();
    const label = element('label', '', 'part');
    label.append(element('span', words.regionChoose), this.part);
    const stiffness = factorSlider(this.state, 'young_factor', { name: words.regionStiffness, hint: words.regionHint, ...this.setting('young_factor') });
    stiffness.element.dataset.key = regions;
    const volume = volumeSlider(this.state, this.setting('volume_ml'));
    volume.element.dataset.key = `${regions}.volume_ml`;
    this.ofPart.set('young_factor', stiffness).set('volume_ml', volume);
    const box = element('div', '', 'region');
    box.append(element('h2', words.regionTitle), label, stiffness.element, volume.element, this.added);
    this.element.append(box);
  }

  private setting(key: PartKey): Pick<SliderOptions, 'live' | 'done'> {
    return {
      live: (value) => this.edits.live({ [regions]: this.withValue(key, value) }),
      done: (value) => void this.edits.commit({ [regions]: this.withValue(key, value ?? this.before(key)) }),
    };
  }

  private rows(value: unknown): Row[] {
    return Array.isArray(value) ? value.filter(isRecord) : [];
  }

  /** Of the chosen part. */
  private valueIn(value: unknown, key: PartKey): number {
    return Number(this.rows(value).find((row) => row.name === this.part.value)?.[key] ?? neutral[key]);
  }

  /** What resetting goes back to. */
  private before(key: PartKey): number {
    return this.state.edited === 0 ? neutral[key] : this.valueIn(this.state.valuesOf(0)[regions], key);
  }

  /** Keeps the scene's other rows; sets the value in the row of this part, and removes the row when it is empty. */
  private withValue(key: PartKey, value: number): Row[] {
    const name = this.part.value;
    const rows = this.rows(this.edits.value(regions));
    const at = rows.findIndex((row) => row.name === name);
    const { [key]: _before, ...rest } = rows[at] ?? { name };
    const next = value === neutral[key] ? rest : { ...rest, [key]: value };
    const kept = Object.keys(next).length > 1 ? [next] : [];
    return at < 0 ? [...rows, ...kept] : [...rows.slice(0, at), ...kept, ...rows.slice(at + 1)];
  }

  /** All faces share one mesh, which takes a while: no live changes, and none in variants. */
  private addThickness(key: SceneKey): void {
    const { low, high } = this.state.boundsOf(key.name);
    const slider = this.add(key, linear(low, high), { still: true });
    const label = element('label', '', 'check');
    Object.assign(this.auto, { type: 'checkbox' });
    this.auto.addEventListener('change', () => {
      void this.edits.commit({ [key.name]: this.auto.checked ? null : Math.max(slider.current, 5) });
    });
    label.append(this.auto, words.thicknessAuto);
    slider.element.append(label);
    this.element.append(this.thicknessWhy);
  }

  private update(): void {
    const { state } = this;
    if (!state.scene) return;
    const { edited } = state;
    const base = state.valuesOf(0);
    for (const [key, slider] of this.sliders) {
      if (key === thickness) continue;
      const before = edited === 0 ? state.keys.get(key)?.default : base[key];
      slider.set(Number(this.edits.value(key)), Number(before));
    }
    for (const [key, slider] of this.ofPart) slider.set(this.valueIn(this.edits.value(regions), key), this.before(key));
    this.showAdded();
    const slider = this.sliders.get(thickness);
    if (!slider) return;
    const depth = Number(base[thickness]);
    const mine = edited === 0 && state.changeBase;
    this.auto.checked = depth === 0;
    this.auto.disabled = !mine;
    slider.set(depth === 0 ? 10 : depth, null, mine && depth !== 0);
    slider.element.classList.toggle('automatic', depth === 0);
    this.thicknessWhy.textContent = mine ? words.thicknessTakes : words.thicknessWhy;
  }

  private showAdded(): void {
    const { state } = this;
    if (!state.scene || !state.source.open) return;
    this.added.textContent = volumeSentence(variantsOf(state.source.replay)?.table.find(({ name }) => name === state.nameOf(state.edited)));
    this.added.hidden = this.added.textContent === '';
  }
}
