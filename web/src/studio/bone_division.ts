// SPDX-License-Identifier: GPL-3.0-or-later
// Two clicks on the bones of a CT, on the skull and on the mandible, by which the program divides them anew.
import { at } from '../page/dom';
import { Undoing } from '../page/listeners';
import type { Vec3 } from '../replay/data';
import type { FaceViewer } from '../replay/face/viewer';
import type { BoneView } from './bone_view';

export class BoneDivision {
  private readonly undoing = new Undoing();
  private skull: Vec3 | null = null;

  /** `picked`: called after the first click, and with both places after the second; `ended`: by Escape. */
  constructor(viewer: FaceViewer, view: BoneView, picked: (skull: Vec3, mandible: Vec3 | null) => void, ended: () => void) {
    const canvas = at('face');
    const first = { signal: this.undoing.signal, capture: true };
    canvas.style.cursor = 'crosshair';
    this.undoing.add(() => (canvas.style.cursor = ''));
    let down: { x: number; y: number } | null = null;
    canvas.addEventListener('pointerdown', ({ clientX: x, clientY: y }) => (down = { x, y }), first);
    canvas.addEventListener('pointerup', ({ clientX, clientY }) => {
      // A drag turns the face.
      if (!down || Math.hypot(clientX - down.x, clientY - down.y) > 4) return;
      const place = view.placeOn(viewer.pick.rayOnLast(clientX, clientY));
      if (!place) return;
      if (this.skull) picked(this.skull, place);
      else picked((this.skull = place), null);
    }, first);
    document.addEventListener('keydown', (event) => {
      if (event.key !== 'Escape') return;
      event.stopPropagation();
      ended();
    }, first);
  }

  dispose(): void {
    this.undoing.undo();
  }
}
