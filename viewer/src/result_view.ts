// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import type { Points } from "three";
import { tell } from "./banner.ts";
import type { CityScene } from "./city_scene.ts";
import { Divider } from "./divider.ts";
import type { GroundSource, GroundValues } from "./ground_values.ts";
import { LatestOnly } from "./latest_only.ts";
import { Legend } from "./legend.ts";
import { part, showFacts } from "./page_parts.ts";
import type { PickedFacet } from "./picking.ts";
import { computed, type ResultChoice, ResultControls } from "./result_controls.ts";
import { dotsOf } from "./result_points.ts";
import { isValue, PointsResult, RasterResult, titleOf } from "./results.ts";
import type { ViewInfo } from "./view_info.ts";

/** A dot is told of when it is this near to the place that was clicked at, on the screen. */
const reach_px = 10;
const svfText = (value: number): string => (isValue(value) ? value.toFixed(4) : "no data");

/** The results beside the package: loads those that are shown, draws them, compares them, and tells their values at a place. */
export class ResultView {
  private readonly controls: ResultControls;
  private readonly divider: Divider;
  private readonly legend: Legend;
  private readonly rasters = new Map<number, RasterResult>();
  private readonly points = new Map<number, { result: PointsResult; dots: Points }>();
  private readonly loading = new LatestOnly<ResultChoice>((choice) => this.load(choice));
  private facet: PickedFacet | null = null;

  constructor(private readonly view: ViewInfo, private readonly city: CityScene, private readonly ground: GroundValues,
              private readonly tilesAreThere: Promise<void>,
              private readonly heightAt: (x_local: number, y_local: number) => number, private readonly onChange: () => void,
              private readonly onError: (error: unknown) => void) {
    this.legend = new Legend(view);
    this.controls = new ResultControls(view.results, () => this.apply());
    this.divider = new Divider(part("divider"), (share) => this.moveDivider(share));
    window.addEventListener("resize", () => this.moveDivider(this.divider.share));
  }

  get choice(): ResultChoice {
    return this.controls.choice;
  }

  get isLoading(): boolean {
    return this.loading.isBusy;
  }

  get dividerShare(): number {
    return this.divider.share;
  }

  restore(choice: ResultChoice | null, dividerShare: number | null): void {
    if (choice) this.controls.choose(choice);
    if (dividerShare !== null) this.divider.move(dividerShare);
    this.apply();
  }

  /** What results say of the selected place; null when none is selected. */
  select(facet: PickedFacet | null): void {
    this.facet = facet;
    void this.tellValues();
  }

  private apply(): void {
    this.controls.showComparison();
    this.loading.ask(this.controls.choice);
    this.onChange();
  }

  private moveDivider(share: number): void {
    this.ground.setDivider(share * this.city.canvas.width);
    this.city.redraw();
    this.onChange();
  }

  private async load(choice: ResultChoice): Promise<void> {
    try {
      const shown = await this.sourceOf(choice.shown), compared = choice.compared === null ? null : await this.sourceOf(choice.compared);
      for (const n of choice.dots) await this.addDots(n);
      for (const [n, { dots }] of this.points) dots.visible = choice.dots.includes(n);
      this.ground.choose({ shown, compared, comparison: choice.comparison });
      this.divider.shown = compared !== null && choice.comparison === "divider";
      this.showLegend(choice);
      await this.tellValues();
    } catch (error) {
      this.onError(error);
    }
    this.city.redraw();
  }

  private async sourceOf(n: number): Promise<GroundSource> {
    const info = this.view.results[n];
    if (n === computed || !info) return "computed";
    const raster = this.rasters.get(n) ?? (await RasterResult.load(info));
    this.rasters.set(n, raster);
    return raster;
  }

  private async addDots(n: number): Promise<void> {
    const info = this.view.results[n];
    if (!info || this.points.has(n)) return;
    // Heights that are not known are those of the ground below
    await this.tilesAreThere;
    const result = await PointsResult.load(info, this.heightAt), dots = dotsOf(result, this.view);
    this.points.set(n, { result, dots });
    this.city.scene.add(dots);
  }

  private showLegend({ shown, compared, comparison }: ResultChoice): void {
    const [a, b] = [this.nameOf(shown), compared === null ? null : this.nameOf(compared)], range = this.ground.colouredRange;
    if (b === null) this.legend.showValues(shown === computed ? "Sky view factor" : a, range);
    else if (comparison === "divider") this.legend.showValues(`${a} | ${b}`, range);
    else this.legend.showDifferences(`${a} less ${b}`, this.ground.greatestDifference);
    if (b !== null) tell(comparison === "divider" ? `${a} left of the divider, ${b} right of it.` : `The difference of ${a} and ${b}.`);
  }

  private nameOf(n: number): string {
    const info = this.view.results[n];
    return info ? titleOf(info) : "computed values";
  }

  private async tellValues(): Promise<void> {
    const facet = this.facet, { shown, compared } = this.controls.choice, rows: [string, string][] = [];
    if (!facet) return;
    const rasters = facet.kind === "ground" ? [...this.rasters].filter(([n]) => n === shown || n === compared) : [];
    for (const [, raster] of rasters) rows.push([titleOf(raster.info), svfText(raster.at(facet.p_local.x, facet.p_local.y))]);
    if (rasters.length === 2) rows.push(["Difference", this.differenceAt(facet)]);
    const perMetre_px = this.pixelsPerMetreAt(facet);
    for (const { result, dots } of this.points.values()) {
      const n = dots.visible ? result.nearest(facet.p_local, reach_px / perMetre_px) : null;
      if (n !== null) rows.push(await rowOf(result, n));
    }
    if (this.facet === facet) showFacts(part("result-facts"), rows);
  }

  private differenceAt({ p_local: { x, y } }: PickedFacet): string {
    const { shown, compared } = this.ground.choice, [a, b] = [shown, compared].map((s) => (s instanceof RasterResult ? s.at(x, y) : NaN));
    return a !== undefined && b !== undefined && isValue(a) && isValue(b) ? (a - b).toFixed(4) : "no data";
  }

  private pixelsPerMetreAt({ p_local }: PickedFacet): number {
    const distance_m = this.city.camera.position.distanceTo(p_local), half = Math.tan((this.city.camera.fov * Math.PI) / 360);
    return this.city.size().y / (2 * half * distance_m);
  }
}

async function rowOf(result: PointsResult, n: number): Promise<[string, string]> {
  const label = await result.labelOf(n), { info } = result;
  return info.form === "problems" ? ["Problem", label] : [`${titleOf(info)}, ${label}`, svfText(result.values[n] ?? NaN)];
}

