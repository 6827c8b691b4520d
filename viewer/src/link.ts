// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import type { Triple } from "./view_info.ts";
import type { Frames } from "./frames.ts";
import type { CameraView } from "./navigation.ts";
import type { PickedFacet } from "./picking.ts";
import { tilt_deg } from "./frames.ts";
import { computed, type ResultChoice } from "./result_controls.ts";
import { isSkyProjection, type SkyProjection } from "./sky_projection.ts";
import type { Theme } from "./theme.ts";
import { comparisons } from "./value_pairs.ts";

const layerNames = ["ground", "roofs", "facades", "grid", "trees"] as const;
export type LayerName = (typeof layerNames)[number];

/** What the part of an address after "#" holds. Places are projected, so that a link outlives a new packing. */
export interface LinkedView {
  /** East, north, height of what the camera looks at; distance; bearing from grid north; tilt. */
  camera: [number, number, number, number, number, number] | null;
  /** East, north, height; true azimuth and tilt of the normal. */
  place: [number, number, number, number, number] | null;
  layers: LayerName[] | null;
  theme: Theme | null;
  projection: SkyProjection | null;
  results: ResultChoice | null;
  /** Of two results, from the left. */
  divider: number | null;
}

export function linkedCamera(view: CameraView, frames: Frames): NonNullable<LinkedView["camera"]> {
  return [...frames.projectedOf(view.target_local), view.distance_m, view.bearing_deg, view.tilt_deg];
}

export function cameraOf([x, y, z, distance_m, bearing_deg, tilt]: NonNullable<LinkedView["camera"]>, frames: Frames): CameraView {
  return { target_local: frames.localOf([x, y, z]), distance_m, bearing_deg, tilt_deg: tilt };
}

export function linkedPlace(facet: PickedFacet, frames: Frames): NonNullable<LinkedView["place"]> {
  const p: Triple = frames.projectedOf(facet.p_local);
  return [...p, frames.trueAzimuth_deg(facet.normal_local), tilt_deg(facet.normal_local)];
}

const text = (numbers: readonly number[]): string => numbers.map((n) => String(Number(n.toFixed(3)))).join(",");

export function hashOf(link: LinkedView): string {
  const fields: string[] = [];
  if (link.camera) fields.push(`camera=${text(link.camera)}`);
  if (link.place) fields.push(`place=${text(link.place)}`);
  if (link.layers) fields.push(`layers=${link.layers.join(",")}`);
  if (link.theme) fields.push(`theme=${link.theme}`);
  if (link.projection && link.projection !== "orthographic") fields.push(`projection=${link.projection}`);
  if (link.results) fields.push(...fieldsOfResults(link.results, link.divider));
  return `#${fields.join("&")}`;
}

const numberText = (n: number): string => (n === computed ? "computed" : String(n));

/** Numbers of results, in the order of the command line. */
function fieldsOfResults({ ground, buildings, comparison, dots }: ResultChoice, divider: number | null): string[] {
  const fields = [`ground=${numberText(ground.shown)}`, `dots=${dots.join(",")}`];
  if (buildings.shown !== computed) fields.push(`buildings=${numberText(buildings.shown)}`);
  if (ground.compared !== null) fields.push(`compared=${numberText(ground.compared)}`);
  if (buildings.compared !== null) fields.push(`buildings-compared=${numberText(buildings.compared)}`);
  if (ground.compared === null && buildings.compared === null) return fields;
  fields.push(`comparison=${comparison}`);
  if (comparison === "divider" && divider !== null) fields.push(`divider=${text([divider])}`);
  return fields;
}

function resultsOf(fields: URLSearchParams): ResultChoice | null {
  const ground = fields.get("ground"), buildings = fields.get("buildings");
  const number = (field: string | null): number => (field === null || field === "computed" ? computed : Number(field));
  const compared = (name: string): number | null => (fields.has(name) ? number(fields.get(name)) : null);
  if (ground === null && buildings === null) return null;
  return {
    ground: { shown: number(ground), compared: compared("compared") }, buildings: { shown: number(buildings), compared: compared("buildings-compared") },
    comparison: comparisons.find((name) => name === fields.get("comparison")) ?? "divider",
    dots: (fields.get("dots") ?? "").split(",").filter((field) => field !== "").map(Number),
  };
}

function numbersOf<T extends number[]>(field: string | null, count: T["length"]): T | null {
  const numbers = field?.split(",").map(Number) ?? [];
  return numbers.length === count && numbers.every(Number.isFinite) ? (numbers as T) : null;
}

/** What is wrong in a link is left out. */
export function linkOf(hash: string): LinkedView {
  const fields = new URLSearchParams(hash.replace(/^#/, "")), theme = fields.get("theme"), projection = fields.get("projection") ?? "";
  return {
    camera: numbersOf<NonNullable<LinkedView["camera"]>>(fields.get("camera"), 6),
    place: numbersOf<NonNullable<LinkedView["place"]>>(fields.get("place"), 5),
    layers: fields.has("layers") ? layerNames.filter((name) => fields.get("layers")?.split(",").includes(name)) : null,
    theme: theme === "light" || theme === "dark" ? theme : null,
    projection: isSkyProjection(projection) ? projection : null,
    results: resultsOf(fields),
    divider: numbersOf<[number]>(fields.get("divider"), 1)?.[0] ?? null,
  };
}
