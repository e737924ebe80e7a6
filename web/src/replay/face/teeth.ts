// SPDX-License-Identifier: GPL-3.0-or-later
// Teeth, gums and tongue behind the lips: the upper row moves by surgery alone, the others move with the jaw.
import {
  BufferAttribute, BufferGeometry, Color, Group, type Matrix4, Mesh, MeshStandardMaterial, type Object3D, Quaternion, SRGBColorSpace, Vector3,
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

const after = { turn: new Quaternion(), shift: new Vector3() };

/** Gives an object the jaw's pose since rest. `frame`: may be fractional; interpolated as in the animated glTF. */
export function placeAsJaw({ quaternion, position }: Object3D, { jaw }: Face, frame: number): void {
  if (!jaw) return;
  const first = Math.floor(frame);
  const second = Math.min(first + 1, jaw.length / 7 - 1);
  const { turn, shift } = after;
  quaternion.fromArray(jaw, 7 * first).slerp(turn.fromArray(jaw, 7 * second), frame - first);
  position.fromArray(jaw, 7 * first + 4).lerp(shift.fromArray(jaw, 7 * second + 4), frame - first);
}

export class Teeth {
  readonly object = new Group();
  private readonly upper = new Group();
  private readonly lower = new Group();
  private readonly colours = new Map<MeshStandardMaterial, Color>();

  constructor(replay: Replay) {
    this.object.add(this.upper, this.lower);
    for (const row of replay.teeth) {
      const mesh = meshOf(row);
      this.colours.set(mesh.material, mesh.material.color.clone());
      (row.jaw === 'lower' ? this.lower : this.upper).add(mesh);
    }
  }

  /** `light`: how much of it passes between the lips, 0 to 1. */
  set light(light: number) {
    for (const [material, colour] of this.colours) material.color.copy(colour).multiplyScalar(light);
  }

  /** `frame`: may be fractional. Returns the jaw's pose since rest. */
  moveTo(face: Face, frame: number): Matrix4 {
    const { upperTeeth } = face;
    this.upper.quaternion.fromArray(upperTeeth ?? [0, 0, 0, 1]);
    this.upper.position.fromArray(upperTeeth ?? [0, 0, 0], upperTeeth ? 4 : 0);
    placeAsJaw(this.lower, face, frame);
    this.lower.updateMatrix();
    return this.lower.matrix;
  }
}
