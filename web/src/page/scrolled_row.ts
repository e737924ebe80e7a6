// SPDX-License-Identifier: GPL-3.0-or-later
// A row that is scrolled where it has no room: an arrow at each edge behind which it goes on.

/** Sets `data-more` of the row to the sides on which something of it is out of sight: "left", "right", both or none. */
export function markWhatGoesOn(row: HTMLElement): void {
  row.classList.add('goes-on');
  const tell = () => {
    const { scrollLeft, clientWidth, scrollWidth } = row;
    const more = [scrollLeft > 1 ? 'left' : '', scrollLeft + clientWidth < scrollWidth - 1 ? 'right' : ''].filter(Boolean).join(' ');
    if (row.dataset.more !== more) row.dataset.more = more;
  };
  row.addEventListener('scroll', tell, { passive: true });
  new ResizeObserver(tell).observe(row);
  new MutationObserver(tell).observe(row, { childList: true, subtree: true, characterData: true });
  tell();
}
