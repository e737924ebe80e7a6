// SPDX-License-Identifier: GPL-3.0-or-later
// One panel of curves as SVG. It is drawn in the pixels that it has, so that its letters keep their size.
import { ticksOf, type Range } from './axes';

export interface Line {
  timeS: number[];
  valuesMm: (number | null)[];
  /** Appearance: a class in the style sheet, a style and a pattern of dashes. */
  className: string;
  style: string;
  dash: string;
  title: string;
}

export const svg = <K extends keyof SVGElementTagNameMap>(tag: K, attributes: Record<string, string | number> = {}, text = '') => {
  const made = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  made.textContent = text;
  return made;
};

interface Place {
  left: number;
  right: number;
  top: number;
  bottom: number;
  x: (timeS: number) => number;
  y: (mm: number) => number;
}

const between = ([low, high]: Range, from: number, to: number) => (value: number) => from + ((value - low) / (high - low)) * (to - from);
const rounded = (value: number) => value.toFixed(1);

function placeOf(width: number, height: number, letterPx: number, ranges: { time: Range; mm: Range }): Place {
  const [left, right, top, bottom] = [3.6 * letterPx, width - 0.9 * letterPx, 0.7 * letterPx, height - 2.9 * letterPx];
  return { left, right, top, bottom, x: between(ranges.time, left, right), y: between(ranges.mm, bottom, top) };
}

/** Where the curve is not measured it is interrupted; a single sample is a dot. */
export function pathOf({ timeS, valuesMm }: Line, { x, y }: Pick<Place, 'x' | 'y'>): string {
  let drawn = '';
  let inside = false;
  timeS.forEach((time, i) => {
    const value = valuesMm[i];
    if (value !== null) {
      const alone = !inside && (valuesMm[i + 1] ?? null) === null;
      drawn += `${inside ? 'L' : 'M'}${rounded(x(time))} ${rounded(y(value))}${alone ? 'h0.1' : ''}`;
    }
    inside = value !== null;
  });
  return drawn;
}

function axesOf(place: Place, letterPx: number, ranges: { time: Range; mm: Range }): SVGElement[] {
  const { left, right, top, bottom, x, y } = place;
  const parts: SVGElement[] = [];
  for (const { value, text } of ticksOf(ranges.mm, Math.max((bottom - top) / (1.8 * letterPx), 2))) {
    parts.push(svg('line', { class: 'grid', x1: left, x2: right, y1: y(value), y2: y(value) }));
    parts.push(svg('text', { class: 'number', x: left - 0.4 * letterPx, y: y(value) + 0.35 * letterPx, 'text-anchor': 'end' }, text));
  }
  for (const { value, text } of ticksOf(ranges.time, Math.max((right - left) / (3.8 * letterPx), 2))) {
    parts.push(svg('line', { class: 'grid', x1: x(value), x2: x(value), y1: top, y2: bottom }));
    parts.push(svg('text', { class: 'number', x: x(value), y: bottom + 1.15 * letterPx, 'text-anchor': 'middle' }, text));
  }
  if (ranges.time[0] <= 0 && ranges.time[1] >= 0)
    parts.push(svg('line', { class: 'onset', x1: x(0), x2: x(0), y1: top, y2: bottom }));
  const middle = (top + bottom) / 2;
  parts.push(
    svg('text', { class: 'axis', x: (left + right) / 2, y: bottom + 2.5 * letterPx, 'text-anchor': 'middle' }, 'time from half way (s)'),
    svg('text', { class: 'axis', x: 0, y: 0, 'text-anchor': 'middle', transform: `translate(${letterPx} ${middle}) rotate(-90)` },
      bottom - top > 11 * letterPx ? 'distance from rest (mm)' : 'from rest (mm)'),
  );
  return parts;
}

/** Fills the picture with its axes and lines; later lines lie over earlier ones. */
export function drawPanel(picture: SVGSVGElement, lines: Line[], ranges: { time: Range; mm: Range }): void {
  const { width, height } = picture.getBoundingClientRect();
  if (width === 0 || height === 0) return;
  const letterPx = Number.parseFloat(getComputedStyle(picture).fontSize);
  picture.setAttribute('viewBox', `0 0 ${rounded(width)} ${rounded(height)}`);
  const place = placeOf(width, height, letterPx, ranges);
  const paths = lines.map((line) => {
    const path = svg('path', { class: line.className, style: line.style, d: pathOf(line, place), 'stroke-dasharray': line.dash });
    path.append(svg('title', {}, line.title));
    return path;
  });
  picture.replaceChildren(...axesOf(place, letterPx, ranges), ...paths);
}
