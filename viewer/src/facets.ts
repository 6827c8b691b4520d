// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { BufferAttribute, type BufferGeometry } from "three";
import { kindNumber } from "./surface_kinds.ts";

/** What EXT_structural_metadata says of a surface. */
export interface SurfaceRow {
  building: string;
  surface: number;
  kind: string;
}

/** The part of the loader's metadata that is asked here; its package declares no types for it. */
export interface SurfaceTable {
  tableAccessors: { getPropertyValue(name: "kind", row: number): string }[];
  getPropertyTableData(table: number, row: number): SurfaceRow;
}

export const nameOfFeature = "_feature_id_0", nameOfValue = "_svf";

/** The number of the kind of each row that was asked for, read once. */
function kindsOf(table: SurfaceTable): (row: number) => number {
  const kinds = new Map<number, number>(), column = table.tableAccessors[0];
  return (row) => {
    const known = kinds.get(row);
    if (known !== undefined) return known;
    const kind = kindNumber(column?.getPropertyValue("kind", row) ?? "unknown");
    kinds.set(row, kind);
    return kind;
  };
}

/**
 * Gives each vertex its facet's normal and the number of its kind, in four bytes. The geometry is y up as glTF has it, the
 * normal z up as the page draws.
 */
export function addFacetAttribute(geometry: BufferGeometry, table: SurfaceTable): void {
  const p = geometry.getAttribute("position").array, rows = geometry.getAttribute(nameOfFeature).array;
  const kindOf = kindsOf(table), facets = new Int8Array(4 * rows.length), normal: [number, number, number] = [0, 0, 0];
  for (let n = 0; n < rows.length; n += 3) {
    normalOf(p, 3 * n, normal);
    const kind = kindOf(rows[n] ?? 0);
    for (let at = 4 * n; at < 4 * n + 12; at += 4) {
      facets[at] = 127 * normal[0];
      facets[at + 1] = -127 * normal[2];
      facets[at + 2] = 127 * normal[1];
      facets[at + 3] = kind;
    }
  }
  geometry.setAttribute("facet", new BufferAttribute(facets, 4, true));
}

/** Of the triangle whose nine coordinates begin at `first`; straight up where it has no area. Tiles have many, so nothing is made. */
function normalOf(p: ArrayLike<number>, first: number, normal: [number, number, number]): void {
  const px = p[first] ?? 0, py = p[first + 1] ?? 0, pz = p[first + 2] ?? 0;
  const ax = (p[first + 3] ?? 0) - px, ay = (p[first + 4] ?? 0) - py, az = (p[first + 5] ?? 0) - pz;
  const bx = (p[first + 6] ?? 0) - px, by = (p[first + 7] ?? 0) - py, bz = (p[first + 8] ?? 0) - pz;
  const x = ay * bz - az * by, y = az * bx - ax * bz, z = ax * by - ay * bx, length = Math.sqrt(x * x + y * y + z * z);
  normal[0] = length > 0 ? x / length : 0;
  normal[1] = length > 0 ? y / length : 1;
  normal[2] = length > 0 ? z / length : 0;
}

export const kindOfVertex = (geometry: BufferGeometry, vertex: number): number =>
  (geometry.getAttribute("facet").array[4 * vertex + 3] ?? 0);
