// SPDX-License-Identifier: GPL-3.0-or-later
// Geodesic distances on the skin, which is open between lips and lids: the other lip is near in a straight line and far
// along the skin. Fast marching (Kimmel and Sethian 1998): a front that crosses each triangle as a wave from a point
// would, exact on flat parts.
import type { Vec3 } from '../replay/data';
import type { SkinHit } from '../replay/face/face_body';

/** Vertices nearer than this are merged, metres. */
const sameM = 1e-7;

/** The least distance first. */
class Front {
  private readonly vertex: number[] = [];
  private readonly far: number[] = [];

  get empty(): boolean {
    return this.vertex.length === 0;
  }

  push(vertex: number, far: number): void {
    let i = this.vertex.length;
    while (i > 0) {
      const up = (i - 1) >> 1;
      if (this.far[up] <= far) break;
      this.vertex[i] = this.vertex[up];
      this.far[i] = this.far[up];
      i = up;
    }
    this.vertex[i] = vertex;
    this.far[i] = far;
  }

  pop(): { vertex: number; far: number } {
    const least = { vertex: this.vertex[0], far: this.far[0] };
    const vertex = this.vertex.pop()!;
    const far = this.far.pop()!;
    const count = this.vertex.length;
    if (count === 0) return least;
    let i = 0;
    for (;;) {
      let down = 2 * i + 1;
      if (down >= count) break;
      if (down + 1 < count && this.far[down + 1] < this.far[down]) ++down;
      if (this.far[down] >= far) break;
      this.vertex[i] = this.vertex[down];
      this.far[i] = this.far[down];
      i = down;
    }
    this.vertex[i] = vertex;
    this.far[i] = far;
    return least;
  }
}

/** What lies within some distance of a place. */
export interface Reach {
  vertices: number[];
  /** Metres along the skin, of each. */
  far: number[];
}

export class SkinWalk {
  /** Per vertex, the first vertex at the same place. */
  private readonly same: Int32Array;
  private readonly copies = new Map<number, number[]>();
  /** Triangles of each vertex: `around[start[v]]` up to `around[start[v + 1]]`. */
  private readonly start: Int32Array;
  private readonly around: Int32Array;
  private readonly distance: Float64Array;

  /** `scanVertices`: number of the scan's own vertices, which come first; those that a cut along the lips added are
   *  never merged. `cut`: the line of that cut. */
  constructor(
    private readonly points: Float32Array, private readonly triangles: Int32Array, scanVertices: number, cut: Vec3[],
  ) {
    const count = points.length / 3;
    this.same = this.join(scanVertices, cut);
    this.start = new Int32Array(count + 1);
    for (const v of triangles) ++this.start[this.same[v] + 1];
    for (let v = 0; v < count; ++v) this.start[v + 1] += this.start[v];
    this.around = new Int32Array(triangles.length);
    const next = this.start.slice();
    for (let i = 0; i < triangles.length; ++i) this.around[next[this.same[triangles[i]]]++] = Math.floor(i / 3);
    this.distance = new Float64Array(count).fill(Infinity);
  }

  private join(scanVertices: number, cut: Vec3[]): Int32Array {
    const { points } = this;
    const count = points.length / 3;
    const key = (p: ArrayLike<number>, at = 0) => [0, 1, 2].map((k) => Math.round(p[at + k] / sameM)).join();
    const apart = new Set(cut.map((p) => key(Float32Array.from(p))));
    const first = new Map<string, number>();
    const same = new Int32Array(count);
    for (let v = 0; v < count; ++v) {
      same[v] = v;
      if (v >= scanVertices) continue;
      const place = key(points, 3 * v);
      const other = first.get(place);
      if (other === undefined) first.set(place, v);
      else if (!apart.has(place)) {
        same[v] = other;
        this.copies.set(other, [...(this.copies.get(other) ?? [other]), v]);
      }
    }
    return same;
  }

  /** All vertices within `radiusM` of a place, along the skin. */
  reach({ vertices, weights }: SkinHit, radiusM: number): Reach {
    const { distance, points, same } = this;
    const found: Reach = { vertices: [], far: [] };
    const front = new Front();
    const touched: number[] = [];
    const reached = (v: number, far: number) => {
      if (far >= distance[v] || far > radiusM) return;
      if (distance[v] === Infinity) touched.push(v);
      distance[v] = far;
      front.push(v, far);
    };
    const at = [0, 1, 2].map((k) => vertices.reduce((sum, v, i) => sum + weights[i] * points[3 * v + k], 0));
    for (const v of vertices)
      reached(same[v], Math.hypot(points[3 * v] - at[0], points[3 * v + 1] - at[1], points[3 * v + 2] - at[2]));
    const done = new Set<number>();
    while (!front.empty) {
      const { vertex, far } = front.pop();
      if (done.has(vertex) || far > distance[vertex]) continue;
      done.add(vertex);
      for (let i = this.start[vertex]; i < this.start[vertex + 1]; ++i) this.cross(3 * this.around[i], vertex, done, reached);
    }
    for (const v of touched) {
      for (const copy of this.copies.get(v) ?? [v]) {
        found.vertices.push(copy);
        found.far.push(distance[v]);
      }
      distance[v] = Infinity;
    }
    return found;
  }

  /** Advances the front from `vertex` over one of its triangles. */
  private cross(triangle: number, vertex: number, done: Set<number>, reached: (v: number, far: number) => void): void {
    const { same, triangles } = this;
    const corners = [0, 1, 2].map((k) => same[triangles[triangle + k]]);
    const [b, c] = corners.filter((v) => v !== vertex);
    if (c === undefined) return;
    for (const [to, third] of [[b, c], [c, b]]) {
      if (done.has(to)) continue;
      reached(to, this.distance[vertex] + this.edge(vertex, to));
      if (done.has(third)) reached(to, this.over(vertex, third, to));
    }
  }

  private edge(a: number, b: number): number {
    const p = this.points;
    return Math.hypot(p[3 * a] - p[3 * b], p[3 * a + 1] - p[3 * b + 1], p[3 * a + 2] - p[3 * b + 2]);
  }

  /** From a point beyond the edge of a and b, whose distances are known, to c across the triangle. */
  private over(a: number, b: number, c: number): number {
    const { distance } = this;
    const [ab, ac, bc] = [this.edge(a, b), this.edge(a, c), this.edge(b, c)];
    if (!(ab > 0)) return Infinity;
    // a at (0, 0), b at (ab, 0), c above, the point below.
    const cx = (ac * ac - bc * bc + ab * ab) / (2 * ab);
    const cy = Math.sqrt(Math.max(ac * ac - cx * cx, 0));
    const px = (distance[a] ** 2 - distance[b] ** 2 + ab * ab) / (2 * ab);
    const below = distance[a] ** 2 - px * px;
    if (below < 0) return Infinity; // the edges give the distance
    const py = -Math.sqrt(below);
    const through = px + ((cx - px) * -py) / (cy - py || 1e-30);
    return through >= 0 && through <= ab ? Math.hypot(cx - px, cy - py) : Infinity;
  }
}
