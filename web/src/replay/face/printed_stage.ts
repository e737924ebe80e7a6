// SPDX-License-Identifier: GPL-3.0-or-later
// The stage on paper: the picture of the faces, below it in words what it shows, and the bar of its colours.
import { drawColourBar } from './colour_bar';
import { drawStageAlone, type PictureParts } from './picture';
import { element } from '../../page/dom';

/** Height of the sides' letters as a share of the picture's breadth: some 3 mm on half a sheet. */
const letterShare = 1 / 32;

export function printedStage(parts: PictureParts): HTMLElement {
  const { faces, time, colours, cautions } = parts;
  const figure = element('figure', '', 'printed-stage');
  const canvas = drawStageAlone(parts, Math.round(letterShare * parts.stage.width / parts.scale));
  canvas.setAttribute('role', 'img');
  canvas.setAttribute('aria-label', 'The face as it stands on the screen');
  const words = element('figcaption');
  const names = faces.map(({ name, colour }, i) => {
    const line = element('span', '', 'name');
    const dot = element('i');
    dot.style.background = colour;
    const place = faces.length > 1 ? ['left picture: ', 'right picture: '][i] : '';
    line.append(dot, element('b', `${place}${name}`));
    return line;
  });
  words.append(...names, element('span', `at ${time}`), element('span', 'R and L: the person’s own right and left'));
  figure.append(canvas, words);
  if (colours) {
    const bar = element('figure', '', 'colour-bar');
    drawColourBar(bar, colours);
    figure.append(bar);
  }
  figure.append(...cautions.map((text) => element('p', text)));
  return figure;
}
