// SPDX-License-Identifier: GPL-3.0-or-later
// The page while it is printed: the class `printing` on its root, light colours, and nothing folded.

/** True while the page is laid out for paper. */
export let printing = false;

/** Opens what is folded; the returned function folds it again. */
function unfold(): () => void {
  const folded = [...document.querySelectorAll<HTMLDetailsElement>('details:not([open])')];
  for (const details of folded) details.open = true;
  return () => folded.forEach((details) => (details.open = false));
}

/** `change` is called after each change to paper and back. `before`: while all still lies as on the screen. */
export function whenPrinting(change: (on: boolean) => void, before: () => void = () => {}): void {
  let fold = () => {};
  const print = (on: boolean) => {
    if (on === printing) return;
    if (on) before();
    printing = on;
    document.documentElement.classList.toggle('printing', on);
    if (on) fold = unfold();
    else fold();
    change(on);
  };
  window.addEventListener('beforeprint', () => print(true));
  window.addEventListener('afterprint', () => print(false));
  // Tools that print without these events change the medium alone.
  window.matchMedia('print').addEventListener('change', ({ matches }) => print(matches));
}
