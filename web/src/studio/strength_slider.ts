// SPDX-License-Identifier: GPL-3.0-or-later
// A slider for the strength of muscles: a factor in the scene, shown in per cent.
import { clipped, inPercent, type Bounds } from './bounds';
import { linear, Slider, type SliderOptions } from './slider';

/** The slider covers the usual range, which is a choice of this page. Typed numbers may have any value that the scene
 *  allows. */
const usualPercent = [0, 200] as const;

export function strengthSlider(factors: Bounds, setting: Omit<SliderOptions, 'unit' | 'course' | 'round' | 'bounds'>): Slider {
  const bounds = inPercent(factors);
  return new Slider({ unit: '%', course: linear(...clipped(bounds, ...usualPercent)), round: Math.round, bounds, ...setting });
}
