// SPDX-License-Identifier: GPL-3.0-or-later
// What was found in a CT: its slices with the outlines of skin and bones, the pictures of each step, the value of bone.
import { button, element } from '../page/dom';
import type { Block, Stretch } from '../page/page_data';
import { Refused, type Connection } from './connection';
import { requestBounds } from './protocol';
import { words } from './words';

/** The axes of the face across which slices lie: axial, sagittal, coronal. */
const axes = [1, 0, 2];
const steps = 400;

/** An image of a PNG's bytes, with an address of its own. */
class Picture {
  readonly link = element('a');
  private readonly image = element('img');
  private address = '';

  constructor(alt: string) {
    this.image.alt = alt;
    this.link.target = '_blank';
    this.link.append(this.image);
  }

  show(bytes: Uint8Array): void {
    this.clear();
    this.address = URL.createObjectURL(new Blob([bytes.slice()], { type: 'image/png' }));
    this.image.src = this.link.href = this.address;
  }

  clear(): void {
    if (this.address) URL.revokeObjectURL(this.address);
    this.address = '';
    this.image.removeAttribute('src');
    this.link.removeAttribute('href');
  }
}

export class CtPanel {
  private readonly pictures = element('div', '', 'ct-pictures');
  private made: Picture[] = [];
  private readonly browser = element('div', '', 'ct-slices');
  private readonly slice = new Picture(words.ctSlice);
  private readonly caption = element('output');
  private readonly along = element('input');
  private axis = axes[0];
  /** Whether a slice is on its way, and whether another one is wanted since. */
  private asking = false;
  private stale = false;
  private readonly boneHu = element('input');
  private readonly findAnew = button(words.ctBonesAnew, 'quiet', () => void this.findBones());
  private readonly status = element('p', '', 'why');

  constructor(private readonly connection: Connection, private readonly into: HTMLElement) {
    this.buildBrowser();
    into.append(element('p', words.ctSay, 'why'), this.browser, this.pictures);
    connection.on('ct', ({ pictures, measured, bone_hu, block }) => {
      this.show(pictures as Record<string, Stretch>, block);
      // Of another face, perhaps.
      this.slice.clear();
      this.caption.textContent = this.status.textContent = '';
      this.browser.hidden = !measured;
      this.boneHu.value = bone_hu === undefined ? '' : String(bone_hu);
      if (measured) void this.ask();
    });
    connection.on('ct_slice', ({ caption, picture, block }) => {
      this.slice.show(block.uint8(picture));
      this.caption.textContent = caption;
    });
  }

  private buildBrowser(): void {
    const choices = element('div', '', 'segments');
    choices.setAttribute('role', 'group');
    choices.setAttribute('aria-label', words.ctSlice);
    for (const axis of axes) {
      const choose = button(words.ctAxes[axis], '', () => {
        this.axis = axis;
        for (const other of choices.querySelectorAll('button')) other.setAttribute('aria-pressed', String(other === choose));
        void this.ask();
      });
      choose.setAttribute('aria-pressed', String(axis === this.axis));
      choices.append(choose);
    }
    Object.assign(this.along, { type: 'range', min: '0', max: String(steps), step: '1', value: String(steps / 2) });
    this.along.setAttribute('aria-label', words.ctAlong);
    this.along.addEventListener('input', () => void this.ask());
    this.slice.link.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.along.value = String(Number(this.along.value) - Math.sign(event.deltaY) * 4);
      void this.ask();
    }, { passive: false });
    const figure = element('figure');
    figure.append(this.slice.link, this.caption);
    this.browser.append(choices, this.along, figure, this.boneRow(), this.status);
    this.browser.hidden = true;
    this.status.setAttribute('role', 'status');
  }

  private boneRow(): HTMLElement {
    const { least, most } = requestBounds.ct_bones.bone_hu;
    Object.assign(this.boneHu, { type: 'number', step: '10', min: String(least), max: String(most) });
    const row = element('div', '', 'part');
    const label = element('label', words.ctBone);
    this.boneHu.id = label.htmlFor = 'bone-hu';
    row.title = words.ctBoneHint;
    row.append(label, this.boneHu, this.findAnew);
    return row;
  }

  /** The slice as chosen now. While one is on its way, only the last that is asked for follows. */
  private async ask(): Promise<void> {
    this.stale = true;
    if (this.asking) return;
    this.asking = true;
    try {
      while (this.stale) {
        this.stale = false;
        await this.connection.request('ct_slice', { axis: this.axis, share: Number(this.along.value) / steps });
      }
    } catch (error) {
      this.caption.textContent = error instanceof Refused ? error.message : '';
    } finally {
      this.asking = false;
    }
  }

  private async findBones(): Promise<void> {
    const bone_hu = Number(this.boneHu.value);
    if (this.boneHu.value === '' || !Number.isFinite(bone_hu)) return;
    this.findAnew.disabled = true;
    this.status.textContent = words.ctFinding;
    try {
      await this.connection.request('ct_bones', { bone_hu });
      this.status.textContent = '';
    } catch (error) {
      this.status.textContent = error instanceof Refused ? error.message : '';
    } finally {
      this.findAnew.disabled = false;
    }
  }

  private show(pictures: Record<string, Stretch>, block: Block): void {
    for (const picture of this.made.splice(0)) picture.clear();
    this.into.hidden = Object.keys(pictures).length === 0;
    this.pictures.replaceChildren(...Object.entries(pictures).map(([name, bytes]) => {
      const text = words.ctPictures[name] ?? name;
      const picture = new Picture(text);
      this.made.push(picture);
      picture.show(block.uint8(bytes));
      const figure = element('figure');
      figure.append(picture.link, element('figcaption', text));
      return figure;
    }));
  }
}
