// SPDX-License-Identifier: GPL-3.0-or-later
// The page's colours as canvases need them: resolved, light or dark.
import { colours } from './face_colour';
import { printing } from './printing';

export const dark = window.matchMedia('(prefers-color-scheme: dark)');

export interface Theme {
  ink: string;
  inkSoft: string;
  line: string;
  card: string;
  /** Colour of marked intervals of time. */
  shading: string;
  /** Colours of curves, in their order. */
  palette: string[];
}

export function theme(): Theme {
  const style = getComputedStyle(document.documentElement);
  const of = (name: string) => style.getPropertyValue(name).trim();
  return {
    ink: of('--ink'), inkSoft: of('--ink-soft'), line: of('--line'), card: of('--card'), shading: of('--shading'),
    // Paper is light, whatever the screen shows.
    palette: colours(dark.matches && !printing),
  };
}
