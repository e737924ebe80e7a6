// SPDX-License-Identifier: GPL-3.0-or-later
// The slider of the volume that filler or an implant adds in a part of the face or a painted patch.
import { linear, Slider, type SliderOptions } from './slider';
import { words } from './words';

/** What the digits may say, as volume_ml of tissue.region. */
const mostMl = 30;

/** Tenths, without a negative zero. */
const tenth = (ml: number): number => Math.round(10 * ml) / 10 || 0;

export const volumeSlider = (setting: Pick<SliderOptions, 'live' | 'done'>): Slider =>
  new Slider({
    name: words.volume, unit: 'ml', hint: words.volumeHint, course: linear(-5, 10), step: 0.1, round: tenth, low: -mostMl, high: mostMl, ...setting,
  });
