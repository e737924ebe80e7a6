// SPDX-License-Identifier: GPL-3.0-or-later
// What a reader has folded, opened and chosen, kept until the tab is closed. A page from a disk may keep nothing.

const prefix = 'hyperex.';

export function remembered(key: string): string | null {
  try {
    return sessionStorage.getItem(prefix + key);
  } catch {
    return null;
  }
}

export function remember(key: string, value: string): void {
  try {
    sessionStorage.setItem(prefix + key, value);
  } catch {
    // The page works without.
  }
}

/** Opens what folds as it was left, and remembers it from now on. */
export function rememberFold(details: HTMLDetailsElement, key: string): void {
  const before = remembered(key);
  if (before !== null) details.open = before === 'open';
  details.addEventListener('toggle', () => remember(key, details.open ? 'open' : 'closed'));
}
