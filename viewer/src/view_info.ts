// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import type { ResultInfo } from "./results.ts";
import { fetchJson } from "./server.ts";

export type Triple = [number, number, number];
export type CellIndex = [number, number];

export interface GridInfo {
  /** Of the grid's y axis, clockwise from grid north. */
  bearing_deg: number;
  /** True azimuth = grid azimuth + convergence. */
  convergence_deg: number;
  cell_edge_m: number;
  neighborhood: number;
  i_begin: number;
  j_begin: number;
  i_end: number;
  j_end: number;
  /** Local; the south-west corner of the cell (i_begin, j_begin). */
  corner_m: [number, number];
}

/** What view.json says of the package: README.md has its fields. */
export interface ViewInfo {
  software: string;
  name: string;
  crs: string;
  epsg: number | null;
  origin_m: Triple;
  can_answer: boolean;
  grid: GridInfo;
  heights_m: [number, number];
  counts: { buildings: number; polygons: number; triangles: number; crowns: number };
  far_map_kind: string;
  receiver_height_m: number;
  colours: Triple[];
  nodata_colour: Triple;
  tileset: string;
  /** The files that farlod-view was given besides the package. */
  results: ResultInfo[];
}

const needed: readonly (keyof ViewInfo)[] = ["name", "origin_m", "grid", "heights_m", "counts", "colours", "nodata_colour", "tileset", "results"];

export async function loadViewInfo(): Promise<ViewInfo> {
  const view = await fetchJson<Partial<ViewInfo>>("view.json");
  const missing = needed.filter((name) => view[name] === undefined);
  if (missing.length > 0) throw new Error(`view.json lacks ${missing.join(", ")}: the page and the server are of different versions.`);
  return view as ViewInfo;
}
