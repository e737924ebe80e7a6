// SPDX-License-Identifier: GPL-3.0-or-later
// The colours of curves, sides and faces: those of the pictures that the program draws, which it writes into
// the page (src/hyperex/render/time_plot.hpp). After Okabe and Ito's palette, which colour-blind readers can
// distinguish; darker on light paper, lighter on dark.

export interface Palette {
  light: string[];
  dark: string[];
  /** Places of the subject's own sides in both lists. */
  left: number;
  right: number;
  /** Places of base and its variants. */
  faces: number[];
}

let palette: Palette = { light: ['#000000'], dark: ['#ffffff'], left: 0, right: 0, faces: [0] };

export const colours = (dark: boolean): string[] => (dark ? palette.dark : palette.light);

/** Places in the palettes. */
export const leftHue = (): number => palette.left;
export const rightHue = (): number => palette.right;
export const faceHue = (i: number): number => palette.faces[i % palette.faces.length];
/** Colours of curves that are neither of a side nor of a face. */
export function otherHue(i: number): number {
  const rest = palette.light.map((_, hue) => hue).filter((hue) => hue !== palette.left && hue !== palette.right);
  const round = Math.floor(i / rest.length);
  return rest[i % rest.length] + round * palette.light.length;
}

/** For style sheets: follows the page's light or dark. */
export const faceColour = (i: number): string => `var(--hue-${faceHue(i)})`;

/** Takes the palette and defines the variables that style sheets name. Printed pages are light. */
export function defineColours(given: Palette): void {
  palette = given;
  const rule = (list: string[]) =>
    `:root { ${list.map((colour, i) => `--hue-${i}: ${colour};`).join(' ')} ` +
    `--left: ${list[palette.left]}; --right: ${list[palette.right]}; }`;
  const style = document.getElementById('palette') ?? document.createElement('style');
  style.id = 'palette';
  style.textContent =
    `${rule(palette.light)} @media screen and (prefers-color-scheme: dark) { ${rule(palette.dark)} }`;
  document.head.append(style);
}
