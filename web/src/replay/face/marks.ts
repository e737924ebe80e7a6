// SPDX-License-Identifier: GPL-3.0-or-later
// Points that lie on the skin at rest and may be moved; one of them is chosen.
import { Color, InstancedMesh, Matrix4, MeshBasicMaterial, SphereGeometry } from 'three';
import type { Vec3 } from '../data';

const radiusM = 0.0017;
const [colour, chosenColour] = ['#0ea5e9', '#ffd60a'];

export class Marks {
  readonly object: InstancedMesh;
  private readonly matrix = new Matrix4();

  constructor(readonly points: Vec3[]) {
    this.object = new InstancedMesh(new SphereGeometry(radiusM, 14, 10), new MeshBasicMaterial(), points.length);
    this.object.frustumCulled = false;
    points.forEach((_, i) => this.place(i));
    this.choose(-1);
  }

  /** After `points[i]` was changed. */
  place(i: number): void {
    this.object.setMatrixAt(i, this.matrix.setPosition(...this.points[i]));
    this.object.instanceMatrix.needsUpdate = true;
  }

  choose(chosen: number): void {
    this.points.forEach((_, i) => this.object.setColorAt(i, new Color(i === chosen ? chosenColour : colour)));
    if (this.object.instanceColor) this.object.instanceColor.needsUpdate = true;
  }

  dispose(): void {
    this.object.removeFromParent();
    this.object.geometry.dispose();
    (this.object.material as MeshBasicMaterial).dispose();
    this.object.dispose();
  }
}
