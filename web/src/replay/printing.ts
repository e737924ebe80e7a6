// SPDX-License-Identifier: GPL-3.0-or-later
// The report on paper: what print.css cannot do. The view in 3D becomes a picture, and curves get light colours.
import './print.css';
import type { Plots } from './curves/plots';
import type { Stage } from './face/stage';
import { whenPrinting } from '../page/printing';

/** A loose sheet must say whose it is: title and number at the foot of each. Browsers without margin boxes ignore it. */
function footRule(title: string): string {
  const text = title.replace(/[\\"]/g, '\\$&').replace(/\s+/g, ' ');
  const letters = "font: 6.5pt system-ui, 'DejaVu Sans', sans-serif; color: #444;";
  return `@page {
    @bottom-left { content: "${text}  ·  Hyperex, a research tool and no medical device"; ${letters} }
    @bottom-right { content: counter(page) " of " counter(pages); ${letters} }
  }`;
}

/** `into`: where the picture stands first. */
export function wirePrinting(stage: Stage, plots: Plots, into: HTMLElement): void {
  let draw: (() => HTMLElement) | null = null;
  let picture: HTMLElement | null = null;
  const foot = document.createElement('style');
  const before = () => {
    draw = stage.forPaper();
    foot.textContent = footRule(document.title);
    document.head.append(foot);
  };
  whenPrinting((on) => {
    picture?.remove();
    picture = on && draw ? draw() : null;
    if (picture) into.prepend(picture);
    plots.draw();
  }, before);
}
