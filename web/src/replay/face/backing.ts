// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces behind the holes of the skin, so that it looks like a face and not like a mask: the lining of the mouth and
// dark pockets attached to the edges of mouth, eyes and nostrils, and eyeballs (eyes.ts). The program places them
// (src/hyperex/report/face_backing.hpp, which draws the same into its pictures); no figure depends on it.
import { BufferAttribute, BufferGeometry, DoubleSide, Group, type Matrix4, Mesh, MeshBasicMaterial, Vector3 } from 'three';
import { linearOf } from './colour';
import type { Opening, Replay } from '../data';
import { Eyes } from './eyes';

class Pocket {
  readonly mesh: Mesh;
  private readonly position: Float32Array;
  private readonly moved: Float32Array;
  private readonly jawMove = new Vector3();

  constructor(private readonly opening: Opening, private readonly skinRest: Float32Array) {
    const { loop, rest, rings, colours } = opening;
    const n = loop.length;
    const count = rest.length / 3;
    this.position = new Float32Array(rest);
    this.moved = new Float32Array(3 * n);
    const index: number[] = [];
    const last = (rings.length - 1) * n;
    for (let i = 0; i < n; ++i) {
      const next = (i + 1) % n;
      for (let r = 0; r < last; r += n) {
        const [a, b] = [r + i, r + next];
        index.push(b, a, a + n, b, a + n, b + n);
      }
      index.push(last + next, last + i, count - 1);
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(this.position, 3));
    geometry.setAttribute('color', new BufferAttribute(Float32Array.from(colours, linearOf), 3));
    geometry.setIndex(index);
    this.mesh = new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true, side: DoubleSide }));
    this.mesh.frustumCulled = false;
  }

  /** Attaches it to the present positions of the skin's vertices, and to the jaw (now from rest). */
  follow(points: Float32Array, jaw: Matrix4): void {
    const { position, moved, jawMove, skinRest } = this;
    const { loop, rest, rings } = this.opening;
    const n = loop.length;
    const centre = [0, 0, 0];
    for (let i = 0; i < n; ++i)
      for (let k = 0; k < 3; ++k) {
        const at = 3 * loop[i] + k;
        position[3 * i + k] = points[at];
        moved[3 * i + k] = points[at] - skinRest[at];
        centre[k] += moved[3 * i + k] / n;
      }
    for (let v = n; v < rest.length / 3; ++v) {
      const [ofEdge, ofCentre, ofJaw] = rings[Math.floor(v / n) - 1];
      const i = v % n;
      const share = ofJaw * (v === rings.length * n ? 0.5 : this.opening.jaw[i]);
      jawMove.fromArray(rest, 3 * v).applyMatrix4(jaw);
      for (let k = 0; k < 3; ++k) {
        const at = rest[3 * v + k];
        position[3 * v + k] =
          at + ofEdge * moved[3 * i + k] + ofCentre * centre[k] + share * (jawMove.getComponent(k) - at);
      }
    }
    this.mesh.geometry.getAttribute('position').needsUpdate = true;
  }
}

/** The same formula as light_between_lips in src/hyperex/report/face_backing.hpp. */
function lightBetweenLips(loop: Int32Array, points: Float32Array): number {
  const [least, fallsM] = [0.15, 1.5e-3];
  const [first, from, to, area] = [new Vector3(), new Vector3(), new Vector3(), new Vector3()];
  first.fromArray(points, 3 * loop[0]);
  let lengthM = 0;
  for (let i = 0; i < loop.length; ++i) {
    from.fromArray(points, 3 * loop[i]);
    to.fromArray(points, 3 * loop[(i + 1) % loop.length]);
    lengthM += from.distanceTo(to);
    area.addScaledVector(from.sub(first).cross(to.sub(first)), 0.5);
  }
  return 1 - (1 - least) * Math.exp((-2 * area.length()) / (lengthM * fallsM));
}

export class Backing {
  readonly object = new Group();
  /** How much light reaches what is behind the lips, 0 to 1. */
  lightInMouth = 1;
  readonly eyes: Eyes;
  private readonly pockets: Pocket[];
  private readonly mouth: Int32Array | undefined;

  constructor(replay: Replay) {
    this.mouth = replay.openings.find(({ jaw }) => jaw.some((share) => share > 0))?.loop;
    this.pockets = replay.openings.map((opening) => new Pocket(opening, replay.points));
    this.eyes = new Eyes(replay);
    this.object.add(...this.pockets.map(({ mesh }) => mesh), ...this.eyes.objects);
  }

  follow(points: Float32Array, jaw: Matrix4): void {
    for (const pocket of this.pockets) pocket.follow(points, jaw);
    if (this.mouth) this.lightInMouth = lightBetweenLips(this.mouth, points);
  }
}
