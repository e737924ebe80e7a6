// SPDX-License-Identifier: GPL-3.0-or-later
// The slider of a strength: a factor of the scene, shown in per cent.
import { clipped, inPercent, type Bounds } from './bounds';
import { linear, Slider, type SliderOptions } from './slider';

/** Where the slider ends is a choice of this page: more is seldom asked. Digits may say all that the scene allows. */
const usualPercent = [0, 200] as const;

export function strengthSlider(factors: Bounds, setting: Omit<SliderOptions, 'unit' | 'course' | 'round' | 'bounds'>): Slider {
  const bounds = inPercent(factors);
  return new Slider({ unit: '%', course: linear(...clipped(bounds, ...usualPercent)), round: Math.round, bounds, ...setting });
}
