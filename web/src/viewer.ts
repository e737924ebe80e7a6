// SPDX-License-Identifier: GPL-3.0-or-later
// The face in 3D. Draws only when something changed.
import {
  Box3, BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, Group,
  HemisphereLight, Mesh, MeshStandardMaterial, NoToneMapping, PerspectiveCamera, Scene,
  SRGBColorSpace, Texture, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { linearOf, putColour } from './colour';
import type { Replay } from './data';
import { Deformer } from './deform';
import { uprightFromScan } from './face_frame';
import { overlaysOf, type Overlay, type OverlayName } from './overlays';

export type View = 'front' | 'three-quarter' | 'left' | 'right';
export type Colouring = 'displacement' | 'skin';

const yawDegrees: Record<View, number> = { front: 0, 'three-quarter': 38, left: 90, right: -90 };

export class FaceViewer {
  readonly overlays: Overlay[];
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(24, 1, 0.01, 10);
  private readonly controls: OrbitControls;
  private readonly deformer: Deformer;
  private readonly geometry = new BufferGeometry();
  private readonly mesh: Mesh<BufferGeometry, MeshStandardMaterial>;
  private readonly mapped = new MeshStandardMaterial({
    vertexColors: true, roughness: 0.5, metalness: 0, side: DoubleSide,
  });
  private readonly plain = new MeshStandardMaterial({
    color: '#dba58c', roughness: 0.55, metalness: 0, side: DoubleSide,
  });
  private readonly ownColours: Float32Array | null;
  private readonly sky = new HemisphereLight('#ffffff', '#8a7f78', 1);
  private readonly centre = new Vector3();
  private readonly size = new Vector3();
  private view: View = 'front';
  private colouring: Colouring = 'displacement';
  private frame = 0;
  private queued = false;

  /** Throws where the browser has no WebGL. */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly host: HTMLElement,
    private readonly replay: Replay,
    private readonly topMm: number,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.toneMapping = NoToneMapping;
    this.renderer.setClearColor(0, 0);
    this.deformer = new Deformer(replay);
    this.overlays = overlaysOf(replay);
    this.ownColours = this.scanColours();
    this.fillGeometry();
    this.mesh = new Mesh(this.geometry, this.mapped);
    this.mesh.frustumCulled = false;
    this.loadTexture();

    const upright = new Group();
    upright.quaternion.copy(uprightFromScan(replay));
    upright.add(this.mesh, ...this.overlays.map((o) => o.object));
    this.scene.add(upright);
    for (const overlay of this.overlays) overlay.object.visible = false;
    this.addLights();

    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener('change', () => this.queue());
    upright.updateMatrixWorld(true);
    // Room for the face at rest and where it moves farthest: a dropped jaw must not leave the picture.
    const box = new Box3().setFromObject(this.mesh, true);
    this.moveTo(replay.peakFrame);
    box.union(new Box3().setFromObject(this.mesh, true));
    box.getCenter(this.centre);
    box.getSize(this.size);
    new ResizeObserver(() => this.resize()).observe(host);
    this.resize();
    this.moveTo(0);
  }

  moveTo(frame: number): void {
    this.frame = frame;
    this.deformer.moveTo(frame);
    const map = this.replay.texture?.skinVertex;
    this.copyOut(this.deformer.position, 'position', map);
    this.copyOut(this.deformer.normal, 'normal', map);
    if (this.colouring === 'displacement') this.paintDisplacement();
    for (const overlay of this.overlays)
      if (overlay.object.visible) overlay.follow(this.deformer.displacement);
    this.queue();
  }

  setColouring(colouring: Colouring): void {
    this.colouring = colouring;
    if (colouring === 'displacement') {
      this.mesh.material = this.mapped;
      this.paintDisplacement();
    } else {
      this.mesh.material = this.plain;
      if (this.ownColours) this.setColours(this.ownColours);
    }
    // The map is read by colour: less shading, more light from everywhere.
    this.sky.intensity = colouring === 'displacement' ? 2.4 : 1.0;
    this.queue();
  }

  showOverlay(name: OverlayName, visible: boolean): void {
    for (const overlay of this.overlays) {
      if (overlay.name !== name) continue;
      overlay.object.visible = visible;
      if (visible) overlay.follow(this.deformer.displacement);
    }
    this.queue();
  }

  lookFrom(view: View): void {
    this.view = view;
    const halfHeight = Math.max(this.size.y, this.size.x / Math.max(this.camera.aspect, 0.1)) / 2;
    const distance =
      (1.06 * halfHeight) / Math.tan((this.camera.fov * Math.PI) / 360) + this.size.z / 4;
    const yaw = (yawDegrees[view] * Math.PI) / 180;
    const from = new Vector3(Math.sin(yaw), 0.04, Math.cos(yaw)).multiplyScalar(distance);
    this.camera.position.copy(this.centre).add(from);
    this.controls.target.copy(this.centre);
    this.controls.update();
    this.queue();
  }

  private addLights(): void {
    const rig = new Group(); // goes with the camera, so that every side is lit alike
    const light = (colour: string, intensity: number, x: number, y: number, z: number) => {
      const one = new DirectionalLight(new Color(colour), intensity);
      one.position.set(x, y, z);
      rig.add(one, one.target);
    };
    light('#fff6ec', 2.0, -0.8, 0.9, 1.0);
    light('#dfe9ff', 0.7, 1.2, 0.1, 0.6);
    light('#ffffff', 0.6, 0.2, 1.0, -0.9);
    this.camera.add(rig);
    this.scene.add(this.camera, this.sky);
  }

  private fillGeometry(): void {
    const texture = this.replay.texture;
    const count = texture ? texture.skinVertex.length : this.replay.points.length / 3;
    for (const name of ['position', 'normal', 'color'])
      this.geometry.setAttribute(name, new BufferAttribute(new Float32Array(3 * count), 3));
    if (texture) this.geometry.setAttribute('uv', new BufferAttribute(texture.uv, 2));
    const triangles = texture ? texture.triangles : this.replay.triangles;
    this.geometry.setIndex(new BufferAttribute(new Uint32Array(triangles), 1));
    this.copyOut(this.deformer.position, 'position', texture?.skinVertex);
  }

  private copyOut(from: Float32Array, name: string, map: Int32Array | undefined): void {
    const attribute = this.geometry.getAttribute(name) as BufferAttribute;
    const out = attribute.array as Float32Array;
    if (map) {
      for (let i = 0; i < map.length; ++i)
        for (let k = 0; k < 3; ++k) out[3 * i + k] = from[3 * map[i] + k];
    } else {
      out.set(from);
    }
    attribute.needsUpdate = true;
  }

  private paintDisplacement(): void {
    const d = this.deformer.displacement;
    const perTop = 1e3 / this.topMm;
    const map = this.replay.texture?.skinVertex;
    const colour = this.geometry.getAttribute('color') as BufferAttribute;
    const out = colour.array as Float32Array;
    for (let i = 0; i < colour.count; ++i) {
      const v = 3 * (map ? map[i] : i);
      putColour(perTop * Math.hypot(d[v], d[v + 1], d[v + 2]), out, 3 * i);
    }
    colour.needsUpdate = true;
  }

  private scanColours(): Float32Array | null {
    const { colour } = this.replay;
    if (!colour) return null;
    const out = new Float32Array((3 * colour.length) / 4);
    for (let v = 0; v < colour.length / 4; ++v)
      for (let k = 0; k < 3; ++k) out[3 * v + k] = linearOf(colour[4 * v + k]);
    this.plain.vertexColors = true;
    this.plain.color.set('#ffffff');
    return out;
  }

  private setColours(colours: Float32Array): void {
    const attribute = this.geometry.getAttribute('color') as BufferAttribute;
    (attribute.array as Float32Array).set(colours);
    attribute.needsUpdate = true;
  }

  private loadTexture(): void {
    if (!this.replay.texture) return;
    // Texture coordinates count from the picture's top, as in glTF: no flip.
    void createImageBitmap(this.replay.texture.image, { colorSpaceConversion: 'none' }).then((image) => {
      const texture = new Texture(image);
      texture.flipY = false;
      texture.colorSpace = SRGBColorSpace;
      texture.anisotropy = this.renderer.capabilities.getMaxAnisotropy();
      texture.needsUpdate = true;
      this.plain.map = texture;
      this.plain.color.set('#ffffff');
      this.plain.needsUpdate = true;
      this.queue();
    });
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    const before = this.camera.aspect;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (Math.abs(before - this.camera.aspect) > 1e-3) this.lookFrom(this.view);
    this.queue();
  }

  private queue(): void {
    if (this.queued) return;
    this.queued = true;
    requestAnimationFrame(() => {
      this.queued = false;
      this.renderer.render(this.scene, this.camera);
      this.canvas.dataset.frame = this.frame.toFixed(3);
    });
  }
}
