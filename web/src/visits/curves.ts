// SPDX-License-Identifier: GPL-3.0-or-later
// The curves of all visits over each other, right and left on one scale, and which line is whose.
import { element } from '../page/dom';
import { letterOf, sideHint, sideLetter, sides, type Side } from '../page/side_words';
import { rangesOf } from './axes';
import type { Choice } from './choice';
import { fixed } from '../page/format';
import type { Manifest } from './manifest';
import { drawPanel, svg, type Line } from './panel';

/** Dash patterns of the visits between the first and the last, so that lines differ without colours. */
const dashes = ['7 3', '2 3', '8 3 2 3', '12 4'];

interface CurveStyle {
  className: string;
  style: string;
  dash: string;
}

/** The first of several visits is grey; later ones have their side's colour, the later the stronger. */
function styleOf(visit: number, count: number, side: Side, chosen: number): CurveStyle {
  if (visit === 0 && count > 1) return { className: 'line first', style: 'stroke: var(--ink-soft)', dash: '' };
  const strength = count > 2 ? Math.round(70 + (30 * (visit - 1)) / (count - 2)) : 100;
  return {
    className: visit === chosen ? 'line chosen' : 'line',
    style: `stroke: color-mix(in srgb, var(--${side}) ${strength}%, var(--card))`,
    dash: visit === count - 1 ? '' : dashes[(visit - 1) % dashes.length],
  };
}

/** A stretch of the line itself, for the key. */
function sample({ className, style, dash }: CurveStyle): SVGElement {
  const picture = svg('svg', { viewBox: '0 0 26 8', 'aria-hidden': 'true' });
  picture.append(svg('path', { d: 'M1 4H25', class: className, style, 'stroke-dasharray': dash }));
  return picture;
}

export class Curves {
  private readonly pictures = new Map<Side, SVGSVGElement>();
  private readonly key = element('ul', '', 'key');
  private readonly ranges;

  constructor(host: HTMLElement, private readonly manifest: Manifest, private readonly choice: Choice) {
    this.ranges = rangesOf(manifest.curves);
    host.append(element('h2', 'Corners of the mouth over time'));
    if (!this.ranges) {
      host.append(element('p', 'The corners of the mouth were not measured over time.'));
      return;
    }
    const panels = element('div', '', 'panels');
    panels.append(...sides.map((side) => this.panel(side)));
    host.append(this.key, panels);
    choice.onChange(() => this.draw());
    new ResizeObserver(() => this.draw()).observe(panels);
  }

  private panel(side: Side): HTMLElement {
    const figure = element('figure', '', 'panel');
    const title = element('figcaption', '', `side ${side}`);
    title.append(element('i'), sideLetter(letterOf[side]), element('span', ` · ${sideHint(letterOf[side]).toLowerCase()}`));
    const picture = svg('svg', { role: 'img', 'aria-label': this.spoken(side) });
    this.pictures.set(side, picture);
    figure.append(title, picture);
    return figure;
  }

  /** What the lines show, for screen readers. */
  private spoken(side: Side): string {
    const { visits, curves } = this.manifest;
    const most = visits.map(({ label }, i) => {
      const values = curves.filter(({ visit }) => visit === i).flatMap((curve) => curve[`${side}_mm`].filter((v) => v !== null));
      return `${label}: ${values.length > 0 ? `at most ${fixed(Math.max(...values), 1)} mm` : 'not measured'}`;
    });
    return `${sideHint(letterOf[side])}: distance of the corner of the mouth from rest (mm) over time from half way (s). ${most.join('; ')}.`;
  }

  private lines(side: Side): Line[] {
    const { visits, curves } = this.manifest;
    const several = new Set(curves.filter(({ recording }) => recording > 0).map(({ visit }) => visit));
    const order = [...curves].sort((a, b) => Number(a.visit === this.choice.visit) - Number(b.visit === this.choice.visit) || a.visit - b.visit);
    return order.map((curve) => {
      const { label, recordings } = visits[curve.visit];
      const look = styleOf(curve.visit, visits.length, side, this.choice.visit);
      return {
        ...look, className: several.has(curve.visit) ? `${look.className} one-of-several` : look.className,
        timeS: curve.time_s, valuesMm: curve[`${side}_mm`], title: `${label}: ${recordings[curve.recording] ?? ''}`,
      };
    });
  }

  draw(): void {
    const { ranges, choice, manifest } = this;
    if (!ranges) return;
    for (const [side, picture] of this.pictures) drawPanel(picture, this.lines(side), ranges);
    this.key.replaceChildren(...manifest.visits.map(({ label }, visit) => {
      const item = element('li');
      const looks = (visit === 0 && manifest.visits.length > 1 ? sides.slice(0, 1) : sides).map((side) => styleOf(visit, manifest.visits.length, side, choice.visit));
      item.append(...looks.map(sample), element('span', label));
      return item;
    }));
  }
}
