// SPDX-License-Identifier: GPL-3.0-or-later
// A chooser of one named part of the face, on one side or both.
import { element } from '../page/dom';
import type { Region } from './messages';
import { words } from './words';

/** '' stands for both. */
export const sidesAndBoth = ['R', 'L', ''] as const;

export function regionChooser(regions: Region[], select = element('select')): HTMLSelectElement {
  const chosen = select.value;
  select.replaceChildren();
  for (const { name, meaning } of regions)
    for (const side of sidesAndBoth) {
      const option = new Option(words.regionName(name, side), side ? `${name}_${side}` : name);
      option.title = meaning;
      select.add(option);
    }
  select.value = chosen || 'cheek_R';
  if (select.selectedIndex < 0) select.selectedIndex = 0;
  return select;
}
