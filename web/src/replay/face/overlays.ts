// SPDX-License-Identifier: GPL-3.0-or-later
// What can be shown over the skin: the cut along the lips, driven points, those on bone and border, muscles.
import {
  BufferAttribute, BufferGeometry, Color, DoubleSide, Group, InstancedMesh, Matrix4, Mesh, MeshBasicMaterial, Object3D,
  SphereGeometry,
} from 'three';
import { Line2 } from 'three/examples/jsm/lines/Line2.js';
import { LineGeometry } from 'three/examples/jsm/lines/LineGeometry.js';
import { LineSegments2 } from 'three/examples/jsm/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/examples/jsm/lines/LineSegmentsGeometry.js';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import type { Face, Muscles, Replay, Vec3 } from '../data';
import { activeLines } from './active_muscles';
import { nearestVertex } from './deform';

export type OverlayName = 'cut' | 'driven' | 'held' | 'muscles';

export interface Overlay {
  name: OverlayName;
  label: string;
  colour: string;
  /** What its colours mean. */
  legend?: string;
  object: Object3D;
  /** Follow the skin's displacement (metres, x y z a vertex) of a face in a frame, which may lie between two. */
  follow(displacement: Float32Array, face: Face, frame: number): void;
}

const drawnLast = { depthTest: false, depthWrite: false, transparent: true };

function spheres(points: Vec3[], radius: number, colour: string, opacity: number): InstancedMesh {
  const material = new MeshBasicMaterial({ color: colour, opacity, ...drawnLast });
  const mesh = new InstancedMesh(new SphereGeometry(radius, 16, 12), material, points.length);
  points.forEach((p, i) => mesh.setMatrixAt(i, new Matrix4().setPosition(...p)));
  mesh.frustumCulled = false;
  mesh.renderOrder = 2;
  return mesh;
}

function drivenOverlay(replay: Replay): Overlay {
  const colour = '#e8453c';
  const { points } = replay.driven;
  const mesh = spheres(points, 0.0016, colour, 0.95);
  const vertex = points.map((p) => nearestVertex(replay.points, p).vertex);
  const matrix = new Matrix4();
  return {
    name: 'driven', label: 'Driven points', colour, object: mesh,
    follow(d) {
      points.forEach((p, i) => {
        const v = 3 * vertex[i];
        mesh.setMatrixAt(i, matrix.setPosition(p[0] + d[v], p[1] + d[v + 1], p[2] + d[v + 2]));
      });
      mesh.instanceMatrix.needsUpdate = true;
    },
  };
}

function heldOverlay(replay: Replay): Overlay {
  const colour = '#3b82d6';
  const mesh = spheres(replay.held, 0.0008, colour, 0.6);
  return { name: 'held', label: 'On bone and border', colour, object: mesh, follow() {} };
}

/** Both lips of the cut: the scan's own vertices along it, and those that the cut appended. */
function cutOverlay(replay: Replay): Overlay {
  const colour = '#ff9f1c';
  const count = replay.points.length / 3;
  const material = new LineMaterial({ color: new Color(colour).getHex(), linewidth: 3, ...drawnLast });
  const group = new Group();
  const lips = [0, 1].map((side) => {
    const vertex = replay.lipCut.map((p) => {
      const own = nearestVertex(replay.points, p, 0, replay.scanVertices);
      if (side === 0 || replay.scanVertices >= count) return own.vertex;
      // The corners of the mouth have no second vertex.
      const added = nearestVertex(replay.points, p, replay.scanVertices);
      return added.distance < own.distance + 0.001 ? added.vertex : own.vertex;
    });
    const flat = new Float32Array(3 * vertex.length);
    const geometry = new LineGeometry();
    const line = new Line2(geometry, material);
    line.frustumCulled = false;
    line.renderOrder = 3;
    group.add(line);
    return { vertex, flat, geometry };
  });
  const follow = (d: Float32Array) => {
    for (const { vertex, flat, geometry } of lips) {
      replay.lipCut.forEach((p, i) => {
        for (let k = 0; k < 3; ++k) flat[3 * i + k] = p[k] + d[3 * vertex[i] + k];
      });
      geometry.setPositions(flat);
    }
  };
  follow(new Float32Array(replay.points.length));
  return { name: 'cut', label: 'Lip cut', colour, object: group, follow };
}

const muscleColour = '#b5179e';
/** 0.7 of the way to white, as in the picture of the muscles (src/hyperex/run/muscle_picture.cpp). */
const paleMuscle = '#e9b9e2';

/** Muscles that follow the skin. */
interface Carried {
  object: Object3D;
  follow(displacement: Float32Array): void;
  /** A colour for each muscle. */
  paint(colours: Color[]): void;
}

/** Moves places (into `flat`, x y z each) with the skin nearest to each, though deep muscles move less. So it shows their
 *  course, not their stretch. */
function carrier(replay: Replay, places: Vec3[], flat: Float32Array): (displacement: Float32Array) => void {
  let vertex: number[] | null = null; // found when first shown
  return (d) => {
    vertex ??= places.map((p) => nearestVertex(replay.points, p).vertex);
    places.forEach((p, i) => {
      for (let k = 0; k < 3; ++k) flat[3 * i + k] = p[k] + d[3 * vertex![i] + k];
    });
  };
}

/** Fans, of each its tip first; empty for a muscle without. */
function fansOver(replay: Replay, fans: Vec3[][]): Carried {
  const points = fans.flat();
  const flat = new Float32Array(points.flat());
  const geometry = new BufferGeometry();
  const position = new BufferAttribute(flat, 3);
  const colour = new BufferAttribute(new Float32Array(flat.length), 3);
  geometry.setAttribute('position', position);
  geometry.setAttribute('color', colour);
  let first = 0;
  geometry.setIndex(fans.flatMap((fan) => {
    const tip = first;
    first += fan.length;
    return fan.slice(2).flatMap((_, i) => [tip, tip + i + 1, tip + i + 2]);
  }));
  const object = new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true, side: DoubleSide, opacity: 0.3, ...drawnLast }));
  object.frustumCulled = false;
  object.renderOrder = 1; // under the lines
  const carry = carrier(replay, points, flat);
  return {
    object,
    follow(d) {
      carry(d);
      position.needsUpdate = true;
    },
    paint(colours) {
      colour.copyArray(fans.flatMap((fan, i) => fan.flatMap(() => colours[i].toArray())));
      colour.needsUpdate = true;
    },
  };
}

function linesOver(replay: Replay, lines: Vec3[][], linewidth: number): Carried {
  const ends = lines.flatMap((line) => line.slice(1).flatMap((p, i) => [line[i], p]));
  const flat = new Float32Array(ends.flat());
  const geometry = new LineSegmentsGeometry();
  geometry.setPositions(flat);
  const object = new LineSegments2(geometry, new LineMaterial({ vertexColors: true, linewidth, opacity: 0.85, ...drawnLast }));
  object.frustumCulled = false;
  object.renderOrder = 2;
  const carry = carrier(replay, ends, flat);
  return {
    object,
    follow(d) {
      carry(d);
      geometry.setPositions(flat);
    },
    paint(colours) {
      geometry.setColors(lines.flatMap((line, i) =>
        Array.from({ length: 2 * (line.length - 1) }, () => colours[i].toArray()).flat()));
    },
  };
}

/** Lines from origin to insertion, and sheets. Pale: what may be at rest in the frame shown. */
function muscleOverlay(replay: Replay, muscles: Muscles): Overlay {
  const { lines } = muscles;
  const parts = [linesOver(replay, lines.map(({ points }) => points), 2.5)];
  if (lines.some(({ sheet }) => sheet)) parts.unshift(fansOver(replay, lines.map(({ sheet }) => sheet ?? [])));
  const object = new Group().add(...parts.map((part) => part.object));
  const [full, pale] = [new Color(muscleColour), new Color(paleMuscle)];
  let painted = '';
  const paintActive = (active: boolean[]) => {
    const now = active.map(Number).join('');
    if (now === painted) return;
    painted = now;
    for (const part of parts) part.paint(active.map((on) => (on ? full : pale)));
  };
  paintActive(lines.map(() => true));
  return {
    name: 'muscles', label: 'Muscles', colour: muscleColour, object,
    legend: 'Pale: may be at rest. Full colour: the recording shows that it acts (95 %).',
    follow(displacement, face, frame) {
      paintActive(activeLines(muscles, face, replay.timeS, frame));
      for (const part of parts) part.follow(displacement);
    },
  };
}

/** Some muscles alone, to point at them; null where none has one of the names. */
export function litMuscles(replay: Replay, names: ReadonlySet<string>): Overlay | null {
  const colour = '#ffd60a';
  const lines = (replay.muscles?.lines ?? []).filter(({ name }) => names.has(name)).map(({ points }) => points);
  if (lines.length === 0) return null;
  const { object, follow, paint } = linesOver(replay, lines, 4);
  paint(lines.map(() => new Color(colour)));
  return { name: 'muscles', label: 'Muscles', colour, object, follow };
}

/** Removes an overlay and frees it. */
export function disposeOverlay({ object }: Overlay): void {
  object.removeFromParent();
  object.traverse((part) => {
    const { geometry, material } = part as Mesh;
    geometry?.dispose();
    for (const one of Array.isArray(material) ? material : [material]) one?.dispose();
  });
}

export function overlaysOf(replay: Replay): Overlay[] {
  const overlays: Overlay[] = [];
  if (replay.lipCut.length > 1) overlays.push(cutOverlay(replay));
  if (replay.driven.points.length > 0) overlays.push(drivenOverlay(replay));
  if (replay.held.length > 0) overlays.push(heldOverlay(replay));
  if (replay.muscles?.lines.length) overlays.push(muscleOverlay(replay, replay.muscles));
  return overlays;
}
