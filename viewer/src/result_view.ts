// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import type { Points } from "three";
import { tell } from "./banner.ts";
import type { CityScene } from "./city_scene.ts";
import { Divider } from "./divider.ts";
import { leastUpward } from "./ground_values.ts";
import { LatestOnly } from "./latest_only.ts";
import { Legend } from "./legend.ts";
import { part, showFacts } from "./page_parts.ts";
import type { PickedFacet } from "./picking.ts";
import { computed, type NumberPair, type ResultChoice, ResultControls } from "./result_controls.ts";
import { dotsOf } from "./result_points.ts";
import { isValue, noValue, PointsResult, RasterResult, type ResultInfo, SurfacesResult, titleOf, valueText } from "./results.ts";
import type { ShownValues } from "./shown_values.ts";
import type { SourcePair } from "./value_pairs.ts";
import type { ViewInfo } from "./view_info.ts";

/** A dot is told of when it is this near to the place that was clicked at, on the screen. */
const reach_px = 10;

/** The results beside the package: loads those that are shown, draws them, compares them, and tells their values at a place. */
export class ResultView {
  private readonly controls: ResultControls;
  private readonly divider: Divider;
  private readonly legend: Legend;
  private readonly rasters = new Map<number, RasterResult>();
  private readonly surfaces = new Map<number, SurfacesResult>();
  private readonly points = new Map<number, { result: PointsResult; dots: Points }>();
  private readonly loading = new LatestOnly<ResultChoice>((choice) => this.load(choice));
  private facet: PickedFacet | null = null;

  constructor(private readonly view: ViewInfo, private readonly city: CityScene, private readonly values: ShownValues,
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

  /** `facetsAreSeen` are those without a value. Of two results, the small picture that tells has another divider. */
  nameNoData(facetsAreSeen: () => boolean): void {
    const dots = [...this.points.values()].filter((shown) => shown.dots.visible && shown.result.info.form !== "problems");
    const dotsAreSeen = dots.some(({ result }) => result.values.some((value) => !isValue(value)));
    this.legend.namesNoData = this.divider.shown || dotsAreSeen || facetsAreSeen();
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
    this.values.setDivider(share * this.city.canvas.width);
    this.city.redraw();
    this.onChange();
  }

  private async load(choice: ResultChoice): Promise<void> {
    try {
      const ground = await this.pairOf(choice.ground, this.rasters, (info) => RasterResult.load(info));
      const buildings = await this.pairOf(choice.buildings, this.surfaces, (info) => SurfacesResult.load(info));
      for (const n of choice.dots) await this.addDots(n);
      for (const [n, { dots }] of this.points) dots.visible = choice.dots.includes(n);
      this.values.choose({ ground, buildings, comparison: choice.comparison });
      this.divider.shown = (ground.compared !== null || buildings.compared !== null) && choice.comparison === "divider";
      this.showLegend(choice);
      await this.tellValues();
    } catch (error) {
      this.onError(error);
    }
    this.city.redraw();
  }

  /** The results of two numbers, each loaded once. */
  private async pairOf<Result>({ shown, compared }: NumberPair, loaded: Map<number, Result>,
                               load: (info: ResultInfo) => Promise<Result>): Promise<SourcePair<Result>> {
    const sourceOf = async (n: number): Promise<Result | "computed"> => {
      const info = this.view.results[n];
      if (n === computed || !info) return "computed";
      const result = loaded.get(n) ?? (await load(info));
      loaded.set(n, result);
      return result;
    };
    return { shown: await sourceOf(shown), compared: compared === null ? null : await sourceOf(compared) };
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

  private showLegend({ ground, buildings, comparison }: ResultChoice): void {
    const pairs = [ground, buildings].filter((pair) => pair.shown !== computed || pair.compared !== null), range = this.values.colouredRange;
    const compared = pairs.filter((pair) => pair.compared !== null), byDivider = comparison === "divider";
    const titled = byDivider || compared.length === 0 ? pairs : compared;
    const titles = titled.map((pair) => this.titleOfPair(pair, byDivider ? " | " : " less ") + this.unitOf(pair));
    if (titles.length === 0) this.legend.showValues("Sky view factor", range);
    else if (compared.length === 0 || byDivider) this.legend.showValues(titles.join(", "), range);
    else this.legend.showDifferences(titles.join(", "), this.values.greatestDifference);
    for (const { shown, compared: other } of compared) {
      const [a, b] = [this.nameOf(shown), this.nameOf(other ?? computed)];
      tell(byDivider ? `${a} left of the divider, ${b} right of it.` : `The difference of ${a} and ${b}.`);
    }
  }

  private titleOfPair({ shown, compared }: NumberPair, between: string): string {
    return this.nameOf(shown) + (compared === null ? "" : between + this.nameOf(compared));
  }

  /** ", kWh/m²"; nothing where there is none. */
  private unitOf({ shown }: NumberPair): string {
    const unit = this.view.results[shown]?.unit;
    return unit ? `, ${unit}` : "";
  }

  private nameOf(n: number): string {
    const info = this.view.results[n];
    return info ? titleOf(info) : "computed values";
  }

  private async tellValues(): Promise<void> {
    const facet = this.facet;
    if (!facet) return;
    const rows = facet.kind === "ground" ? rowsOf(this.values.ground.choice, (raster) => valueOfGround(raster, facet))
      : rowsOf(this.values.buildings.choice, (surfaces) => surfaces.valueOf(facet.building, facet.surface));
    const perMetre_px = this.pixelsPerMetreAt(facet);
    for (const { result, dots } of this.points.values()) {
      const n = dots.visible ? result.nearest(facet.p_local, reach_px / perMetre_px) : null;
      if (n !== null) rows.push(await rowOfPoint(result, n));
    }
    if (this.facet === facet) showFacts(part("result-facts"), rows);
  }

  private pixelsPerMetreAt({ p_local }: PickedFacet): number {
    const distance_m = this.city.camera.position.distanceTo(p_local), half = Math.tan((this.city.camera.fov * Math.PI) / 360);
    return this.city.size().y / (2 * half * distance_m);
  }
}

/** A raster says nothing of ground on which it is not drawn. */
function valueOfGround(raster: RasterResult, { p_local, normal_local }: PickedFacet): number {
  return Math.abs(normal_local.z) < leastUpward ? noValue : raster.at(p_local.x, p_local.y);
}

/** What the results of a pair say, and their difference. */
function rowsOf<Result extends { info: ResultInfo }>({ shown, compared }: SourcePair<Result>, valueIn: (result: Result) => number): [string, string][] {
  const results = [shown, compared].filter((source): source is Result => source !== null && source !== "computed");
  const values = results.map(valueIn), [a, b] = values;
  const rows = results.map((result, n): [string, string] => [titleOf(result.info), valueText(result.info, values[n] ?? NaN)]);
  const [first] = results;
  if (a !== undefined && b !== undefined && first)
    rows.push(["Difference", isValue(a) && isValue(b) ? valueText(first.info, a - b) : "no data"]);
  return rows;
}

async function rowOfPoint(result: PointsResult, n: number): Promise<[string, string]> {
  const label = await result.labelOf(n), { info } = result;
  return info.form === "problems" ? ["Problem", label] : [`${titleOf(info)}, ${label}`, valueText(info, result.values[n] ?? NaN)];
}

