// SPDX-License-Identifier: GPL-3.0-or-later
// The page's colours as canvases need them: resolved, light or dark.
import { colours } from './face_colour';

export const dark = window.matchMedia('(prefers-color-scheme: dark)');

/** In print the colours are the light ones, whatever the screen shows. */
let printing = false;
export function setPrinting(on: boolean): void {
  printing = on;
}

export interface Theme {
  ink: string;
  inkSoft: string;
  line: string;
  card: string;
  /** Of stretches of time that are marked. */
  shading: string;
  /** Of curves, in their order. */
  palette: string[];
}

export function theme(): Theme {
  const style = getComputedStyle(document.documentElement);
  const of = (name: string) => style.getPropertyValue(name).trim();
  return {
    ink: of('--ink'), inkSoft: of('--ink-soft'), line: of('--line'), card: of('--card'), shading: of('--shading'),
    palette: colours(dark.matches && !printing),
  };
}
