// SPDX-License-Identifier: GPL-3.0-or-later
// Fewer triangles over the same vertices, for pictures in motion where the processor draws them. Vertices are merged
// along edges into every few of them (a maximal independent set), so that surfaces that only touch, such as closed
// lips, stay separate; vertices on the rim of a mesh stay, so that holes keep their shape.
import { BufferAttribute, type BufferGeometry, type Mesh } from 'three';

type Triangles = ArrayLike<number>;

/** Per vertex the triangles around it: those of v are at[first[v]] to at[first[v + 1]], exclusive. */
function trianglesAround(triangles: Triangles, count: number): { first: Uint32Array; at: Uint32Array } {
  const first = new Uint32Array(count + 1);
  for (let i = 0; i < triangles.length; ++i) ++first[triangles[i] + 1];
  for (let v = 0; v < count; ++v) first[v + 1] += first[v];
  const at = new Uint32Array(triangles.length);
  const next = first.slice();
  for (let i = 0; i < triangles.length; ++i) at[next[triangles[i]]++] = Math.floor(i / 3);
  return { first, at };
}

/** About a quarter of the triangles; `count`: of the vertices. */
export function coarser(triangles: Triangles, count: number): Uint32Array<ArrayBuffer> {
  const { first, at } = trianglesAround(triangles, count);
  const seen = new Int32Array(count).fill(-1);
  const neighbours: number[] = [];
  const around = (v: number) => {
    neighbours.length = 0;
    for (let k = first[v]; k < first[v + 1]; ++k)
      for (let corner = 0; corner < 3; ++corner) {
        const w = triangles[3 * at[k] + corner];
        if (w === v || seen[w] === v) continue;
        seen[w] = v;
        neighbours.push(w);
      }
    return neighbours;
  };
  // Inside a surface a vertex has as many neighbours as triangles.
  const rim = new Uint8Array(count);
  for (let v = 0; v < count; ++v) rim[v] = around(v).length === first[v + 1] - first[v] ? 0 : 1;
  seen.fill(-1);
  const into = new Int32Array(count).fill(-1);
  for (let v = 0; v < count; ++v) {
    if (into[v] >= 0) continue;
    into[v] = v;
    if (rim[v]) continue;
    for (const w of around(v)) if (into[w] < 0 && !rim[w]) into[w] = v;
  }
  const out: number[] = [];
  for (let i = 0; i < triangles.length; i += 3) {
    const [a, b, c] = [into[triangles[i]], into[triangles[i + 1]], into[triangles[i + 2]]];
    if (a !== b && b !== c && c !== a) out.push(a, b, c);
  }
  return new Uint32Array(out);
}

/** Meshes that are drawn with all their triangles or with few. */
export class LevelOfDetail {
  private readonly meshes: { geometry: BufferGeometry; all: number; few: number }[] = [];

  /** Returns the remaining triangles, about a quarter per pass. */
  add({ geometry }: Mesh, passes: number): ArrayLike<number> {
    const all = geometry.getIndex()!.array;
    let few: Triangles = all;
    for (let pass = 0; pass < passes; ++pass) few = coarser(few, geometry.getAttribute('position').count);
    // Both lists in one buffer, so that switching costs nothing.
    const both = new Uint32Array(all.length + few.length);
    both.set(all);
    both.set(few, all.length);
    geometry.setIndex(new BufferAttribute(both, 1));
    geometry.setDrawRange(0, all.length);
    this.meshes.push({ geometry, all: all.length, few: few.length });
    return few;
  }

  use(few: boolean): void {
    for (const mesh of this.meshes)
      if (few) mesh.geometry.setDrawRange(mesh.all, mesh.few);
      else mesh.geometry.setDrawRange(0, mesh.all);
  }
}
