// SPDX-License-Identifier: GPL-3.0-or-later
// The server's present work, shown over the face unless it is short.
import { element } from '../page/dom';
import { upper } from '../page/format';

const momentMs = 200;

export class Progress {
  private readonly words = element('span');
  private readonly bar = element('progress');
  private wait = 0;

  constructor(private readonly box: HTMLElement) {
    box.append(this.words, this.bar);
    this.bar.max = 1;
  }

  /** An empty stage: done. A share below 0: not known. */
  show(stage: string, share: number): void {
    if (stage === '') {
      clearTimeout(this.wait);
      this.wait = 0;
      this.box.hidden = true;
      return;
    }
    if (this.words.textContent !== upper(stage)) this.words.textContent = upper(stage);
    this.bar.setAttribute('aria-label', stage);
    if (share >= 0) this.bar.value = share;
    else this.bar.removeAttribute('value');
    this.wait ||= window.setTimeout(() => (this.box.hidden = false), momentMs);
  }
}
