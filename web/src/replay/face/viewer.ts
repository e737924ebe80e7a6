// SPDX-License-Identifier: GPL-3.0-or-later
// The face in 3D, or two of them: beside each other, or in one place and divided by an upright line.
// One camera for both. Draws only when something changed, and deforms only what is drawn.
import {
  Box3, Color, DirectionalLight, Group, HemisphereLight, NoToneMapping, PerspectiveCamera, Raycaster, Scene, Spherical,
  SRGBColorSpace, Texture, Vector2, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import type { Painting } from './colouring';
import type { Replay, Vec3 } from '../data';
import { SceneMotion } from './deform';
import { FaceBody, FaceMaterials, type SkinHit } from './face_body';
import { uprightFromScan } from './face_frame';
import type { Marks } from './marks';
import type { Overlay, OverlayName } from './overlays';
import type { Shown } from '../shown';
import { drawsInSoftware } from '../software_gl';
import { Listeners, Undoing, type Undo } from '../../page/listeners';

export type View = 'front' | 'three-quarter' | 'left' | 'right';

const yawDegrees: Record<View, number> = { front: 0, 'three-quarter': 38, left: 90, right: -90 };
const radians = (degrees: number) => (degrees * Math.PI) / 180;

/** Where a body is drawn: from pixel x on, of which those in [from, to) are kept. */
interface Pass {
  body: FaceBody;
  x: number;
  width: number;
  from: number;
  to: number;
}

/** A vertex of the skin, pointed at on the first or the second face shown. */
export interface Place {
  vertex: number;
  side: number;
}

export class FaceViewer {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(24, 1, 0.01, 10);
  private readonly controls: OrbitControls;
  private readonly motion: SceneMotion;
  private readonly materials: FaceMaterials;
  private readonly upright = new Group();
  /** The second is made when two faces are first shown. */
  private readonly bodies: FaceBody[] = [];
  private readonly lights: { light: DirectionalLight; onSkin: number; onMap: number }[] = [];
  private readonly sky = new HemisphereLight('#ffffff', '#8a7f78', 1);
  private readonly centre = new Vector3();
  private readonly size = new Vector3();
  private readonly visibleOverlays = new Set<OverlayName>();
  private frame = 0;
  private playing = false;
  private wipe = 0.5;
  private stale = true; // shapes are not those of `frame` and `shown`
  private queued = 0;
  /** The canvas holds a picture drawn since the page was last put on the screen. */
  private fresh = false;
  /** Everything but what is live is as it was drawn. */
  private whole = false;
  private liveStale = false; // the live shape alone is to be taken
  private coarse = false; // as it was drawn
  private disposed = false;
  /** Then pictures in motion are drawn with as few pixels as do, and those at rest once more with all. */
  private readonly software = drawsInSoftware();
  private drawnAt = 0;
  private slow = 0; // pictures in a row that came late
  private streaming = false;
  private rest = 0;
  private readonly drawn = new Listeners();
  private lit: ReadonlySet<string> = new Set();
  /** What a face looks like at this instant, in the place of its motion. */
  private live: { face: number; displacement: Float32Array } | null = null;
  private marks: Marks | null = null;
  private readonly undoing = new Undoing();

  /** Throws where the browser has no WebGL. */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly host: HTMLElement,
    private readonly replay: Replay,
    private readonly shown: Shown,
    private painting: Painting,
  ) {
    // What is kept need not be drawn again: of two faces that which is changed alone is.
    this.renderer = new WebGLRenderer({ canvas, antialias: !this.software, alpha: true, preserveDrawingBuffer: this.software });
    this.renderer.toneMapping = NoToneMapping;
    this.renderer.setClearColor(0, 0);
    this.renderer.autoClear = false;
    this.motion = new SceneMotion(replay);
    this.materials = new FaceMaterials(replay);
    this.upright.quaternion.copy(uprightFromScan(replay));
    this.scene.add(this.upright);
    this.addLights();
    this.loadTexture();
    this.measure();
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener('change', () => this.queue());
    this.paintAs(painting);
    this.lookFrom('front');
    const unfollow = shown.onChange(() => {
      this.refit();
      this.touch();
    });
    const sizes = new ResizeObserver(() => this.refit());
    sizes.observe(host);
    this.undoing.add(unfollow, () => sizes.disconnect());
    this.refit();
  }

  /** The replay moves otherwise now: what was made of it is made anew, the camera stays. */
  refresh(): void {
    this.motion.forget();
    this.live = null;
    for (const body of this.bodies) {
      body.makeOverlays();
      body.lightMuscles(this.lit);
    }
    this.touch();
  }

  /** Off the page for good; the canvas can draw nothing any more. */
  dispose(): void {
    this.undoing.undo();
    this.disposed = true;
    clearTimeout(this.rest);
    this.controls.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  /** A face at this instant, in metres from rest, until the next motion or `null`. `streaming`: more of them follow as
   *  fast as they are drawn, made by the same processor. */
  showLive(live: { face: number; displacement: Float32Array } | null, streaming = false): void {
    this.streaming = streaming && live !== null;
    if (!live && !this.live) return;
    const same = live?.face === this.live?.face;
    this.live = live;
    if (!live || this.fresh || document.hidden) {
      this.touch();
      return;
    }
    // Not in the next frame but for it: what comes in between is not waited for twice.
    this.stale ||= !same;
    this.liveStale = true;
    cancelAnimationFrame(this.queued);
    this.queued = 0;
    this.fresh = true;
    requestAnimationFrame(() => (this.fresh = false));
    this.show();
  }

  /** Points over the face alone that is shown, until null. */
  showMarks(marks: Marks | null): void {
    this.marks?.dispose();
    this.marks = marks;
    if (marks) this.upright.add(marks.object);
    this.queue();
  }

  /** After marks were moved or chosen. */
  redraw(): void {
    this.queue();
  }

  /** Whether pointers turn the face. */
  set turning(on: boolean) {
    this.controls.enabled = on;
  }

  /** Where a ray through a place in the window first meets the one face that is shown, in the scan's axes. */
  skinAt(clientX: number, clientY: number): Vector3 | null {
    return this.passes()[0].body.placeOn(this.rayAt(clientX, clientY, this.passes()[0]));
  }

  /** The place on the skin under a place in the window, on whichever face is shown there; `pixelsPerM`: at its depth. */
  hitAt(clientX: number, clientY: number): (SkinHit & { pixelsPerM: number }) | null {
    const x = clientX - this.host.getBoundingClientRect().left;
    const pass = this.passes().find(({ from, to }) => x >= from && x < to);
    const hit = pass?.body.hitOn(this.rayAt(clientX, clientY, pass));
    if (!pass || !hit) return null;
    const at = pass.body.mesh.localToWorld(pass.body.positionOf(hit.vertices[0]));
    const depth = -at.applyMatrix4(this.camera.matrixWorldInverse).z;
    return { ...hit, pixelsPerM: this.host.clientHeight / (2 * depth * Math.tan(radians(this.camera.fov) / 2)) };
  }

  /** Where a place on the skin is seen on the last of the faces shown, in the window. */
  seenAt({ vertices, weights }: SkinHit): { x: number; y: number } {
    const passes = this.passes();
    const { body, x, width } = passes[passes.length - 1];
    const at = new Vector3();
    vertices.forEach((vertex, k) => at.addScaledVector(body.positionOf(vertex), weights[k]));
    body.mesh.localToWorld(at).project(this.camera);
    const box = this.host.getBoundingClientRect();
    return { x: box.left + x + ((at.x + 1) / 2) * width, y: box.top + ((1 - at.y) / 2) * box.height };
  }

  /** Where a point in the scan's axes lies in the window. */
  inWindow(point: Vec3): { x: number; y: number } {
    const box = this.host.getBoundingClientRect();
    const at = this.upright.localToWorld(new Vector3(...point)).project(this.camera);
    return { x: box.left + ((at.x + 1) / 2) * box.width, y: box.top + ((1 - at.y) / 2) * box.height };
  }

  lightMuscles(names: ReadonlySet<string>): void {
    this.lit = names;
    for (const body of this.bodies) body.lightMuscles(names);
    this.queue();
  }

  get overlays(): Overlay[] {
    return this.body(0).overlays;
  }

  /** `playing`: another frame is to follow at once. */
  moveTo(frame: number, playing: boolean): void {
    if (frame !== this.frame) this.live = null;
    this.frame = frame;
    this.playing = playing;
    this.touch();
  }

  paintAs(painting: Painting): void {
    this.painting = painting;
    const { scale } = painting;
    if (scale) this.materials.useRamp(scale.ramp);
    // A map is read by its colour: less shading, more light from everywhere.
    this.sky.intensity = scale ? 2.35 : 1.0;
    this.sky.groundColor.set(scale ? '#cdc8c2' : '#8a7f78');
    for (const { light, onSkin, onMap } of this.lights) light.intensity = scale ? onMap : onSkin;
    this.touch();
  }

  /** Where the line between two faces in one place lies: 0 is the left edge, 1 the right. */
  setWipe(share: number): void {
    this.wipe = share;
    this.queue();
  }

  showOverlay(name: OverlayName, visible: boolean): void {
    if (visible) this.visibleOverlays.add(name);
    else this.visibleOverlays.delete(name);
    for (const body of this.bodies) body.showOverlay(name, visible);
    this.queue();
  }

  lookFrom(view: View): void {
    const yaw = radians(yawDegrees[view]);
    const from = new Vector3(Math.sin(yaw), 0.04, Math.cos(yaw)).normalize();
    this.camera.position.copy(this.centre).addScaledVector(from, this.fitting());
    this.controls.target.copy(this.centre);
    this.controls.update();
    this.queue();
  }

  /** Walks around the face, to its left and up. */
  turn(yaw: number, pitch: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const at = new Spherical().setFromVector3(offset);
    at.theta += radians(yaw);
    at.phi = Math.min(Math.max(at.phi - radians(pitch), 0.05), Math.PI - 0.05);
    this.camera.position.copy(this.controls.target).add(offset.setFromSpherical(at));
    this.controls.update();
    this.queue();
  }

  zoom(factor: number): void {
    const { target } = this.controls;
    this.camera.position.sub(target).divideScalar(factor).add(target);
    this.controls.update();
    this.queue();
  }

  /** After each picture, while the canvas still holds it. */
  onDraw(drawn: () => void): Undo {
    return this.drawn.add(drawn);
  }

  /** What of the skin is seen at a place in the window. */
  placeAt(clientX: number, clientY: number): Place | null {
    const box = this.host.getBoundingClientRect();
    const x = clientX - box.left;
    const passes = this.passes();
    const side = passes.findIndex(({ from, to }) => x >= from && x < to);
    if (side < 0) return null;
    const pass = passes[side];
    const vertex = pass.body.vertexAt(this.rayAt(clientX, clientY, pass));
    return vertex === null ? null : { vertex, side };
  }

  private rayAt(clientX: number, clientY: number, pass: Pass): Raycaster {
    const box = this.host.getBoundingClientRect();
    const ray = new Raycaster();
    const at = new Vector2((2 * (clientX - box.left - pass.x)) / pass.width - 1, 1 - (2 * (clientY - box.top)) / box.height);
    ray.setFromCamera(at, this.camera);
    return ray;
  }

  /** Where a vertex lies in the stage now, in its pixels; null outside its part. */
  whereIs({ vertex, side }: Place): { x: number; y: number } | null {
    const passes = this.passes();
    const { body, x: left, width } = passes[side] ?? passes[0];
    const at = body.mesh.localToWorld(body.positionOf(vertex)).project(this.camera);
    if (Math.abs(at.x) > 1 || Math.abs(at.y) > 1) return null;
    return { x: left + ((at.x + 1) / 2) * width, y: ((1 - at.y) / 2) * this.host.clientHeight };
  }

  /** Of the faces shown, left one first. */
  figuresAt(vertex: number): { displacementMm: number; share: number }[] {
    return this.passes().map(({ body }) => body.figuresOf(vertex));
  }

  /** What is shown, `scale` pixels for each of the page's. */
  snapshot(scale: number): HTMLCanvasElement {
    const before = this.renderer.getPixelRatio();
    const { clientWidth: width, clientHeight: height } = this.host;
    // Where edges are not smoothed, twice the pixels in each direction make them smooth.
    const finer = this.software ? 2 * scale : scale;
    const most = this.renderer.capabilities.maxTextureSize / Math.max(width, height);
    this.renderer.setPixelRatio(Math.min(finer, most));
    this.draw();
    const copy = document.createElement('canvas');
    copy.width = Math.round(scale * width);
    copy.height = Math.round(scale * height);
    const context = copy.getContext('2d')!;
    context.imageSmoothingQuality = 'high';
    context.drawImage(this.canvas, 0, 0, copy.width, copy.height);
    this.renderer.setPixelRatio(before);
    this.draw();
    return copy;
  }

  /** Draws what lies about a place of the stage, in its pixels, `zoom` times as large into a square of `size`, with a
   *  cross in its middle. Of the one face that is shown. */
  magnify(x: number, y: number, size: number, zoom: number, into: HTMLCanvasElement): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    const half = size / (2 * zoom);
    const ratio = Math.min(window.devicePixelRatio, 2);
    into.width = into.height = Math.round(size * ratio);
    into.style.width = into.style.height = `${size}px`;
    this.camera.setViewOffset(width, height, x - half, y - half, 2 * half, 2 * half);
    const side = Math.min(size, width, height);
    for (const body of this.bodies) body.coarse = false;
    this.renderer.setScissorTest(false);
    this.renderer.clear();
    this.renderer.setViewport(0, 0, side, side);
    this.renderer.render(this.scene, this.camera);
    const pen = into.getContext('2d')!;
    const drawn = side * this.renderer.getPixelRatio();
    pen.drawImage(this.canvas, 0, this.canvas.height - drawn, drawn, drawn, 0, 0, into.width, into.height);
    this.camera.clearViewOffset();
    this.draw();
    const [middle, arm] = [into.width / 2, 9 * ratio];
    for (const [colour, wide] of [['#000a', 3], ['#fff', 1.2]] as const) {
      pen.strokeStyle = colour;
      pen.lineWidth = wide * ratio;
      pen.beginPath();
      for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
        pen.moveTo(middle + 0.35 * arm * dx, middle + 0.35 * arm * dy);
        pen.lineTo(middle + arm * dx, middle + arm * dy);
      }
      pen.stroke();
    }
  }

  private body(i: number): FaceBody {
    if (!this.bodies[i]) {
      const body = new FaceBody(this.replay, this.motion, this.replay.faces[0], this.materials);
      this.bodies[i] = body;
      this.upright.add(body.object);
      for (const name of this.visibleOverlays) body.showOverlay(name, true);
      body.lightMuscles(this.lit);
    }
    return this.bodies[i];
  }

  private addLights(): void {
    const rig = new Group(); // goes with the camera, so that every side is lit alike
    const add = (colour: string, onSkin: number, onMap: number, x: number, y: number, z: number) => {
      const light = new DirectionalLight(new Color(colour), onSkin);
      light.position.set(x, y, z);
      rig.add(light, light.target);
      this.lights.push({ light, onSkin, onMap });
    };
    add('#fff6ec', 2.0, 1.3, -0.8, 0.9, 1.0);
    add('#dfe9ff', 0.7, 0.5, 1.2, 0.1, 0.6);
    add('#ffffff', 0.6, 0.4, 0.2, 1.0, -0.9);
    this.camera.add(rig);
    this.scene.add(this.camera, this.sky);
  }

  /** Room for the face at rest and where any moves farthest: a dropped jaw must not leave the picture. */
  private measure(): void {
    const body = this.body(0);
    this.upright.updateMatrixWorld(true);
    const box = new Box3();
    const include = () => box.union(new Box3().setFromObject(body.mesh, true));
    body.moveTo(this.replay.faces[0], 0);
    include();
    for (const face of this.replay.faces) {
      body.moveTo(face, this.replay.peakFrame);
      include();
    }
    box.getCenter(this.centre);
    box.getSize(this.size);
  }

  /** How far the camera must be for the face to fill its part of the stage. */
  private fitting(): number {
    const half = Math.max(this.size.y, this.size.x / Math.max(this.camera.aspect, 0.1)) / 2;
    return (1.06 * half) / Math.tan(radians(this.camera.fov) / 2) + this.size.z / 4;
  }

  /** After the stage or its parts have another size: nearer or farther, but seen from where it was. */
  private refit(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(this.ratio);
    this.renderer.setSize(width, height, false);
    const before = this.fitting();
    this.camera.aspect = (this.shown.mode === 'side-by-side' ? width / 2 : width) / height;
    this.camera.updateProjectionMatrix();
    this.zoom(before / this.fitting());
  }

  private loadTexture(): void {
    if (!this.replay.texture) return;
    // Texture coordinates count from the picture's top, as in glTF: no flip.
    void createImageBitmap(this.replay.texture.image, { colorSpaceConversion: 'none' }).then((image) => {
      if (this.disposed) return;
      const texture = new Texture(image);
      texture.flipY = false;
      texture.colorSpace = SRGBColorSpace;
      texture.anisotropy = this.renderer.capabilities.getMaxAnisotropy();
      texture.needsUpdate = true;
      this.materials.useTexture(texture);
      this.queue();
    });
  }

  private passes(): Pass[] {
    const width = this.host.clientWidth;
    const all = { x: 0, width, from: 0, to: width };
    if (this.shown.mode === 'single') return [{ body: this.body(0), ...all }];
    const [left, right] = [this.body(0), this.body(1)];
    if (this.shown.mode === 'wipe') {
      const line = Math.round(this.wipe * width);
      return [{ body: left, ...all, to: line }, { body: right, ...all, from: line }];
    }
    const half = Math.floor(width / 2);
    return [
      { body: left, x: 0, width: half, from: 0, to: half },
      { body: right, x: width - half, width: half, from: width - half, to: width },
    ];
  }

  /** `coarse`: with few triangles. */
  private draw(coarse = false): void {
    const passes = this.passes();
    const bodies = passes.map(({ body }) => body);
    for (const body of bodies) body.coarse = coarse;
    // Their normals are those of the picture before.
    this.stale ||= this.coarse !== coarse && bodies.some((body) => body.coarsens);
    this.coarse = coarse;
    if (this.stale || this.liveStale) {
      this.stale = this.liveStale = false;
      const { faces } = this.replay;
      const { live } = this;
      this.shown.visible.forEach((face, i) =>
        bodies[i].moveTo(faces[face], this.frame, live?.face === face ? live.displacement : null));
      bodies.forEach((body, i) => body.paint(this.painting, bodies[1 - i] ?? null));
    }
    this.renderer.setScissorTest(false);
    this.renderer.clear();
    for (const pass of passes) this.drawPass(pass);
    this.whole = true;
    this.drawn.tell();
  }

  /** What is live again, where all else is as it was drawn; false: all must be drawn. */
  private drawLive(): boolean {
    const { live, shown, painting } = this;
    if (!this.software || !live || this.stale || !this.whole || painting.together) return false;
    const at = shown.visible.indexOf(live.face);
    if (at < 0 || at !== shown.visible.lastIndexOf(live.face)) return false;
    const pass = this.passes()[at];
    this.liveStale = false;
    pass.body.coarse = true;
    pass.body.moveTo(this.replay.faces[live.face], this.frame, live.displacement);
    pass.body.paint(painting, null);
    this.drawPass(pass, true);
    this.drawn.tell();
    return true;
  }

  private drawPass({ body, x, width, from, to }: Pass, clear = false): void {
    if (to <= from) return;
    const height = this.host.clientHeight;
    for (const other of this.bodies) other.object.visible = other === body;
    this.renderer.setScissorTest(true);
    this.renderer.setViewport(x, 0, width, height);
    this.renderer.setScissor(from, 0, to - from, height);
    if (clear) this.renderer.clear();
    this.renderer.render(this.scene, this.camera);
  }

  private touch(): void {
    this.stale = true;
    this.queue();
  }

  private queue(): void {
    this.whole = false;
    if (this.queued) return;
    this.canvas.dataset.atRest = 'false';
    this.queued = requestAnimationFrame(() => {
      this.queued = 0;
      this.show();
    });
  }

  /** A picture in motion, and soon after the last one that at rest. */
  private show(): void {
    if (this.disposed) return;
    const before = performance.now();
    this.canvas.dataset.atRest = 'false';
    if (this.renderer.getPixelRatio() !== this.ratio) {
      this.renderer.setPixelRatio(this.ratio);
      this.whole = false;
    }
    if (!this.drawLive()) this.draw(this.software);
    this.canvas.dataset.atRest = String(!this.software);
    if (this.software) this.refineAtRest(before - this.drawnAt);
    // For whoever watches from outside: what was drawn, and what it took.
    this.canvas.dataset.frame = this.frame.toFixed(3);
    this.canvas.dataset.faces = this.shown.visible.join(' ');
    this.canvas.dataset.drawMs = (performance.now() - before).toFixed(2);
  }

  private get ratio(): number {
    if (!this.software) return Math.min(window.devicePixelRatio, 2);
    return this.slow < 3 && !this.streaming ? 1 : 0.7;
  }

  /** `gap`: since the picture before, ms. */
  private refineAtRest(gap: number): void {
    this.drawnAt += gap;
    // Once they come late, pictures in motion stay coarse: going back and forth would show.
    const moving = this.playing || this.live !== null;
    if (this.slow < 3) this.slow = moving && gap > 50 && gap < 400 ? this.slow + 1 : 0;
    clearTimeout(this.rest);
    if (this.playing) return;
    this.rest = window.setTimeout(() => {
      if (this.queued) return;
      this.renderer.setPixelRatio(2);
      this.draw();
      this.whole = false; // the next one has other pixels
      this.canvas.dataset.atRest = 'true';
    }, this.live ? 700 : 150); // a hand that rests on a slider goes on soon
  }
}
