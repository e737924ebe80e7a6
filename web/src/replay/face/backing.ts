// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces behind the holes of the skin, so that it looks like a face and not like a mask: dark pockets that hang on
// the edges of mouth, eyes and nostrils, and plain eyeballs. The program says where
// (src/hyperex/report/face_backing.hpp, which draws the same into its pictures); no figure depends on it.
import {
  BufferAttribute, BufferGeometry, Color, DoubleSide, Group, Mesh, MeshBasicMaterial, MeshStandardMaterial, Quaternion,
  SphereGeometry, Vector3,
} from 'three';
import type { Replay } from '../data';

/** Of the edge and the two rings behind it. */
const colours = ['#5e3029', '#32130f', '#180806'];

class Pocket {
  readonly mesh: Mesh;
  private readonly position: Float32Array;
  /** Depth and width of the edge and the rings behind it, as shares. */
  private readonly rings: [number, number][];

  constructor(private readonly opening: Replay['openings'][number]) {
    const n = opening.loop.length;
    const rings: [number, number][] = [[0, 1], ...opening.rings];
    this.rings = rings;
    const count = rings.length * n + 1;
    this.position = new Float32Array(3 * count);
    const colour = new Float32Array(3 * count);
    rings.forEach((_ring, r) => {
      for (let i = 0; i < n; ++i) new Color(colours[r]).toArray(colour, 3 * (r * n + i));
    });
    new Color(colours.at(-1)!).toArray(colour, 3 * (count - 1));
    const index: number[] = [];
    for (let i = 0; i < n; ++i) {
      const next = (i + 1) % n;
      for (let r = 0; r + 1 < rings.length; ++r) {
        const [a, b] = [r * n + i, r * n + next];
        index.push(b, a, a + n, b, a + n, b + n);
      }
      const last = (rings.length - 1) * n;
      index.push(last + next, last + i, count - 1);
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(this.position, 3));
    geometry.setAttribute('color', new BufferAttribute(colour, 3));
    geometry.setIndex(index);
    this.mesh = new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true, side: DoubleSide }));
    this.mesh.frustumCulled = false;
  }

  /** Attaches it to the present positions of the skin's vertices. */
  follow(points: Float32Array): void {
    const { loop, inward, depthM } = this.opening;
    const n = loop.length;
    const { position, rings } = this;
    for (let k = 0; k < 3; ++k) {
      let centre = 0;
      for (const v of loop) centre += points[3 * v + k] / n;
      rings.forEach(([depth, width], r) => {
        for (let i = 0; i < n; ++i)
          position[3 * (r * n + i) + k] = centre + width * (points[3 * loop[i] + k] - centre) + depth * depthM * inward[k];
      });
      position[3 * rings.length * n + k] = centre + depthM * inward[k];
    }
    this.mesh.geometry.getAttribute('position').needsUpdate = true;
  }
}

/** Radii of iris and pupil as angles from the gaze: 11.7 and 4 mm across on a ball of 24 mm. */
const zones = [
  { from: 0.51, to: Math.PI, colour: '#eeeae4' },
  { from: 0.167, to: 0.51, colour: '#6d5b48' },
  { from: 0, to: 0.167, colour: '#14110f' },
];

function eyeball({ centre, gaze, radiusM }: Replay['eyeballs'][number]): Group {
  const group = new Group();
  for (const { from, to, colour } of zones) {
    const zone = new SphereGeometry(radiusM, 40, from === 0 ? 4 : 20, 0, 2 * Math.PI, from, to - from);
    group.add(new Mesh(zone, new MeshStandardMaterial({ color: colour, roughness: 0.35 })));
  }
  // Spheres of three.js have their pole along y.
  group.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), new Vector3(...gaze)));
  group.position.set(...centre);
  return group;
}

export class Backing {
  readonly object = new Group();
  private readonly pockets: Pocket[];

  constructor(replay: Replay) {
    this.pockets = replay.openings.map((opening) => new Pocket(opening));
    this.object.add(...this.pockets.map(({ mesh }) => mesh), ...replay.eyeballs.map(eyeball));
  }

  follow(points: Float32Array): void {
    for (const pocket of this.pockets) pocket.follow(points);
  }
}
