// SPDX-License-Identifier: GPL-3.0-or-later
// A small sheet that opens below a button and closes with Escape or a press outside.
import { element } from '../page/dom';

export interface Menu {
  readonly sheet: HTMLElement;
  open(): void;
  close(): void;
}

/** `fill` makes the sheet's contents each time it opens; the first control gets the focus. */
export function menuOf(opener: HTMLElement, name: string, fill: (sheet: HTMLElement, close: () => void) => void): Menu {
  const sheet = element('div', '', 'sheet');
  sheet.popover = 'auto';
  sheet.setAttribute('role', 'dialog');
  sheet.setAttribute('aria-label', name);
  document.body.append(sheet);
  opener.setAttribute('aria-haspopup', 'dialog');
  opener.setAttribute('aria-expanded', 'false');
  const close = () => sheet.hidePopover();
  const open = () => {
    sheet.replaceChildren();
    fill(sheet, close);
    sheet.showPopover();
    const from = opener.getBoundingClientRect();
    const { offsetWidth: width, offsetHeight: height } = sheet;
    sheet.style.left = `${Math.max(Math.min(from.left, innerWidth - width - 8), 8)}px`;
    sheet.style.top = `${Math.max(Math.min(from.bottom + 6, innerHeight - height - 8), 8)}px`;
    sheet.querySelector<HTMLElement>('input, select, button')?.focus();
  };
  let closedAt = 0;
  sheet.addEventListener('toggle', (event) => {
    const isOpen = (event as ToggleEvent).newState === 'open';
    opener.setAttribute('aria-expanded', String(isOpen));
    if (!isOpen) closedAt = event.timeStamp;
  });
  opener.addEventListener('click', (event) => {
    // The press that closed it must not open it again.
    if (!sheet.matches(':popover-open') && event.timeStamp - closedAt > 200) open();
    else if (sheet.matches(':popover-open')) close();
  });
  return { sheet, open, close };
}
