// SPDX-License-Identifier: GPL-3.0-or-later
// One face to draw: its skin, coloured, and what is shown over it.
import {
  BufferAttribute, BufferGeometry, DataTexture, DoubleSide, Group, LinearFilter, Mesh, MeshLambertMaterial,
  type MeshStandardMaterial, Raycaster, RGBAFormat, SRGBColorSpace, Texture, Vector3,
} from 'three';
import { Backing } from './backing';
import { linearOf, rampBytes, type RampName } from './colour';
import type { Painting } from './colouring';
import type { Face, Replay } from '../data';
import { FaceShape, type SceneMotion } from './deform';
import { LevelOfDetail } from './level_of_detail';
import { disposeOverlay, litMuscles, overlaysOf, type Overlay, type OverlayName } from './overlays';
import { skinMaterial } from './skin_material';
import { Teeth } from './teeth';

const rampSize = 256;
/** Skin with more triangles is drawn with fewer while it moves, where the processor draws. */
const manyTriangles = 30_000;

/** A place on the skin, wherever it has moved to. */
export interface SkinHit {
  vertices: [number, number, number];
  /** Sum 1. */
  weights: [number, number, number];
}

/** What all faces are drawn with. */
export class FaceMaterials {
  /** Colours of a map, looked up for every pixel. */
  readonly mapped = new MeshLambertMaterial({ side: DoubleSide });
  /** The skin's own. */
  readonly plain = skinMaterial();
  /** Pairs for each vertex drawn, which the skin's own material reads. */
  readonly lightAndFade: BufferAttribute;
  private readonly ramps = new Map<RampName, Texture>();

  constructor(replay: Replay) {
    this.lightAndFade = new BufferAttribute(lightAndFade(replay), 2, true);
    this.useRamp('moss');
    if (!replay.colour) return;
    this.plain.vertexColors = true;
    this.plain.color.set('#ffffff');
  }

  useRamp(name: RampName): void {
    let ramp = this.ramps.get(name);
    if (!ramp) {
      ramp = new DataTexture(rampBytes(name, rampSize), rampSize, 2, RGBAFormat);
      ramp.colorSpace = SRGBColorSpace;
      ramp.magFilter = ramp.minFilter = LinearFilter;
      ramp.channel = 1;
      ramp.needsUpdate = true;
      this.ramps.set(name, ramp);
    }
    this.mapped.map = ramp;
  }

  useTexture(texture: Texture): void {
    this.plain.map = texture;
    this.plain.color.set('#ffffff');
    this.plain.needsUpdate = true;
  }
}

export class FaceBody {
  readonly object = new Group();
  overlays: Overlay[] = [];
  readonly mesh: Mesh<BufferGeometry, MeshLambertMaterial | MeshStandardMaterial>;
  readonly shape: FaceShape;
  private readonly backing: Backing;
  private readonly teeth: Teeth;
  private readonly shares: Float32Array;
  /** Vertices drawn, where the picture's seams split those of the skin. */
  private readonly split: Int32Array | null;
  private readonly position: BufferAttribute;
  private readonly normal: BufferAttribute;
  private readonly ramp: BufferAttribute;
  private readonly visible = new Set<OverlayName>();
  private lit: Overlay | null = null;
  private detail: LevelOfDetail | null = null;
  private fewOfSkin: ArrayLike<number> | undefined;
  private normalsOf: ArrayLike<number> | undefined;
  private frame = 0;

  constructor(private readonly replay: Replay, scene: SceneMotion, face: Face, private readonly materials: FaceMaterials) {
    this.shape = new FaceShape(replay, scene, face);
    this.split = replay.texture?.skinVertex ?? null;
    const skinCount = replay.points.length / 3;
    const count = this.split?.length ?? skinCount;
    this.shares = new Float32Array(skinCount);
    const geometry = new BufferGeometry();
    const attribute = (name: string, array: Float32Array, itemSize: number) => {
      const made = new BufferAttribute(array, itemSize);
      geometry.setAttribute(name, made);
      return made;
    };
    this.position = attribute('position', this.split ? new Float32Array(3 * count) : this.shape.position, 3);
    this.normal = attribute('normal', this.split ? new Float32Array(3 * count) : this.shape.normal, 3);
    this.ramp = attribute('uv1', new Float32Array(2 * count).fill(0.5), 2);
    geometry.setAttribute('lightAndFade', materials.lightAndFade);
    if (replay.texture) attribute('uv', replay.texture.uv, 2);
    if (replay.colour) attribute('color', linearColours(replay.colour), 3);
    geometry.setIndex(new BufferAttribute(new Uint32Array(replay.texture?.triangles ?? replay.triangles), 1));
    this.mesh = new Mesh<BufferGeometry, MeshLambertMaterial | MeshStandardMaterial>(geometry, materials.mapped);
    this.mesh.frustumCulled = false;
    this.backing = new Backing(replay);
    this.teeth = new Teeth(replay);
    this.object.add(this.mesh, this.backing.object, this.teeth.object);
    this.makeOverlays();
  }

  /** Call it after a new motion. */
  makeOverlays(): void {
    for (const overlay of this.overlays) disposeOverlay(overlay);
    this.overlays = overlaysOf(this.replay);
    for (const { name, object } of this.overlays) object.visible = this.visible.has(name);
    this.object.add(...this.overlays.map(({ object }) => object));
  }

  /** With few triangles, for a picture in motion. */
  set coarse(on: boolean) {
    if (!on && !this.detail) return;
    this.detail ??= this.levels();
    this.detail.use(on);
    this.normalsOf = on ? this.fewOfSkin : undefined;
  }

  /** Whether normals in motion are computed from fewer triangles than at rest. */
  get coarsens(): boolean {
    return this.fewOfSkin !== undefined;
  }

  private levels(): LevelOfDetail {
    const levels = new LevelOfDetail();
    const { split } = this;
    if (this.mesh.geometry.getIndex()!.count > 3 * manyTriangles) {
      const few = levels.add(this.mesh, 1);
      this.fewOfSkin = split ? Uint32Array.from(few, (i) => split[i]) : few;
    }
    for (const { object } of [this.backing, this.teeth])
      object.traverse((one) => {
        if (one instanceof Mesh && one.geometry.getIndex()) levels.add(one as Mesh, 2);
      });
    return levels;
  }

  get face(): Face {
    return this.shape.face;
  }

  /** `live`: displacements instead of those of the motion. */
  moveTo(face: Face, frame: number, live: Float32Array | null = null): void {
    this.shape.face = face;
    this.frame = frame;
    this.shape.moveTo(frame, live, this.normalsOf);
    this.copyOut(this.shape.position, this.position);
    this.copyOut(this.shape.normal, this.normal);
    this.backing.follow(this.shape.position, this.teeth.moveTo(face, frame));
    this.backing.eyes.turn(this.replay.gaze, frame);
    this.teeth.light = this.backing.lightInMouth;
    for (const overlay of this.overlays)
      if (overlay.object.visible) this.carry(overlay);
    if (this.lit) this.carry(this.lit);
  }

  /** Shows these muscles alone, brighter than the others. */
  lightMuscles(names: ReadonlySet<string>): void {
    if (this.lit) disposeOverlay(this.lit);
    this.lit = litMuscles(this.replay, names);
    if (!this.lit) return;
    this.object.add(this.lit.object);
    this.carry(this.lit);
  }

  private carry(overlay: Overlay): void {
    overlay.follow(this.shape.displacement, this.face, this.frame);
  }

  /** `other`: the other face of two. */
  paint(painting: Painting, other: FaceBody | null): void {
    this.mesh.material = painting.scale ? this.materials.mapped : this.materials.plain;
    if (!painting.scale) return;
    painting.fill(this.shape, this.shares, other?.shape ?? null);
    const out = this.ramp.array as Float32Array;
    const { split, shares } = this;
    // Maps 0 and 1 to the centres of the first and the last colour.
    const span = 1 - 1 / rampSize;
    const start = 0.5 / rampSize;
    for (let i = 0; i < this.ramp.count; ++i) {
      const share = shares[split ? split[i] : i];
      const known = share === share; // not NaN; faster than Number.isNaN
      out[2 * i] = known ? start + span * share : start;
      out[2 * i + 1] = known ? 0.25 : 0.75; // the middles of the map's rows
    }
    this.ramp.needsUpdate = true;
  }

  showOverlay(name: OverlayName, visible: boolean): void {
    if (visible) this.visible.add(name);
    else this.visible.delete(name);
    for (const overlay of this.overlays) {
      if (overlay.name !== name) continue;
      overlay.object.visible = visible;
      if (visible) this.carry(overlay);
    }
  }

  /** The skin's vertex next to where a ray first meets this face. */
  vertexAt(ray: Raycaster): number | null {
    this.mesh.geometry.boundingSphere = null; // it was that of another frame
    const [first] = ray.intersectObject(this.mesh, false);
    if (!first?.face) return null;
    const { a, b, c } = first.face;
    const at = this.mesh.worldToLocal(first.point.clone());
    const far = (vertex: number) => at.distanceToSquared(this.positionOf(vertex));
    return [a, b, c].map((i) => (this.split ? this.split[i] : i)).reduce((p, q) => (far(q) < far(p) ? q : p));
  }

  /** Where on the skin a ray first meets this face: a triangle's vertices, and their weights. */
  hitOn(ray: Raycaster): SkinHit | null {
    this.mesh.geometry.boundingSphere = null; // it was that of another frame
    const [first] = ray.intersectObject(this.mesh, false);
    if (!first?.face || !first.barycoord) return null;
    const { a, b, c } = first.face;
    const vertices = [a, b, c].map((i) => (this.split ? this.split[i] : i)) as SkinHit['vertices'];
    return { vertices, weights: [first.barycoord.x, first.barycoord.y, first.barycoord.z] };
  }

  /** Where a ray first meets this face, in the scan's own axes. */
  placeOn(ray: Raycaster): Vector3 | null {
    this.mesh.geometry.boundingSphere = null; // it was that of another frame
    const [first] = ray.intersectObject(this.mesh, false);
    return first ? this.mesh.worldToLocal(first.point.clone()) : null;
  }

  /** Metres, in the scan's own axes. */
  positionOf(vertex: number): Vector3 {
    return new Vector3().fromArray(this.shape.position, 3 * vertex);
  }

  /** `share`: place on the colour map, 0 to 1; NaN where a vertex has no value. */
  figuresOf(vertex: number): { displacementMm: number; share: number } {
    const [x, y, z] = this.shape.displacement.subarray(3 * vertex, 3 * vertex + 3);
    return { displacementMm: 1e3 * Math.hypot(x, y, z), share: this.shares[vertex] };
  }

  private copyOut(from: Float32Array, attribute: BufferAttribute): void {
    attribute.needsUpdate = true;
    const { split } = this;
    if (!split) return; // drawn from the same array
    const out = attribute.array as Float32Array;
    for (let i = 0, to = 0; i < split.length; ++i) {
      const at = 3 * split[i];
      out[to++] = from[at];
      out[to++] = from[at + 1];
      out[to++] = from[at + 2];
    }
  }
}

function lightAndFade({ light, fade, texture }: Replay): Uint8Array {
  const count = texture?.skinVertex.length ?? light.length;
  const out = new Uint8Array(2 * count);
  for (let i = 0; i < count; ++i) {
    const v = texture ? texture.skinVertex[i] : i;
    out[2 * i] = light[v];
    out[2 * i + 1] = fade[v];
  }
  return out;
}

function linearColours(rgba: Uint8Array): Float32Array {
  const out = new Float32Array((3 * rgba.length) / 4);
  for (let v = 0; v < rgba.length / 4; ++v)
    for (let k = 0; k < 3; ++k) out[3 * v + k] = linearOf(rgba[4 * v + k]);
  return out;
}
