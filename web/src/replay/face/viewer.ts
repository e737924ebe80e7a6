// SPDX-License-Identifier: GPL-3.0-or-later
// The face in 3D, or two of them: beside each other, or in one place and divided by a vertical line. One camera for
// both. Draws only when something changed, and deforms only what is drawn.
import { Box3, Group, NoToneMapping, type Object3D, Scene, SRGBColorSpace, Texture, WebGLRenderer } from 'three';
import type { Painting } from './colouring';
import type { Replay } from '../data';
import { SceneMotion } from './deform';
import { FaceBody, FaceMaterials } from './face_body';
import { uprightFromScan } from './face_frame';
import type { Overlay, OverlayName } from './overlays';
import { Picking, type Pass } from './picking';
import { PicturePace } from './picture_pace';
import type { Shown } from '../shown';
import { sideMarks, type SideMark } from './side_marks';
import { StageLights } from './stage_lights';
import { ViewCamera } from './view_camera';
import { Listeners, Undoing, type Undo } from '../../page/listeners';

/** What may be shown over a face. */
export interface Marks {
  object: Object3D;
  dispose(): void;
}

export class FaceViewer {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  /** How one moves around the face. */
  readonly view: ViewCamera;
  /** Places on the skin and in the window. */
  readonly pick: Picking;
  private readonly motion: SceneMotion;
  private readonly materials: FaceMaterials;
  private readonly upright = new Group();
  /** The second is made when two faces are first shown. */
  private readonly bodies: FaceBody[] = [];
  private readonly lights: StageLights;
  private readonly visibleOverlays = new Set<OverlayName>();
  private frame = 0;
  private playing = false;
  private wipe = 0.5;
  private stale = true; // shapes are not those of `frame` and `shown`
  private queued = 0;
  /** The canvas holds a picture drawn since the page was last put on the screen. */
  private fresh = false;
  private whole = false; // only the live shape has changed since the last picture
  private liveStale = false; // the live shape alone has changed
  private coarse = false; // the last picture was drawn with few triangles
  private disposed = false;
  readonly pace = new PicturePace();
  private readonly drawn = new Listeners();
  private lit: ReadonlySet<string> = new Set();
  /** The shape of a face at this instant, instead of that of its motion. */
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
    // Keeps the picture, so that of two faces only the changed one is drawn again.
    const { software } = this.pace;
    this.renderer = new WebGLRenderer({ canvas, antialias: !software, alpha: true, preserveDrawingBuffer: software });
    this.renderer.toneMapping = NoToneMapping;
    this.renderer.setClearColor(0, 0);
    this.renderer.autoClear = false;
    this.motion = new SceneMotion(replay);
    this.materials = new FaceMaterials(replay);
    this.upright.quaternion.copy(uprightFromScan(replay));
    this.scene.add(this.upright);
    this.loadTexture();
    this.view = new ViewCamera(canvas, this.room(), () => this.queue());
    this.scene.add(this.view.camera);
    this.lights = new StageLights(this.view.camera, this.scene);
    this.pick = new Picking(host, this.view.camera, this.upright, () => this.passes());
    this.paintAs(painting);
    this.view.lookFrom('front');
    const unfollow = shown.onChange(() => {
      this.refit();
      this.markStale();
    });
    const sizes = new ResizeObserver(() => this.refit());
    sizes.observe(host);
    this.undoing.add(unfollow, () => sizes.disconnect());
    this.refit();
  }

  /** After the replay's motion has changed. The camera stays. */
  refresh(): void {
    this.motion.forget();
    this.live = null;
    for (const body of this.bodies) {
      body.makeOverlays();
      body.lightMuscles(this.lit);
    }
    this.markStale();
  }

  /** Frees everything. The canvas cannot be drawn to any more. */
  dispose(): void {
    this.undoing.undo();
    this.disposed = true;
    this.pace.stop();
    this.view.controls.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  /** Shows a shape of a face, in metres from rest, until the next motion or null. `streaming`: more shapes follow as
   *  fast as they are drawn, computed on the same processor. */
  showLive(live: { face: number; displacement: Float32Array } | null, streaming = false): void {
    this.pace.streaming = streaming && live !== null;
    if (!live && !this.live) return;
    const same = live?.face === this.live?.face;
    this.live = live;
    if (!live || this.fresh || document.hidden) {
      this.markStale();
      return;
    }
    // Drawn now for the next frame, instead of in it: saves up to one frame of delay.
    this.stale ||= !same;
    this.liveStale = true;
    cancelAnimationFrame(this.queued);
    this.queued = 0;
    this.fresh = true;
    requestAnimationFrame(() => (this.fresh = false));
    this.show();
  }

  /** Whether these marks are shown. */
  shows(marks: Marks): boolean {
    return this.marks === marks;
  }

  /** Shows marks over the last face shown, in the scan's axes, until null. */
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
    this.view.controls.enabled = on;
  }

  lightMuscles(names: ReadonlySet<string>): void {
    this.lit = names;
    for (const body of this.bodies) body.lightMuscles(names);
    this.queue();
  }

  get overlays(): Overlay[] {
    return this.body(0).overlays;
  }

  /** `playing`: another frame follows at once. */
  moveTo(frame: number, playing: boolean): void {
    if (frame !== this.frame) this.live = null;
    this.frame = frame;
    this.playing = playing;
    this.markStale();
  }

  paintAs(painting: Painting): void {
    this.painting = painting;
    const { scale } = painting;
    if (scale) this.materials.useRamp(scale.ramp);
    this.lights.light(scale ? 'map' : 'skin');
    this.markStale();
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

  /** After each picture, while the canvas still holds it. */
  onDraw(drawn: () => void): Undo {
    return this.drawn.add(drawn);
  }

  /** Where the subject's own sides lie in the picture drawn last. */
  get sideMarks(): SideMark[] {
    const places = this.shown.mode === 'side-by-side' ? this.passes() : this.passes().slice(0, 1);
    return places.flatMap(({ x, width }) => sideMarks(this.view.camera, x, width, this.host.clientHeight));
  }

  /** Figures of the faces shown, left one first. */
  figuresAt(vertex: number): { displacementMm: number; share: number }[] {
    return this.passes().map(({ body }) => body.figuresOf(vertex));
  }

  /** What is shown, `scale` pixels for each of the page's. `streaming`: more follow, then the page's own. */
  snapshot(scale: number, streaming = false): HTMLCanvasElement {
    const before = this.renderer.getPixelRatio();
    const { clientWidth: width, clientHeight: height } = this.host;
    // Where edges are not smoothed, more pixels in each direction make them smooth.
    const finer = this.pace.software ? (streaming ? 1.5 : 2) * scale : scale;
    const most = this.renderer.capabilities.maxTextureSize / Math.max(width, height);
    this.renderer.setPixelRatio(Math.min(finer, most));
    this.draw();
    const copy = document.createElement('canvas');
    [copy.width, copy.height] = [Math.round(scale * width), Math.round(scale * height)];
    const context = copy.getContext('2d')!;
    context.imageSmoothingQuality = 'high';
    context.drawImage(this.canvas, 0, 0, copy.width, copy.height);
    if (streaming) {
      cancelAnimationFrame(this.queued); // this was its picture
      this.queued = 0;
      return copy;
    }
    this.renderer.setPixelRatio(before);
    this.draw();
    return copy;
  }

  /** Draws the surroundings of a place of the stage, in its pixels, magnified `zoom` times into a square of `size`
   *  pixels. Of the single face shown. */
  magnify(x: number, y: number, size: number, zoom: number, into: HTMLCanvasElement): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    const { camera } = this.view;
    const half = size / (2 * zoom);
    camera.setViewOffset(width, height, x - half, y - half, 2 * half, 2 * half);
    const side = Math.min(size, width, height);
    for (const body of this.bodies) body.coarse = false;
    this.renderer.setScissorTest(false);
    this.renderer.clear();
    this.renderer.setViewport(0, 0, side, side);
    this.renderer.render(this.scene, camera);
    const drawn = side * this.renderer.getPixelRatio();
    into.getContext('2d')!.drawImage(this.canvas, 0, this.canvas.height - drawn, drawn, drawn, 0, 0, into.width, into.height);
    camera.clearViewOffset();
    this.draw();
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

  /** The box around the face at rest and at the peak of each face: a dropped jaw must not leave the picture. */
  private room(): Box3 {
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
    return box;
  }

  /** After the stage or its parts have changed size. */
  private refit(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(this.pace.ratio);
    this.renderer.setSize(width, height, false);
    this.view.zoomsAtPointer = this.shown.mode !== 'side-by-side';
    this.view.fit((this.shown.mode === 'side-by-side' ? width / 2 : width) / height);
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
    passes.forEach((pass, i) => this.drawPass(pass, i === passes.length - 1));
    this.whole = true;
    this.drawn.notify();
  }

  /** Draws only the face with the live shape, if nothing else has changed; false: all must be drawn. */
  private drawLive(): boolean {
    const { live, shown, painting } = this;
    if (!this.pace.software || !live || this.stale || !this.whole || painting.together) return false;
    const at = shown.visible.indexOf(live.face);
    if (at < 0 || at !== shown.visible.lastIndexOf(live.face)) return false;
    const pass = this.passes()[at];
    this.liveStale = false;
    pass.body.coarse = true;
    pass.body.moveTo(this.replay.faces[live.face], this.frame, live.displacement);
    pass.body.paint(painting, null);
    this.drawPass(pass, at === this.passes().length - 1, true);
    this.drawn.notify();
    return true;
  }

  private drawPass({ body, x, width, from, to }: Pass, last: boolean, clear = false): void {
    if (to <= from) return;
    const height = this.host.clientHeight;
    for (const other of this.bodies) other.object.visible = other === body;
    if (this.marks) this.marks.object.visible = last;
    this.renderer.setScissorTest(true);
    this.renderer.setViewport(x, 0, width, height);
    this.renderer.setScissor(from, 0, to - from, height);
    if (clear) this.renderer.clear();
    this.renderer.render(this.scene, this.view.camera);
  }

  private markStale(): void {
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

  /** Draws a picture in motion and, soon after the last one, a picture at rest. */
  private show(): void {
    if (this.disposed) return;
    const { software, ratio } = this.pace;
    const before = performance.now();
    this.canvas.dataset.atRest = 'false';
    if (this.renderer.getPixelRatio() !== ratio) {
      this.renderer.setPixelRatio(ratio);
      this.whole = false;
    }
    if (!this.drawLive()) this.draw(software);
    this.canvas.dataset.atRest = String(!software);
    if (software) this.pace.drawn(before, this.playing, this.live !== null, () => this.refine());
    // For tests: what was drawn, and how long it took.
    this.canvas.dataset.frame = this.frame.toFixed(3);
    this.canvas.dataset.faces = this.shown.visible.join(' ');
    this.canvas.dataset.drawMs = (performance.now() - before).toFixed(2);
  }

  /** Draws the picture at rest, with all pixels. */
  private refine(): void {
    if (this.queued) return;
    this.renderer.setPixelRatio(this.pace.fineRatio);
    this.draw();
    this.whole = false; // the next one has other pixels
    this.canvas.dataset.atRest = 'true';
  }
}
