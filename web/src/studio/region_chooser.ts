// SPDX-License-Identifier: GPL-3.0-or-later
// A chooser of one named part of the face, on one side or both.
import { element } from '../page/dom';
import { upper } from '../page/format';
import type { Region } from './messages';
import { words } from './words';

export function regionChooser(regions: Region[], select = element('select')): HTMLSelectElement {
  const chosen = select.value;
  select.replaceChildren();
  for (const { name, meaning } of regions)
    for (const side of ['R', 'L', ''] as const) {
      const called = upper(name.replaceAll('_', ' '));
      const option = new Option(
        side ? words.ofSide(called, words.sideNames[side]) : words.regionBoth(called), side ? `${name}_${side}` : name);
      option.title = meaning;
      select.add(option);
    }
  select.value = chosen || 'cheek_R';
  if (select.selectedIndex < 0) select.selectedIndex = 0;
  return select;
}
