// SPDX-License-Identifier: GPL-3.0-or-later
// A small sheet that opens below a button and closes with Escape or a press outside.
import { element } from './dom';

export interface Menu {
  readonly sheet: HTMLElement;
  open(): void;
  close(): void;
}

/** Puts the sheet below its button, or above where there is more room. */
function place(sheet: HTMLElement, opener: HTMLElement): void {
  const from = opener.getBoundingClientRect();
  const { offsetWidth: width, offsetHeight: height } = sheet;
  const below = from.bottom + 6;
  const above = from.top - 6 - height;
  const top = below + height > innerHeight - 8 && above >= 8 ? above : below;
  sheet.style.left = `${Math.max(Math.min(from.left, innerWidth - width - 8), 8)}px`;
  sheet.style.top = `${Math.max(Math.min(top, innerHeight - height - 8), 8)}px`;
}

/** Lets a button open and close a sheet that is on the page. `before` is called each time before it opens; the first
 *  control gets the focus. */
export function wireSheet(opener: HTMLElement, sheet: HTMLElement, before: () => void = () => {}, signal?: AbortSignal): Menu {
  sheet.popover = 'auto';
  opener.setAttribute('aria-haspopup', 'dialog');
  opener.setAttribute('aria-expanded', 'false');
  const close = () => sheet.hidePopover();
  const open = () => {
    before();
    sheet.showPopover();
    place(sheet, opener);
    sheet.querySelector<HTMLElement>('input, select, button, [tabindex="0"]')?.focus();
  };
  let closedAt = 0;
  sheet.addEventListener('toggle', (event) => {
    const isOpen = (event as ToggleEvent).newState === 'open';
    opener.setAttribute('aria-expanded', String(isOpen));
    if (!isOpen) closedAt = event.timeStamp;
  }, { signal });
  opener.addEventListener('click', (event) => {
    // The press that closed it must not open it again.
    if (!sheet.matches(':popover-open') && event.timeStamp - closedAt > 200) open();
    else if (sheet.matches(':popover-open')) close();
  }, { signal });
  return { sheet, open, close };
}

/** `fill` makes the sheet's contents each time it opens. */
export function menuOf(opener: HTMLElement, name: string, fill: (sheet: HTMLElement, close: () => void) => void): Menu {
  const sheet = element('div', '', 'sheet');
  sheet.setAttribute('role', 'dialog');
  sheet.setAttribute('aria-label', name);
  document.body.append(sheet);
  const menu = wireSheet(opener, sheet, () => {
    sheet.replaceChildren();
    fill(sheet, menu.close);
  });
  return menu;
}
