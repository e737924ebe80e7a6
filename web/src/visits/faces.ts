// SPDX-License-Identifier: GPL-3.0-or-later
// The faces at the peak, side by side. Where they have no room they are scrolled past the first, which stays.
import { element } from '../page/dom';
import { printedVisits, type Choice } from './choice';
import type { Manifest, Visit } from './manifest';

function faceOf({ label, note, picture, no_picture }: Visit, expression: string): HTMLElement {
  const figure = element('figure', '', 'face');
  if (picture) {
    const image = element('img');
    image.src = picture;
    image.alt = `The face at the peak of the ${expression}, ${label}`;
    figure.append(image);
  } else figure.append(element('p', no_picture ? `No picture: ${no_picture}` : 'No picture', 'no-picture'));
  const caption = element('figcaption');
  caption.append(element('b', label));
  if (note) caption.append(element('span', note));
  figure.append(caption);
  return figure;
}

export class Faces {
  private readonly faces: HTMLElement[];
  private readonly row = element('div', '', 'face-row');

  constructor(host: HTMLElement, { visits, expression }: Manifest, private readonly choice: Choice) {
    this.faces = visits.map((visit) => faceOf(visit, expression));
    this.row.append(...this.faces);
    this.row.setAttribute('role', 'group');
    this.row.setAttribute('aria-label', 'Faces at the peak, in the order of the visits');
    const title = element('h2', `At the peak of the ${expression} `);
    title.append(element('small', 'The average face, moved as the recorded points are. It is not this person’s face.'));
    host.append(title, this.row);
    choice.onChange(() => this.show());
    // Only what is scrolled is reached by the keyboard.
    new ResizeObserver(() => {
      const scrolled = this.row.scrollWidth > this.row.clientWidth + 1;
      if (scrolled) this.row.tabIndex = 0;
      else this.row.removeAttribute('tabindex');
    }).observe(this.row);
  }

  /** Marks the visit that is compared and brings its face beside the first. */
  show(): void {
    const printed = printedVisits(this.faces.length, this.choice.visit);
    this.faces.forEach((face, visit) => {
      face.classList.toggle('not-printed', !printed.includes(visit));
      face.classList.toggle('chosen', visit > 0 && visit === this.choice.visit && this.faces.length > 2);
    });
    const [first, chosen] = [this.faces[0], this.faces[this.choice.visit]];
    if (!first || !chosen) return;
    this.row.scrollLeft = chosen.offsetLeft - this.row.offsetLeft - first.offsetWidth - 12;
  }
}
