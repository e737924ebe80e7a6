// SPDX-License-Identifier: GPL-3.0-or-later
// Teeth, gums and tongue behind the lips: the upper row does not move, the others move with the jaw.
import {
  BufferAttribute, BufferGeometry, Color, Group, type Matrix4, Mesh, MeshStandardMaterial, Quaternion, SRGBColorSpace, Vector3,
} from 'three';
import type { Face, Replay } from '../data';

const roughness = { crowns: 0.35, gum: 0.5, tongue: 0.55 };

function meshOf({ part, colour, points, triangles, light }: Replay['teeth'][number]): Mesh<BufferGeometry, MeshStandardMaterial> {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(points, 3));
  const shade = Float32Array.from(points, (_, i) => light[Math.floor(i / 3)] / 255);
  geometry.setAttribute('color', new BufferAttribute(shade, 3));
  geometry.setIndex(new BufferAttribute(triangles, 1));
  geometry.computeVertexNormals();
  const material = new MeshStandardMaterial({ roughness: roughness[part], vertexColors: true });
  const [r, g, b] = colour.map((byte) => byte / 255);
  material.color.setRGB(r, g, b, SRGBColorSpace);
  const mesh = new Mesh(geometry, material);
  mesh.frustumCulled = false;
  return mesh;
}

export class Teeth {
  readonly object = new Group();
  private readonly lower = new Group();
  private readonly after = { turn: new Quaternion(), shift: new Vector3() };

  private readonly colours = new Map<MeshStandardMaterial, Color>();

  constructor(replay: Replay) {
    this.object.add(this.lower);
    for (const row of replay.teeth) {
      const mesh = meshOf(row);
      this.colours.set(mesh.material, mesh.material.color.clone());
      (row.jaw === 'lower' ? this.lower : this.object).add(mesh);
    }
  }

  /** `light`: how much of it passes between the lips, 0 to 1. */
  set light(light: number) {
    for (const [material, colour] of this.colours) material.color.copy(colour).multiplyScalar(light);
  }

  /** `frame`: may be fractional; interpolated as in the animated glTF. Returns the jaw's pose since rest. */
  moveTo(face: Face, frame: number): Matrix4 {
    const { jaw } = face;
    this.lower.updateMatrix();
    if (!jaw) return this.lower.matrix;
    const first = Math.floor(frame);
    const second = Math.min(first + 1, jaw.length / 7 - 1);
    const { quaternion, position } = this.lower;
    const { turn, shift } = this.after;
    quaternion.fromArray(jaw, 7 * first).slerp(turn.fromArray(jaw, 7 * second), frame - first);
    position.fromArray(jaw, 7 * first + 4).lerp(shift.fromArray(jaw, 7 * second + 4), frame - first);
    this.lower.updateMatrix();
    return this.lower.matrix;
  }
}
