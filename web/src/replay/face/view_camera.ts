// SPDX-License-Identifier: GPL-3.0-or-later
// The camera, how it fits the face into the stage, and how it moves around the face.
import { PerspectiveCamera, Spherical, Vector3, type Box3 } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

export type View = 'front' | 'three-quarter' | 'left' | 'right';

const yawDegrees: Record<View, number> = { front: 0, 'three-quarter': 38, left: 90, right: -90 };
/** How far the camera is above the middle of the face, as a share of its distance. From in front it is level, as in the
 *  program's pictures. */
const rise: Record<View, number> = { front: 0, 'three-quarter': 0.04, left: 0.04, right: 0.04 };
const radians = (degrees: number) => (degrees * Math.PI) / 180;

export class ViewCamera {
  // The camera stands 0.8 m or more before a face, as for a portrait. From nearer the mouth is seen from above: the upper
  // lip then hides the front teeth, and lower molars show.
  readonly camera = new PerspectiveCamera(14, 1, 0.01, 10);
  readonly controls: OrbitControls;
  private readonly centre = new Vector3();
  private readonly size = new Vector3();

  /** `room`: what must be visible, m. `moved` is called after each movement. */
  constructor(canvas: HTMLCanvasElement, room: Box3, private readonly moved: () => void) {
    room.getCenter(this.centre);
    room.getSize(this.size);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener('change', moved);
  }

  /** Whether the wheel zooms about the pointer. Where two faces are side by side it cannot: the controls take the whole
   *  canvas for one picture. */
  set zoomsAtPointer(on: boolean) {
    this.controls.zoomToCursor = on;
  }

  lookFrom(view: View): void {
    const yaw = radians(yawDegrees[view]);
    const from = new Vector3(Math.sin(yaw), rise[view], Math.cos(yaw)).normalize();
    this.camera.position.copy(this.centre).addScaledVector(from, this.distance(from));
    this.controls.target.copy(this.centre);
    this.update();
  }

  /** Rotates the camera around the face, to its left and up; degrees. */
  turn(yaw: number, pitch: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const at = new Spherical().setFromVector3(offset);
    at.theta += radians(yaw);
    at.phi = Math.min(Math.max(at.phi - radians(pitch), 0.05), Math.PI - 0.05);
    this.camera.position.copy(this.controls.target).add(offset.setFromSpherical(at));
    this.update();
  }

  zoom(factor: number): void {
    const { target } = this.controls;
    this.camera.position.sub(target).divideScalar(factor).add(target);
    this.update();
  }

  /** For a picture of another shape: nearer or farther, in the same direction. */
  fit(aspect: number): void {
    const from = this.camera.position.clone().sub(this.controls.target).normalize();
    const before = this.distance(from);
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
    this.zoom(before / this.distance(from));
  }

  /** The distance (m) at which the face fills the picture, seen from a direction: in profile its depth is the width. */
  private distance({ x, z }: Vector3): number {
    const { size } = this;
    const across = Math.hypot(x, z) || 1;
    const [side, front] = [Math.abs(x) / across, Math.abs(z) / across];
    const half = Math.max(size.y, (front * size.x + side * size.z) / Math.max(this.camera.aspect, 0.1)) / 2;
    return (1.06 * half) / Math.tan(radians(this.camera.fov) / 2) + (front * size.z + side * size.x) / 4;
  }

  private update(): void {
    this.controls.update();
    this.moved();
  }
}
