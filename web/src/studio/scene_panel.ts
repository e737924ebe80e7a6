// SPDX-License-Identifier: GPL-3.0-or-later
// The scene file as it would be saved, and what drives the face.
import { button, element } from '../page/dom';
import { upper } from '../page/format';
import type { Edits } from './edits';
import type { Control, RemarkPanel } from './remark_places';
import type { Remark } from './remarks';
import { RigidPoints } from './rigid_points';
import type { StudioState } from './studio_state';
import { words } from './words';

export class ScenePanel implements RemarkPanel {
  readonly key = 'scene';
  /** Remarks on sections without sliders go here, too: contact, support, solver. */
  readonly sections = ['drive', ''];
  readonly element = element('div', '', 'panel scene-panel');
  private readonly driveBox = element('div');
  private readonly drive = element('p', '', 'drive');

  constructor(state: StudioState, edits: Edits) {
    const { drive, driveBox } = this;
    driveBox.append(drive);
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
    this.element.append(driveBox, new RigidPoints(state, edits).element, head, text);
    state.sceneChanged.add(() => {
      const { scene } = state;
      if (!scene) return;
      drive.textContent = `${upper(scene.drive_why || words.drivenBy[scene.drive] || scene.drive)}.`.replace(/\.+$/, '.');
      text.textContent = scene.text;
      copied.textContent = '';
    });
  }

  controlsOf({ key }: Remark): Control[] {
    return key === 'drive.by' ? [{ box: this.driveBox, inputs: [this.drive] }] : [];
  }
}
