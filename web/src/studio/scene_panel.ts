// SPDX-License-Identifier: GPL-3.0-or-later
// The scene file as it would be saved, and what drives the face.
import { button, element } from '../page/dom';
import { upper } from '../page/format';
import type { StudioState } from './studio_state';
import { words } from './words';

export class ScenePanel {
  readonly element = element('div', '', 'panel scene-panel');

  constructor(state: StudioState) {
    const drive = element('p', '', 'drive');
    const text = element('pre');
    text.tabIndex = 0;
    text.setAttribute('role', 'region');
    text.setAttribute('aria-label', words.sceneText);
    text.id = 'scene-text';
    const copied = element('span', '', 'copied');
    copied.setAttribute('role', 'status');
    const copy = button(words.copy, 'quiet', () => {
      void navigator.clipboard.writeText(text.textContent ?? '').then(() => (copied.textContent = words.copied));
    });
    const head = element('div', '', 'scene-head');
    head.append(element('h2', words.sceneText), copied, copy);
    this.element.append(drive, head, text);
    state.sceneChanged.add(() => {
      const { scene } = state;
      if (!scene) return;
      drive.textContent = `${upper(scene.drive_why || words.drivenBy[scene.drive] || scene.drive)}.`.replace(/\.+$/, '.');
      text.textContent = scene.text;
      copied.textContent = '';
    });
  }
}
