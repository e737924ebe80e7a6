// SPDX-License-Identifier: GPL-3.0-or-later
// Teeth and gums behind the lips: the upper ones do not move, the lower ones move with the jaw.
import { BufferAttribute, BufferGeometry, Group, Mesh, MeshStandardMaterial, Quaternion, Vector3 } from 'three';
import type { Face, Replay } from '../data';

const materials = {
  crowns: new MeshStandardMaterial({ color: '#ebe1ca', roughness: 0.35, vertexColors: true }),
  gum: new MeshStandardMaterial({ color: '#b85c5c', roughness: 0.5, vertexColors: true }),
};

function meshOf({ part, points, triangles, light }: Replay['teeth'][number]): Mesh {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(points, 3));
  const shade = Float32Array.from(points, (_, i) => light[Math.floor(i / 3)] / 255);
  geometry.setAttribute('color', new BufferAttribute(shade, 3));
  geometry.setIndex(new BufferAttribute(triangles, 1));
  geometry.computeVertexNormals();
  const mesh = new Mesh(geometry, materials[part]);
  mesh.frustumCulled = false;
  return mesh;
}

export class Teeth {
  readonly object = new Group();
  private readonly lower = new Group();
  private readonly after = { turn: new Quaternion(), shift: new Vector3() };

  constructor(replay: Replay) {
    this.object.add(this.lower);
    for (const row of replay.teeth) (row.jaw === 'lower' ? this.lower : this.object).add(meshOf(row));
  }

  /** `frame`: may be fractional; interpolated as in the animated glTF. */
  moveTo(face: Face, frame: number): void {
    const { jaw } = face;
    if (!jaw) return;
    const first = Math.floor(frame);
    const second = Math.min(first + 1, jaw.length / 7 - 1);
    const { quaternion, position } = this.lower;
    const { turn, shift } = this.after;
    quaternion.fromArray(jaw, 7 * first).slerp(turn.fromArray(jaw, 7 * second), frame - first);
    position.fromArray(jaw, 7 * first + 4).lerp(shift.fromArray(jaw, 7 * second + 4), frame - first);
  }
}
