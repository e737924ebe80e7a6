// SPDX-License-Identifier: GPL-3.0-or-later
// One colour a face (or curve), the same wherever it is named. After Okabe and Ito's palette, which
// colour-blind readers can tell apart; darker on light paper, lighter on dark.

export const palettes = {
  light: ['#0072b2', '#d55e00', '#009e73', '#b0569b', '#b58900', '#2f9bd0', '#7a5230', '#666666'],
  dark: ['#56b4e9', '#ff9248', '#3ad6a4', '#e497c9', '#f0e442', '#9ecbff', '#d2a679', '#b0b0b0'],
};

/** Place in the palettes of face i. */
export const faceHue = (i: number): number => i % palettes.light.length;

/** For style sheets: follows the page's light or dark. */
export const faceColour = (i: number): string => `var(--face-${faceHue(i)})`;

/** Defines the variables that faceColour names. Printed pages are light. */
export function defineFaceColours(): void {
  const rule = (colours: string[]) =>
    `:root { ${colours.map((colour, i) => `--face-${i}: ${colour};`).join(' ')} }`;
  const style = document.createElement('style');
  style.textContent =
    `${rule(palettes.light)} @media screen and (prefers-color-scheme: dark) { ${rule(palettes.dark)} }`;
  document.head.append(style);
}
