// SPDX-License-Identifier: GPL-3.0-or-later
// The pictures of the steps in which skin and bones were found in a CT.
import { element } from '../page/dom';
import type { Block, Stretch } from '../page/page_data';
import type { Connection } from './connection';
import { words } from './words';

export class CtPanel {
  private readonly pictures = element('div', '', 'ct-pictures');
  private addresses: string[] = [];

  constructor(connection: Connection, private readonly into: HTMLElement) {
    into.append(element('p', words.ctSay, 'why'), this.pictures);
    connection.on('ct', ({ pictures, block }) => this.show(pictures as Record<string, Stretch>, block));
  }

  private show(pictures: Record<string, Stretch>, block: Block): void {
    for (const address of this.addresses.splice(0)) URL.revokeObjectURL(address);
    this.into.hidden = Object.keys(pictures).length === 0;
    this.pictures.replaceChildren(...Object.entries(pictures).map(([name, bytes]) => {
      const address = URL.createObjectURL(new Blob([block.uint8(bytes).slice()], { type: 'image/png' }));
      this.addresses.push(address);
      const [figure, link, picture] = [element('figure'), element('a'), element('img')];
      Object.assign(picture, { src: address, alt: words.ctPictures[name] ?? name });
      Object.assign(link, { href: address, target: '_blank' });
      link.append(picture);
      figure.append(link, element('figcaption', words.ctPictures[name] ?? name));
      return figure;
    }));
  }
}
