// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { fetchJson, fetchOfServer } from "./server.ts";

export type ResultForm = "raster" | "surfaces" | "points" | "problems";

/** A result file that farlod-view was given, as view.json tells of it. */
export interface ResultInfo {
  name: string;
  form: ResultForm;
  /** The band or the field; empty for problems. */
  quantity: string;
  url: string;
  /** Pixels, surfaces or points in the file; what is drawn may be thinned. */
  count: number;
  /** 0 and 1 where all values lie between, and are shares. */
  range: [number, number];
  /** Such as kWh/m²; empty of shares, and where it is not known. */
  unit: string;
  width?: number;
  height?: number;
  /** East of the corner of pixel (column, row) = [0] + column·[1] + row·[2], north = [3] + column·[4] + row·[5]. */
  local_from_pixel?: [number, number, number, number, number, number];
}

/** Where a raster or a point has no value. Shaders cannot be trusted to know a NaN. */
export const noValue = -1e9;
export const isValue = (value: number): boolean => value > 0.5 * noValue;

/** What the page calls it. */
export const titleOf = (info: ResultInfo): string => (info.quantity ? `${info.name}: ${info.quantity}` : info.name);

const digitsWithUnit = 4;
/** For people. */
export function valueText(info: ResultInfo, value: number): string {
  if (!isValue(value)) return "no data";
  return info.unit ? `${Number(value.toPrecision(digitsWithUnit))} ${info.unit}` : value.toFixed(4);
}

async function loadFloats(info: ResultInfo): Promise<Float32Array> {
  const response = await fetchOfServer(info.url), floats = new Float32Array(await response.arrayBuffer());
  return floats.map((value) => (Number.isFinite(value) ? value : noValue));
}

/** A raster of values on the ground. */
export class RasterResult {
  private constructor(readonly info: ResultInfo, readonly width: number, readonly height: number, readonly values: Float32Array,
                      /** Column and row from east and north: (a, b, c, d, e, f) as in a·x + b·y + c and d·x + e·y + f. */
                      readonly pixel_from_local: readonly [number, number, number, number, number, number]) {}

  static async load(info: ResultInfo): Promise<RasterResult> {
    const { width, height, local_from_pixel } = info;
    if (!width || !height || !local_from_pixel) throw new Error(`${info.name} is no raster.`);
    const values = await loadFloats(info);
    if (values.length !== width * height) throw new Error(`${info.name} came with ${values.length} values instead of ${width * height}.`);
    return new RasterResult(info, width, height, values, inverseOf(local_from_pixel));
  }

  /** The value of the pixel at a place, `noValue` beside the raster and where it has none. */
  at(x_local: number, y_local: number): number {
    const [a, b, c, d, e, f] = this.pixel_from_local;
    const column = Math.floor(a * x_local + b * y_local + c), row = Math.floor(d * x_local + e * y_local + f);
    if (column < 0 || row < 0 || column >= this.width || row >= this.height) return noValue;
    return this.values[row * this.width + column] ?? noValue;
  }

  /** The middle of a pixel. */
  middleOf(pixel: number): [number, number] {
    const [x0, xc, xr, y0, yc, yr] = this.info.local_from_pixel ?? [0, 0, 0, 0, 0, 0];
    const column = (pixel % this.width) + 0.5, row = Math.floor(pixel / this.width) + 0.5;
    return [x0 + column * xc + row * xr, y0 + column * yc + row * yr];
  }
}

function inverseOf([x0, xc, xr, y0, yc, yr]: NonNullable<ResultInfo["local_from_pixel"]>): RasterResult["pixel_from_local"] {
  const determinant = xc * yr - xr * yc, a = yr / determinant, b = -xr / determinant, d = -yc / determinant, e = xc / determinant;
  return [a, b, -(a * x0 + b * y0), d, e, -(d * x0 + e * y0)];
}

/** A value for each surface of buildings that a table has. */
export class SurfacesResult {
  private constructor(readonly info: ResultInfo, private readonly ofBuilding: ReadonlyMap<string, ReadonlyMap<number, number>>) {}

  static async load(info: ResultInfo): Promise<SurfacesResult> {
    const [floats, ids] = await Promise.all([loadFloats(info), fetchJson<string[]>(`${info.url}.json`)]);
    const ofBuilding = new Map<string, Map<number, number>>(ids.map((id) => [id, new Map<number, number>()]));
    for (let n = 0; n + 2 < floats.length; n += 3) ofBuilding.get(ids[floats[n] ?? -1] ?? "")?.set(floats[n + 1] ?? -1, floats[n + 2] ?? noValue);
    return new SurfacesResult(info, ofBuilding);
  }

  /** `noValue` where the table has no such surface. */
  valueOf(building: string, surface: number): number {
    return this.ofBuilding.get(building)?.get(surface) ?? noValue;
  }

  /** The values of the same surfaces here and in another table: of so many at the most. */
  pairsWith(other: SurfacesResult, most: number): [number, number][] {
    const pairs: [number, number][] = [];
    for (const [building, ofSurface] of this.ofBuilding)
      for (const [surface, value] of ofSurface) {
        if (pairs.length >= most) return pairs;
        pairs.push([value, other.valueOf(building, surface)]);
      }
    return pairs;
  }
}

/** Points or problems, each with a place and perhaps a value. */
export class PointsResult {
  private labels: Promise<string[]> | null = null;

  private constructor(readonly info: ResultInfo, readonly places_local: Float32Array, readonly values: Float32Array) {}

  /** Where no height is known, `heightAt` is asked. */
  static async load(info: ResultInfo, heightAt: (x_local: number, y_local: number) => number): Promise<PointsResult> {
    const floats = await loadFloats(info), count = floats.length / 4;
    const places = new Float32Array(3 * count), values = new Float32Array(count);
    for (let n = 0; n < count; ++n) {
      const [x = 0, y = 0, z = noValue, value = noValue] = floats.subarray(4 * n, 4 * n + 4);
      places.set([x, y, isValue(z) ? z : heightAt(x, y)], 3 * n);
      values[n] = value;
    }
    return new PointsResult(info, places, values);
  }

  /** The number of the nearest point within a distance. */
  nearest(p_local: { x: number; y: number; z: number }, reach_m: number): number | null {
    let found: number | null = null, least = reach_m * reach_m;
    for (let n = 0, at = 0; n < this.values.length; ++n, at += 3) {
      const dx = (this.places_local[at] ?? 0) - p_local.x, dy = (this.places_local[at + 1] ?? 0) - p_local.y;
      const dz = (this.places_local[at + 2] ?? 0) - p_local.z, square = dx * dx + dy * dy + dz * dz;
      if (square > least) continue;
      least = square;
      found = n;
    }
    return found;
  }

  /** Its id, or what the problem is. Asked for once. */
  async labelOf(n: number): Promise<string> {
    this.labels ??= fetchJson<string[]>(`${this.info.url}.json`);
    return (await this.labels)[n] ?? "";
  }
}
