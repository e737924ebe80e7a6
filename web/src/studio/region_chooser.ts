// SPDX-License-Identifier: GPL-3.0-or-later
// A chooser of one named part of the face, on one side or both.
import { element } from '../page/dom';
import { upper } from '../page/format';
import type { Region } from './messages';
import { words } from './words';

/** The sides on which a part of the face may be chosen: right, left, or (the empty text) both. */
export const sidesAndBoth = ['R', 'L', ''] as const;

/** "Cheek, right", "Lips, both sides". */
export function nameOfRegion(region: string, side: (typeof sidesAndBoth)[number]): string {
  const called = upper(region.replaceAll('_', ' '));
  return side ? words.ofSide(called, words.sideNames[side]) : words.regionBoth(called);
}

export function regionChooser(regions: Region[], select = element('select')): HTMLSelectElement {
  const chosen = select.value;
  select.replaceChildren();
  for (const { name, meaning } of regions)
    for (const side of sidesAndBoth) {
      const option = new Option(nameOfRegion(name, side), side ? `${name}_${side}` : name);
      option.title = meaning;
      select.add(option);
    }
  select.value = chosen || 'cheek_R';
  if (select.selectedIndex < 0) select.selectedIndex = 0;
  return select;
}
