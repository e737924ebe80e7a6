// SPDX-License-Identifier: GPL-3.0-or-later
// The lights of the stage. They move with the camera, so that every side of the face is lit alike.
import { Color, DirectionalLight, Group, HemisphereLight, type Object3D } from 'three';

export class StageLights {
  private readonly lights: { light: DirectionalLight; onSkin: number; onMap: number }[] = [];
  private readonly sky = new HemisphereLight('#ffffff', '#a8958a', 1.1);

  constructor(camera: Object3D, scene: Object3D) {
    const rig = new Group();
    const add = (colour: string, onSkin: number, onMap: number, x: number, y: number, z: number) => {
      const light = new DirectionalLight(new Color(colour), onSkin);
      light.position.set(x, y, z);
      rig.add(light, light.target);
      this.lights.push({ light, onSkin, onMap });
    };
    // Light as for a portrait: a warm key beside and a little above the camera, a cool fill on the other side, an edge from
    // behind. A higher key would darken the sockets, and the face would look angry.
    add('#fff3e6', 2.05, 1.3, -0.75, 0.5, 1.0);
    add('#e6edff', 0.85, 0.5, 1.1, 0.15, 0.8);
    add('#ffffff', 0.9, 0.4, 0.5, 0.7, -1.0);
    camera.add(rig);
    scene.add(this.sky);
  }

  /** For colour maps, which must be readable: less shading, more ambient light. */
  light(what: 'skin' | 'map'): void {
    const map = what === 'map';
    this.sky.intensity = map ? 2.35 : 1.1;
    this.sky.groundColor.set(map ? '#cdc8c2' : '#a8958a');
    for (const { light, onSkin, onMap } of this.lights) light.intensity = map ? onMap : onSkin;
  }
}
