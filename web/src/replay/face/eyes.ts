// SPDX-License-Identifier: GPL-3.0-or-later
// Eyeballs: the program's own model with the light that passes between the lids
// (src/hyperex/report/eye_model.hpp), under a clear cornea that catches the lamps.
import {
  AdditiveBlending, BufferAttribute, BufferGeometry, Group, Mesh, MeshStandardMaterial, Quaternion, SphereGeometry, Vector3,
} from 'three';
import { linearOf } from './colour';
import { EyeLight } from './eye_light';
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

const ahead = new Vector3(0, 0, 1);
/** A turn by less leaves the light as it is, radians. */
const leastTurn = 0.002;
const now = new Quaternion();
const after = new Quaternion();

/** An eyeball about its centre. */
class Ball {
  readonly object = new Group();
  private readonly geometry = new BufferGeometry();
  /** Linear, without light. */
  private readonly colours: Float32Array;
  private readonly light: EyeLight;
  private readonly lit: Float32Array;
  private readonly rest: Quaternion;
  private readonly fromRest: Quaternion;
  private readonly turned = new Quaternion();

  constructor(model: NonNullable<Replay['eyeModel']>, { centre, gaze, radiusM, light }: Replay['eyeballs'][number]) {
    const { geometry, object } = this;
    this.colours = Float32Array.from(model.colours, linearOf);
    this.light = new EyeLight(model.points, light);
    this.lit = new Float32Array(light.length);
    geometry.setAttribute('position', new BufferAttribute(model.points, 3));
    geometry.setAttribute('normal', new BufferAttribute(model.points, 3)); // a sphere of radius 1
    geometry.setAttribute('color', new BufferAttribute(new Float32Array(model.points.length), 3));
    geometry.setIndex(new BufferAttribute(model.triangles, 1));
    object.add(new Mesh(geometry, materials.ball), new Mesh(cornea(), materials.cornea));
    this.rest = new Quaternion().setFromUnitVectors(ahead, new Vector3(...gaze));
    this.fromRest = this.rest.clone().invert();
    object.quaternion.copy(this.rest);
    object.position.set(...centre);
    object.scale.setScalar(radiusM);
    this.shade();
  }

  /** From how it stands at rest. */
  turn(turn: Quaternion): void {
    const { object, rest, fromRest, turned } = this;
    object.quaternion.multiplyQuaternions(turn, rest);
    if (turned.angleTo(now.multiplyQuaternions(fromRest, object.quaternion)) < leastTurn) return;
    turned.copy(now);
    this.shade();
  }

  private shade(): void {
    this.light.after(this.turned, this.lit);
    const colour = this.geometry.getAttribute('color') as BufferAttribute;
    const out = colour.array as Float32Array;
    for (let i = 0; i < out.length; ++i) out[i] = this.colours[i] * this.lit[Math.floor(i / 3)];
    colour.needsUpdate = true;
  }
}

/** The right and the left eye. */
export class Eyes {
  readonly objects: Group[];
  private readonly balls: Ball[];

  constructor({ eyeballs, eyeModel }: Replay) {
    this.balls = eyeModel ? eyeballs.map((eye) => new Ball(eyeModel, eye)) : [];
    this.objects = this.balls.map(({ object }) => object);
  }

  /** `gaze`: as in `Replay`. `frame`: may be fractional; interpolated as in the animated glTF. */
  turn(gaze: Float32Array | null, frame: number): void {
    const first = Math.floor(frame);
    this.balls.forEach((ball, side) => {
      if (!gaze) {
        ball.turn(now.identity());
        return;
      }
      const second = Math.min(first + 1, gaze.length / 8 - 1);
      const at = (which: number) => 8 * which + 4 * side;
      ball.turn(now.fromArray(gaze, at(first)).slerp(after.fromArray(gaze, at(second)), frame - first));
    });
  }
}
