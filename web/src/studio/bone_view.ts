// SPDX-License-Identifier: GPL-3.0-or-later
// The segment of bone that is being moved, seen through the skin: the person's own bones where they are known, the
// plane of the cut, and an arrow for each direction in which it can be dragged.
import {
  BufferAttribute, BufferGeometry, Color, ConeGeometry, CylinderGeometry, DoubleSide, Group, Material, Matrix4, Mesh,
  MeshBasicMaterial, MeshLambertMaterial, Object3D, PlaneGeometry, Quaternion, type Raycaster, Vector3,
} from 'three';
import type { Face, Vec3 } from '../replay/data';
import { placeAsJaw } from '../replay/face/teeth';
import type { BoneMove, BonesKnown, BoneSegment, Surface } from './bone_moves';

const boneColour = '#e9dfc3';
const segmentColour = '#6ea8e5';
/** Of the arrows to the left, up, forward. */
export const axisColours = ['#d5483f', '#3f9b46', '#3b6fd4'];
const arrowM = 0.035;
const planeM = 0.1;

/** The motion of a segment, now from rest (src/hyperex/simulate/drive/osteotomy.cpp). */
export function motionOf({ move_mm, turn_deg }: BoneMove, { turns_about }: BoneSegment, axes: [Vec3, Vec3, Vec3]): Matrix4 {
  const [x, y, z] = axes.map((axis) => new Vector3(...axis));
  const [a, b, c] = turn_deg.map((deg) => (deg * Math.PI) / 180);
  const about = (axis: Vector3, angle: number) => new Matrix4().makeRotationAxis(axis, angle);
  const turn = about(z, c).multiply(about(y, b)).multiply(about(x, a));
  const centre = new Vector3(...turns_about);
  const by = new Vector3().addScaledVector(x, move_mm[0] / 1e3).addScaledVector(y, move_mm[1] / 1e3).addScaledVector(z, move_mm[2] / 1e3);
  const shift = by.add(centre).sub(centre.clone().applyMatrix4(turn));
  return turn.setPosition(shift);
}

/** Whether a place on the segment's bone belongs to it. */
function holds(segment: BoneSegment, shiftM: number, { axes, middle }: BonesKnown, at: Vector3): boolean {
  const normal = new Vector3(...segment.plane_normal);
  const along = at.clone().sub(new Vector3(...segment.plane_at)).dot(normal);
  if (normal.lengthSq() > 0 && along <= shiftM) return false;
  if (segment.ends_at && at.clone().sub(new Vector3(...segment.ends_at)).dot(new Vector3(...axes[2])) <= 0) return false;
  return segment.half_width_m === 0 || Math.abs(at.clone().sub(new Vector3(...middle)).dot(new Vector3(...axes[0]))) < segment.half_width_m;
}

function meshOf(points: Float32Array, triangles: number[], colour: string): Mesh {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(points, 3));
  geometry.setIndex(triangles);
  geometry.computeVertexNormals();
  const mesh = new Mesh(geometry, new MeshLambertMaterial({ color: new Color(colour), transparent: true, opacity: 0.72, side: DoubleSide }));
  mesh.frustumCulled = false;
  mesh.renderOrder = 4;
  return mesh;
}

function arrow(axis: Vec3, colour: string): Group {
  const material = new MeshBasicMaterial({ color: new Color(colour), transparent: true, depthTest: false });
  const shaft = new Mesh(new CylinderGeometry(0.0009, 0.0009, arrowM, 10), material);
  shaft.position.y = arrowM / 2;
  const tip = new Mesh(new ConeGeometry(0.0028, 0.008, 16), material);
  tip.position.y = arrowM + 0.004;
  const group = new Group();
  group.add(shaft, tip);
  group.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), new Vector3(...axis)));
  for (const part of [shaft, tip]) {
    part.renderOrder = 6;
    part.frustumCulled = false;
  }
  return group;
}

export class BoneView {
  readonly object = new Group();
  private readonly segment: BoneSegment;
  /** The mandible and what is on it; it opens as the jaw does. */
  private readonly jaw = new Group();
  private readonly moving = new Group();
  private readonly arrows = new Group();
  private readonly surfaces: Mesh[] = [];

  constructor(private readonly bones: BonesKnown, private move: BoneMove) {
    this.segment = segmentOf(bones, move);
    this.addBones();
    this.addPlane();
    bones.axes.forEach((axis, k) => this.arrows.add(arrow(axis, axisColours[k])));
    (this.onJaw ? this.jaw : this.object).add(this.moving, this.arrows);
    this.jaw.matrixAutoUpdate = false;
    this.object.add(this.jaw);
    this.clearDepth();
    this.set(move);
  }

  private get onJaw(): boolean {
    return this.segment.part === 'mandible' || this.segment.part === 'chin';
  }

  /** The base of the arrows, and their directions; metres, in the scan's axes. */
  get handle(): { at: Vector3; axes: Vector3[]; lengthM: number } {
    const at = this.arrows.position.clone();
    const axes = this.bones.axes.map((axis) => new Vector3(...axis));
    if (this.onJaw) for (const axis of axes) axis.transformDirection(this.jaw.matrix);
    return { at: this.onJaw ? at.applyMatrix4(this.jaw.matrix) : at, axes, lengthM: arrowM + 0.008 };
  }

  /** Whether the bones are drawn over the skin; the cut and the arrows always are. */
  set bonesVisible(on: boolean) {
    for (const surface of this.surfaces) surface.visible = on;
  }

  /** Another move with the same cut. */
  set(move: BoneMove): void {
    this.move = move;
    const motion = motionOf(move, this.segment, this.bones.axes);
    this.moving.matrixAutoUpdate = false;
    this.moving.matrix.copy(motion);
    this.moving.matrixWorldNeedsUpdate = true;
    this.arrows.position.set(...this.segment.turns_about).applyMatrix4(motion);
  }

  /** Opens the jaw as that of a face in a frame, without what surgery itself moved. */
  openAs(face: Face, frame: number): void {
    if (!face.jaw) return;
    const [now, rest] = [new Object3D(), new Object3D()];
    placeAsJaw(now, face, frame);
    placeAsJaw(rest, face, 0);
    now.updateMatrix();
    rest.updateMatrix();
    this.jaw.matrix.multiplyMatrices(now.matrix, rest.matrix.invert());
    this.jaw.matrixWorldNeedsUpdate = true;
  }

  /** Where a ray meets a bone, as it lies at rest before surgery; metres, in the scan's axes. */
  placeOn(ray: Raycaster): Vec3 | null {
    this.object.updateWorldMatrix(true, true);
    const [hit] = ray.intersectObjects(this.surfaces, false);
    return hit ? (hit.object.worldToLocal(hit.point.clone()).toArray() as Vec3) : null;
  }

  dispose(): void {
    this.object.removeFromParent();
    this.object.traverse((part) => {
      if (!(part instanceof Mesh)) return;
      part.geometry.dispose();
      (part.material as Material).dispose();
    });
  }

  private addBones(): void {
    const { bones } = this;
    const own = this.onJaw ? 'mandible' : 'skull';
    for (const name of ['skull', 'mandible'] as const) {
      const bone = bones[name];
      if (!bone) continue;
      const [kept, moved] = name === own ? this.divided(bone) : [Array.from(bone.triangles), []];
      const add = (into: Group, triangles: number[], colour: string) => {
        if (triangles.length === 0) return;
        const mesh = meshOf(bone.points, triangles, colour);
        this.surfaces.push(mesh);
        into.add(mesh);
      };
      add(name === 'mandible' ? this.jaw : this.object, kept, boneColour);
      add(this.moving, moved, segmentColour);
    }
  }

  /** So that bones and plane are drawn over the skin, but hide each other. */
  private clearDepth(): void {
    const before = new Mesh(new BufferGeometry(), new MeshBasicMaterial({ transparent: true }));
    before.geometry.setAttribute('position', new BufferAttribute(new Float32Array(9), 3));
    before.renderOrder = 3;
    before.frustumCulled = false;
    before.onBeforeRender = (renderer) => renderer.clearDepth();
    this.object.add(before);
  }

  /** The triangles that stay, and those of the segment. */
  private divided({ points, triangles }: Surface): [number[], number[]] {
    const { segment, bones, move } = this;
    // The plane is shifted upwards, or forward for a split of the mandible.
    const shiftM = (move.cut_shift_mm / 1e3) * (segment.cut === 'bsso' ? 1 : -1);
    const [kept, moved]: [number[], number[]] = [[], []];
    const at = new Vector3();
    for (let t = 0; t < triangles.length; t += 3) {
      at.set(0, 0, 0);
      for (let k = 0; k < 3; ++k) for (let c = 0; c < 3; ++c) at.setComponent(c, at.getComponent(c) + points[3 * triangles[t + k] + c] / 3);
      (holds(segment, shiftM, bones, at) ? moved : kept).push(triangles[t], triangles[t + 1], triangles[t + 2]);
    }
    return [kept, moved];
  }

  private addPlane(): void {
    const { segment, bones, move } = this;
    const normal = new Vector3(...segment.plane_normal);
    if (normal.lengthSq() === 0) return;
    const material = new MeshBasicMaterial({ color: new Color('#f2a93b'), transparent: true, opacity: 0.35, side: DoubleSide, depthWrite: false });
    const plane = new Mesh(new PlaneGeometry(planeM, planeM), material);
    plane.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), normal);
    const along = new Vector3(...bones.axes[segment.cut === 'bsso' ? 2 : 1]);
    plane.position.set(...segment.plane_at).addScaledVector(along, move.cut_shift_mm / 1e3);
    plane.renderOrder = 5;
    plane.frustumCulled = false;
    (this.onJaw ? this.jaw : this.object).add(plane);
  }
}

/** The usual one of the part, or its whole bone. */
export function segmentOf({ segments }: BonesKnown, { part, cut }: BoneMove): BoneSegment {
  const usual = segments.find((segment) => segment.part === part)!;
  if (cut !== 'whole') return usual;
  const skull = segments.find((segment) => segment.part === 'skull')!;
  return { ...skull, part, cut };
}
