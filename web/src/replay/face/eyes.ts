// SPDX-License-Identifier: GPL-3.0-or-later
// Eyeballs: the program's own model with the light that passes between the lids
// (src/hyperex/report/eye_model.hpp), under a clear cornea that catches the lamps.
import {
  AdditiveBlending, BufferAttribute, BufferGeometry, Group, Mesh, MeshStandardMaterial, Quaternion, SphereGeometry, Vector3,
} from 'three';
import { linearOf } from './colour';
import type { Replay } from '../data';

const materials = {
  ball: new MeshStandardMaterial({ roughness: 0.3, vertexColors: true }),
  // Black, so that it adds only highlights. Its material is of the same type as the ball's, because another type needs
  // its own shader, which takes long to compile on software renderers.
  cornea: new MeshStandardMaterial({
    roughness: 0.16, vertexColors: true, blending: AdditiveBlending, transparent: true, depthWrite: false,
  }),
};

/** Radius of the cornea as an angle from the gaze, radians: a little wider than the iris. */
const corneaAngle = 0.56;
/** Share of the ball's radius at which the cornea's centre of curvature lies before the ball's: 12 and 7.8 mm. */
const corneaCentre = 0.4;

/** A cap over the iris. It stays close to the ball, where lids pass over it; its normals are those of its bulge. */
function cornea(): BufferGeometry {
  const cap = new SphereGeometry(1.006, 32, 10, 0, 2 * Math.PI, 0, corneaAngle);
  cap.rotateX(Math.PI / 2); // its pole from +y to +z
  const position = cap.getAttribute('position');
  const normal = cap.getAttribute('normal');
  const out = new Vector3();
  for (let i = 0; i < position.count; ++i) {
    out.fromBufferAttribute(position, i);
    out.z -= corneaCentre;
    out.normalize();
    normal.setXYZ(i, out.x, out.y, out.z);
  }
  cap.setAttribute('color', new BufferAttribute(new Float32Array(3 * position.count), 3));
  return cap;
}

function ball(model: NonNullable<Replay['eyeModel']>, light: Uint8Array): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(model.points, 3));
  geometry.setAttribute('normal', new BufferAttribute(model.points, 3)); // a sphere of radius 1
  const colour = Float32Array.from(model.colours, (byte, i) => linearOf(byte) * linearOf(light[Math.floor(i / 3)]));
  geometry.setAttribute('color', new BufferAttribute(colour, 3));
  geometry.setIndex(new BufferAttribute(model.triangles, 1));
  return geometry;
}

const ahead = new Vector3(0, 0, 1);
const after = new Quaternion();

/** The right and the left eye. */
export class Eyes {
  readonly balls: Group[];
  private readonly rest: Quaternion[];

  constructor({ eyeballs, eyeModel }: Replay) {
    const shown = eyeModel ? eyeballs : [];
    this.rest = shown.map(({ gaze }) => new Quaternion().setFromUnitVectors(ahead, new Vector3(...gaze)));
    this.balls = shown.map(({ centre, radiusM, light }, side) => {
      const eye = new Group();
      eye.add(new Mesh(ball(eyeModel!, light), materials.ball), new Mesh(cornea(), materials.cornea));
      eye.quaternion.copy(this.rest[side]);
      eye.position.set(...centre);
      eye.scale.setScalar(radiusM);
      return eye;
    });
  }

  /** `gaze`: as in `Replay`. `frame`: may be fractional; interpolated as in the animated glTF. */
  turn(gaze: Float32Array | null, frame: number): void {
    const first = Math.floor(frame);
    this.balls.forEach(({ quaternion }, side) => {
      if (!gaze) {
        quaternion.copy(this.rest[side]);
        return;
      }
      const second = Math.min(first + 1, gaze.length / 8 - 1);
      const at = (which: number) => 8 * which + 4 * side;
      quaternion.fromArray(gaze, at(first)).slerp(after.fromArray(gaze, at(second)), frame - first);
      quaternion.multiply(this.rest[side]);
    });
  }
}
