// SPDX-License-Identifier: GPL-3.0-or-later
// The colours of the skin while one paints: the parameter that is painted, with its bar.
import { niceCeiling } from '../replay/face/colour';
import type { Colouring, Scale } from '../replay/face/colouring';
import type { PatchEditor } from './patch_editor';
import { parameterKeys } from './patches';
import type { StudioState } from './studio_state';
import { words } from './words';

export class PaintMap {
  /** The end of the bar. */
  private greatest = 1;

  constructor(private readonly state: StudioState, private readonly editor: PatchEditor) {}

  /** Fits the bar to the values of all faces shown, with room for a new patch. */
  rescale(): void {
    const values = new Float32Array(this.state.source.replay.points.length / 3);
    let most = 0;
    for (const face of new Set(this.state.shown.visible)) {
      this.editor.values(face, values);
      for (const value of values) most = Math.max(most, value);
    }
    this.greatest = niceCeiling(this.editor.room(most));
  }

  colouring(): Colouring {
    return {
      key: 'painted', label: words.paintMap(this.editor.painted === 'thickness' ? words.paintWhatThickness : this.scale().title),
      of: () => ({
        scale: this.scale(),
        fill: (shape, out) => {
          this.editor.values(Math.max(this.state.source.replay.faces.indexOf(shape.face), 0), out);
          for (let v = 0; v < out.length; ++v) out[v] /= this.greatest;
        },
        note: () => '',
      }),
    };
  }

  private scale(): Scale {
    const range = { least: 0, greatest: this.greatest, remark: words.paintRemark };
    if (this.editor.painted === 'thickness') return { ramp: 'sea', title: words.paintThicknessMap, unit: 'mm', ...range };
    if (this.editor.showsVolume) return { ramp: 'sea', title: words.paintVolumeMap, unit: '', ...range };
    const key = `tissue.${parameterKeys[this.editor.shownFactor]}`;
    return { ramp: 'sea', title: words.keyNames[key], unit: this.state.keys.get(key)?.unit ?? '', ...range };
  }
}
