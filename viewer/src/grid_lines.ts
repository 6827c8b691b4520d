// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { BufferGeometry, DoubleSide, Float32BufferAttribute, Group, Mesh, MeshBasicMaterial, Vector3 } from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import type { Frames } from "./frames.ts";
import type { FarView } from "./server.ts";
import type { CellIndex } from "./view_info.ts";

/** Lines of the ground lie this far above it, so that it does not cover them. */
const lift_m = 0.4;
/** Along an edge of the grid. More would be a grey area, and take seconds to drape. */
const greatestLines = 128;

/** From begin to end, both included. */
function steps(begin: number, end: number, each: number): number[] {
  const places: number[] = [];
  for (let n = begin; n < end; n += each) places.push(n);
  return [...places, end];
}

/** What of a line is hidden by buildings is drawn paler, not left out: a grid is no thing of the town. */
class SeenThroughLines {
  readonly object = new Group();
  private readonly geometry = new LineSegmentsGeometry();

  constructor(colour: string, width_px: number, paleness: number, order: number) {
    const common = { color: colour, linewidth: width_px, transparent: true, depthWrite: false };
    const lines = [new LineMaterial({ ...common, opacity: paleness, depthTest: false }), new LineMaterial({ ...common, opacity: 0.9 })];
    lines.forEach((material, n) => {
      const line = new LineSegments2(this.geometry, material);
      line.frustumCulled = false;
      line.renderOrder = order + n;
      this.object.add(line);
    });
    this.object.visible = false;
  }

  /** Three coordinates a point, two points a line. */
  set(positions: number[]): void {
    this.object.visible = positions.length > 0;
    if (positions.length === 0) return;
    this.geometry.dispose();
    this.geometry.setPositions(positions);
  }
}

export type GroundHeight = (x_local: number, y_local: number) => number;

/** The lines of the method in the city: cells, a neighbourhood, and what a far map names. */
export class GridLines {
  readonly object = new Group();
  private readonly cells = new SeenThroughLines("#ffffff", 1.2, 0.16, 1);
  private readonly casing = new SeenThroughLines("#1d2733", 2.8, 0.06, 0);
  private readonly near = new SeenThroughLines("#ffffff", 3, 0.3, 12);
  private readonly cell = new SeenThroughLines("#d81b60", 4, 0.35, 14);
  private readonly edges = new SeenThroughLines("#ff6d00", 3, 0.5, 16);
  private readonly area = new Mesh(new BufferGeometry(), new MeshBasicMaterial(
    { color: "#ffffff", opacity: 0.2, transparent: true, depthWrite: false, side: DoubleSide }));

  constructor(private readonly frames: Frames, private readonly heightAt: GroundHeight) {
    this.area.renderOrder = 10;
    this.area.frustumCulled = false;
    this.object.add(this.casing.object, this.cells.object, this.area, this.near.object, this.cell.object, this.edges.object);
    this.object.visible = false;
  }

  /** All cells, at the heights of the ground that is loaded now; of very many, each second line or fewer. */
  drape(): void {
    const { i_begin, i_end, j_begin, j_end } = this.frames.grid, positions: number[] = [];
    const each = Math.ceil(Math.max(i_end - i_begin, j_end - j_begin) / greatestLines);
    const columns = steps(i_begin, i_end, each), rows = steps(j_begin, j_end, each);
    columns.forEach((i, n) => rows.forEach((j, m) => {
      const east = columns[n + 1], north = rows[m + 1];
      if (east !== undefined) positions.push(...this.corner(i, j), ...this.corner(east, j));
      if (north !== undefined) positions.push(...this.corner(i, j), ...this.corner(i, north));
    }));
    this.cells.set(positions);
    this.casing.set(positions);
  }

  /** A cell with its neighbourhood, or none. */
  highlight(cell: CellIndex | null): void {
    this.area.visible = cell !== null;
    if (!cell) {
      this.near.set([]);
      this.cell.set([]);
      return;
    }
    const half = (this.frames.grid.neighborhood - 1) / 2, [i, j] = cell;
    const ring = this.ringOf(this.clipped(i - half, j - half, i + half + 1, j + half + 1));
    this.near.set(closed(ring));
    this.cell.set(closed(this.ringOf([i, j, i + 1, j + 1])));
    this.area.geometry.setAttribute("position", new Float32BufferAttribute(fan(ring), 3));
  }

  /** The far edges that a cell's far map stores as edges. */
  showEdges(far: FarView | null): void {
    this.edges.set(far ? far.edges.flat() : []);
  }

  private clipped(i_begin: number, j_begin: number, i_end: number, j_end: number): [number, number, number, number] {
    const g = this.frames.grid;
    return [Math.max(g.i_begin, i_begin), Math.max(g.j_begin, j_begin), Math.min(g.i_end, i_end), Math.min(g.j_end, j_end)];
  }

  /** The corners of all cells along the border, counter-clockwise. */
  private ringOf([i0, j0, i1, j1]: [number, number, number, number]): Vector3[] {
    const ring: Vector3[] = [], add = (i: number, j: number): number => ring.push(new Vector3(...this.corner(i, j)));
    for (let i = i0; i < i1; ++i) add(i, j0);
    for (let j = j0; j < j1; ++j) add(i1, j);
    for (let i = i1; i > i0; --i) add(i, j1);
    for (let j = j1; j > j0; --j) add(i0, j);
    return ring;
  }

  private corner(i: number, j: number): [number, number, number] {
    const [x, y] = this.frames.cornerOfCell(i, j);
    return [x, y, this.heightAt(x, y) + lift_m];
  }
}

const closed = (ring: readonly Vector3[]): number[] =>
  ring.flatMap((p, n) => [...p.toArray(), ...(ring[(n + 1) % ring.length] ?? p).toArray()]);

function fan(ring: readonly Vector3[]): number[] {
  const middle = ring.reduce((sum, p) => sum.add(p), new Vector3()).divideScalar(Math.max(1, ring.length));
  return ring.flatMap((p, n) => [...middle.toArray(), ...p.toArray(), ...(ring[(n + 1) % ring.length] ?? p).toArray()]);
}
