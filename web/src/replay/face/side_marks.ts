// SPDX-License-Identifier: GPL-3.0-or-later
// Letters over a view that show the subject’s own sides: R and L at its edges, and in profile, where both
// lie in one place, only that of the visible side, below. The program's pictures use the same rule
// (src/hyperex/render/side_marks.cpp).
import type { PerspectiveCamera } from 'three';
import { element } from '../../page/dom';
import type { Undo } from '../../page/listeners';
import { sideHint, sideLetter, type Letter } from '../../page/side_words';

export interface SideMark {
  letter: Letter;
  /** The letter's middle, pixels of the stage. */
  x: number;
  y: number;
}

/** Share of the face's visible breadth: within 20 degrees of the profile there is no room for both. */
const leastBreadth = 0.35;
const insetPx = 16;

/** The marks of a face whose own left is the world's +x. It is drawn from `x` on over `width` pixels. */
export function sideMarks({ matrixWorld: { elements } }: PerspectiveCamera, x: number, width: number, height: number): SideMark[] {
  const [breadth, towards] = [elements[0], elements[8]];
  if (Math.abs(breadth) < leastBreadth)
    return [{ letter: towards > 0 ? 'L' : 'R', x: x + width / 2, y: height - insetPx }];
  const edge = (letter: Letter, atLeft: boolean): SideMark =>
    ({ letter, x: atLeft ? x + insetPx : x + width - insetPx, y: height / 2 });
  return [edge('R', breadth > 0), edge('L', breadth < 0)];
}

interface Marked {
  readonly sideMarks: SideMark[];
  onDraw(drawn: () => void): Undo;
}

/** Shows them over the view until the returned function is called. */
export function showSideMarks(viewer: Marked, host: HTMLElement): Undo {
  const layer = element('div', '', 'side-marks');
  layer.setAttribute('aria-hidden', 'true');
  host.append(layer);
  let shown = '';
  const unfollow = viewer.onDraw(() => {
    const marks = viewer.sideMarks;
    const now = JSON.stringify(marks);
    if (now === shown) return;
    shown = now;
    layer.replaceChildren(...marks.map(({ letter, x, y }) => {
      const mark = element('span', sideLetter(letter));
      mark.dataset.side = letter;
      mark.title = sideHint(letter);
      mark.style.translate = `calc(${x}px - 50%) calc(${y}px - 50%)`;
      return mark;
    }));
  });
  return () => {
    unfollow();
    layer.remove();
  };
}

/** Draws them into a picture. */
export function drawSideMarks(on: CanvasRenderingContext2D, marks: SideMark[], ink: string, halo: string, px = 15): void {
  on.save();
  on.font = `700 ${px}px system-ui, 'Segoe UI', 'DejaVu Sans', sans-serif`;
  [on.textAlign, on.textBaseline, on.lineJoin, on.lineWidth] = ['center', 'middle', 'round', 4];
  [on.strokeStyle, on.fillStyle] = [halo, ink];
  for (const { letter, x, y } of marks) {
    on.strokeText(sideLetter(letter), x, y);
    on.fillText(sideLetter(letter), x, y);
  }
  on.restore();
}
