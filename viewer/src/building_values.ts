// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { BufferAttribute, type BufferGeometry } from "three";
import { nameOfFeature, type SurfaceTable } from "./facets.ts";
import { noValue, type SurfacesResult } from "./results.ts";
import type { SourcePair } from "./value_pairs.ts";

/** Of a vertex: the value that is shown, and the one that it is compared with. */
const nameOfTabled = "tabled";

/** What buildings show: the values of the tiles, or those of a table, which each tile is given for its surfaces. */
export class BuildingValues {
  choice: SourcePair<SurfacesResult> = { shown: "computed", compared: null };
  private readonly geometries = new Map<BufferGeometry, SurfaceTable>();
  private readonly shownIsTabled = { value: false };
  private readonly comparedIsTabled = { value: false };

  get uniforms(): Record<string, { value: unknown }> {
    return { shownIsTabled: this.shownIsTabled, comparedIsTabled: this.comparedIsTabled };
  }

  choose(choice: SourcePair<SurfacesResult>): void {
    const isSame = choice.shown === this.choice.shown && choice.compared === this.choice.compared;
    this.choice = choice;
    this.shownIsTabled.value = choice.shown !== "computed";
    this.comparedIsTabled.value = choice.compared !== null && choice.compared !== "computed";
    if (!isSame) for (const [geometry, table] of this.geometries) this.write(geometry, table);
  }

  /** The geometry of a tile, as long as the tile is there. */
  add(geometry: BufferGeometry, table: SurfaceTable): void {
    this.geometries.set(geometry, table);
    this.write(geometry, table);
  }

  remove(geometry: BufferGeometry): void {
    this.geometries.delete(geometry);
  }

  private write(geometry: BufferGeometry, table: SurfaceTable): void {
    if (!this.shownIsTabled.value && !this.comparedIsTabled.value) {
      geometry.deleteAttribute(nameOfTabled);
      return;
    }
    const rows = geometry.getAttribute(nameOfFeature).array, ofRow = new Map<number, [number, number]>();
    const values = new Float32Array(2 * rows.length);
    rows.forEach((row: number, vertex: number) => {
      const pair = ofRow.get(row) ?? this.valuesOf(table, row);
      ofRow.set(row, pair);
      values.set(pair, 2 * vertex);
    });
    geometry.setAttribute(nameOfTabled, new BufferAttribute(values, 2));
  }

  private valuesOf(table: SurfaceTable, row: number): [number, number] {
    const { building, surface } = table.getPropertyTableData(0, row), { shown, compared } = this.choice;
    const valueIn = (source: SurfacesResult | "computed" | null): number =>
      (source === null || source === "computed" ? noValue : source.valueOf(building, surface));
    return [valueIn(shown), valueIn(compared)];
  }
}
