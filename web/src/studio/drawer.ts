// SPDX-License-Identifier: GPL-3.0-or-later
// What is one step away: the files at the left and the panels at the right are opened and folded, as they were left.
import { at } from '../page/dom';
import { remember, remembered } from '../page/remember';

/** A button that opens and closes a part of the page. */
class Folding {
  private constructor(private readonly opener: HTMLElement, private readonly key: string, private readonly apply: (open: boolean) => void, private open: boolean) {
    opener.addEventListener('click', () => this.set(!this.open));
    this.show();
  }

  static of(opener: string, key: string, open: boolean, apply: (open: boolean) => void): Folding {
    return new Folding(at(opener), key, apply, (remembered(key) ?? String(open)) === 'true');
  }

  get isOpen(): boolean {
    return this.open;
  }

  set(open: boolean): void {
    this.open = open;
    remember(this.key, String(open));
    this.show();
  }

  private show(): void {
    this.opener.setAttribute('aria-expanded', String(this.open));
    this.apply(this.open);
  }
}

export class Drawer {
  private readonly files = Folding.of('open-files', 'files', false, (open) => {
    at('files').hidden = !open;
    // In a narrow window they lie below the face, which stays on top.
    if (open) window.scrollTo({ top: 0 });
  });

  constructor() {
    Folding.of('fold-side', 'side', true, (open) => (document.body.dataset.side = open ? 'open' : 'folded'));
    at('files').addEventListener('keydown', (event) => {
      if (event.key !== 'Escape' || event.defaultPrevented) return;
      this.files.set(false);
      at('open-files').focus();
    });
  }

  /** Something there needs to be seen. */
  openFiles(): void {
    if (!this.files.isOpen) this.files.set(true);
  }
}
