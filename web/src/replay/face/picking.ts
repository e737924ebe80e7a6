// SPDX-License-Identifier: GPL-3.0-or-later
// Where a place in the window meets the skin, and where a place on the skin lies in the window.
import { Raycaster, Vector2, Vector3, type Object3D, type PerspectiveCamera } from 'three';
import type { Vec3 } from '../data';
import type { FaceBody, SkinHit } from './face_body';

/** Where a body is drawn: `width` pixels from `x` on, clipped to [from, to). */
export interface Pass {
  body: FaceBody;
  x: number;
  width: number;
  from: number;
  to: number;
}

/** A vertex of the skin on the first (0) or the second (1) face shown. */
export interface Place {
  vertex: number;
  side: number;
}

export interface PixelPlace {
  x: number;
  y: number;
}

/** All coordinates of windows are CSS pixels, as clientX and clientY. */
export class Picking {
  /** `upright`: holds all bodies, in the scan's axes. */
  constructor(
    private readonly host: HTMLElement, private readonly camera: PerspectiveCamera, private readonly upright: Object3D,
    private readonly passes: () => Pass[],
  ) {}

  /** The skin of the single face shown, in the scan's axes, m. */
  skinAt(clientX: number, clientY: number): Vector3 | null {
    const [pass] = this.passes();
    return pass.body.placeOn(this.rayAt(clientX, clientY, pass));
  }

  /** The skin of the face shown there. `pixelsPerM`: at its depth. */
  hitAt(clientX: number, clientY: number): (SkinHit & { pixelsPerM: number }) | null {
    const pass = this.passAt(clientX)?.pass;
    const hit = pass?.body.hitOn(this.rayAt(clientX, clientY, pass));
    if (!pass || !hit) return null;
    const at = pass.body.mesh.localToWorld(pass.body.positionOf(hit.vertices[0]));
    const depth = -at.applyMatrix4(this.camera.matrixWorldInverse).z;
    const halfHeight = Math.tan((this.camera.fov * Math.PI) / 360);
    return { ...hit, pixelsPerM: this.host.clientHeight / (2 * depth * halfHeight) };
  }

  /** The nearest vertex of the skin of the face shown there. */
  placeAt(clientX: number, clientY: number): Place | null {
    const found = this.passAt(clientX);
    if (!found) return null;
    const vertex = found.pass.body.vertexAt(this.rayAt(clientX, clientY, found.pass));
    return vertex === null ? null : { vertex, side: found.side };
  }

  /** A place on the skin of the last face shown, in the window. */
  seenAt({ vertices, weights }: SkinHit): PixelPlace {
    const passes = this.passes();
    const { body, x, width } = passes[passes.length - 1];
    const at = new Vector3();
    vertices.forEach((vertex, k) => at.addScaledVector(body.positionOf(vertex), weights[k]));
    body.mesh.localToWorld(at).project(this.camera);
    const box = this.host.getBoundingClientRect();
    return { x: box.left + x + ((at.x + 1) / 2) * width, y: box.top + ((1 - at.y) / 2) * box.height };
  }

  /** A point in the scan's axes, in the part of the window with the last face shown. */
  inWindow(point: Vec3): PixelPlace {
    const passes = this.passes();
    const { x, width } = passes[passes.length - 1];
    const box = this.host.getBoundingClientRect();
    const at = this.upright.localToWorld(new Vector3(...point)).project(this.camera);
    return { x: box.left + x + ((at.x + 1) / 2) * width, y: box.top + ((1 - at.y) / 2) * box.height };
  }

  /** A vertex as it is now, in pixels of the stage; null outside its face's part. */
  whereIs({ vertex, side }: Place): PixelPlace | null {
    const passes = this.passes();
    const { body, x: left, width } = passes[side] ?? passes[0];
    const at = body.mesh.localToWorld(body.positionOf(vertex)).project(this.camera);
    if (Math.abs(at.x) > 1 || Math.abs(at.y) > 1) return null;
    return { x: left + ((at.x + 1) / 2) * width, y: ((1 - at.y) / 2) * this.host.clientHeight };
  }

  /** The ray of a place in the window, over the last face shown. */
  rayOnLast(clientX: number, clientY: number): Raycaster {
    const passes = this.passes();
    return this.rayAt(clientX, clientY, passes[passes.length - 1]);
  }

  private passAt(clientX: number): { pass: Pass; side: number } | null {
    const x = clientX - this.host.getBoundingClientRect().left;
    const passes = this.passes();
    const side = passes.findIndex(({ from, to }) => x >= from && x < to);
    return side < 0 ? null : { pass: passes[side], side };
  }

  private rayAt(clientX: number, clientY: number, pass: Pass): Raycaster {
    const box = this.host.getBoundingClientRect();
    const ray = new Raycaster();
    const at = new Vector2((2 * (clientX - box.left - pass.x)) / pass.width - 1, 1 - (2 * (clientY - box.top)) / box.height);
    ray.setFromCamera(at, this.camera);
    return ray;
  }
}
