// SPDX-License-Identifier: GPL-3.0-or-later
// The lights of the stage. They move with the camera, so that every side of the face is lit alike.
import { Color, DirectionalLight, Group, HemisphereLight, type Object3D } from 'three';

export class StageLights {
  private readonly lights: { light: DirectionalLight; onSkin: number; onMap: number }[] = [];
  private readonly sky = new HemisphereLight('#ffffff', '#8a7f78', 1);

  constructor(camera: Object3D, scene: Object3D) {
    const rig = new Group();
    const add = (colour: string, onSkin: number, onMap: number, x: number, y: number, z: number) => {
      const light = new DirectionalLight(new Color(colour), onSkin);
      light.position.set(x, y, z);
      rig.add(light, light.target);
      this.lights.push({ light, onSkin, onMap });
    };
    add('#fff6ec', 2.0, 1.3, -0.8, 0.9, 1.0);
    add('#dfe9ff', 0.7, 0.5, 1.2, 0.1, 0.6);
    add('#ffffff', 0.6, 0.4, 0.2, 1.0, -0.9);
    camera.add(rig);
    scene.add(this.sky);
  }

  /** For colour maps, which must be readable: less shading, more ambient light. */
  light(what: 'skin' | 'map'): void {
    const map = what === 'map';
    this.sky.intensity = map ? 2.35 : 1.0;
    this.sky.groundColor.set(map ? '#cdc8c2' : '#8a7f78');
    for (const { light, onSkin, onMap } of this.lights) light.intensity = map ? onMap : onSkin;
  }
}
