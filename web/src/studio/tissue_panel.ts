// SPDX-License-Identifier: GPL-3.0-or-later
// Sliders of the tissue, made of the keys that the server tells.
import { element } from '../page/dom';
import type { Edits } from './edits';
import type { SceneKey } from './messages';
import { linear, logarithmic, Slider, type Course } from './slider';
import type { StudioState } from './studio_state';
import { words } from './words';

const keys = ['tissue.young_kpa', 'tissue.viscosity_pa_s', 'tissue.poisson', 'tissue.density_kg_m3'];
const thickness = 'mesh.thickness_mm';

const threeDigits = (value: number): number => Number(value.toPrecision(3));

/** A decade to either side of the default within the range where that spans decades; else the range. */
function courseOf({ low = 0, high = 1, default: given }: SceneKey): Course {
  const middle = Number(given);
  const decades = high / Math.max(low, 1e-12) > 100 && middle > 0;
  if (!decades) return linear(Math.max(low, 0), high);
  const from = Math.max(middle / 20, low > 0 ? low : 0);
  return logarithmic(from, Math.min(middle * 20, high));
}

export class TissuePanel {
  readonly element = element('div', '', 'panel tissue-panel');
  private readonly sliders = new Map<string, Slider>();
  private readonly auto = element('input');
  private readonly thicknessWhy = element('p', '', 'why');

  constructor(private readonly state: StudioState, private readonly edits: Edits) {
    state.sceneChanged.add(() => this.update());
    state.shown.onChange(() => this.update());
  }

  /** Once the keys are known. */
  build(): void {
    this.element.replaceChildren();
    this.sliders.clear();
    for (const key of keys) {
      const known = this.state.keys.get(key);
      if (known) this.add(known, courseOf(known), {});
    }
    const depth = this.state.keys.get(thickness);
    if (depth) this.addThickness(depth);
    this.update();
  }

  private add(key: SceneKey, course: Course, { still = false }): Slider {
    const slider = new Slider({
      name: words.keyNames[key.name] ?? key.name, unit: key.unit.replace('^3', '³'), hint: key.description, course,
      round: threeDigits, low: key.low ?? 0, high: key.high ?? Infinity,
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

  /** One mesh serves all faces, and takes a while: no live changes, and none of variants. */
  private addThickness(key: SceneKey): void {
    const slider = this.add(key, linear(Math.max(key.low ?? 1, 1), key.high ?? 40), { still: true });
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
    const own = state.valuesOf(edited);
    const base = state.valuesOf(0);
    for (const [key, slider] of this.sliders) {
      if (key === thickness) continue;
      const before = edited === 0 ? state.keys.get(key)?.default : base[key];
      slider.set(Number(own[key]), Number(before));
    }
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
}
