// SPDX-License-Identifier: GPL-3.0-or-later
// Sliders for one region of the face, named or painted: its added volume, and the factors that multiply its stiffness
// and viscosity (a row of tissue.region in the scene).
import { clipped } from './bounds';
import { regionKey } from './patches';
import { linear, logarithmic, Slider, threeDigits, type SliderOptions } from './slider';
import type { StudioState } from './studio_state';
import { words } from './words';

/** The sliders cover the usual range, which is a choice of this page. Typed numbers may have any value that the scene
 *  allows. */
const usualFactors = [0.1, 10] as const;
const usualMl = [-5, 10] as const;

/** Tenths, without a negative zero. */
const tenth = (ml: number): number => Math.round(10 * ml) / 10 || 0;

/** A slider for the volume that filler or an implant adds; negative: taken away. */
export function volumeSlider(state: StudioState, setting: Pick<SliderOptions, 'live' | 'done'>): Slider {
  const bounds = state.boundsOf(regionKey, 'volume_ml');
  return new Slider({
    name: words.volume, unit: 'ml', hint: words.volumeHint, course: linear(...clipped(bounds, ...usualMl)), step: 0.1, round: tenth, bounds, ...setting,
  });
}

/** A slider for a factor that multiplies stiffness or viscosity. */
export function factorSlider(
  state: StudioState, column: 'young_factor' | 'viscosity_factor', setting: Pick<SliderOptions, 'name' | 'hint' | 'live' | 'done'>,
): Slider {
  const bounds = state.boundsOf(regionKey, column);
  return new Slider({ unit: '×', course: logarithmic(...clipped(bounds, ...usualFactors)), round: threeDigits, bounds, ...setting });
}
