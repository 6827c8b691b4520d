// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { Vector2 } from "three";
import { hideBanner, isSilent, sentenceOf, showBanner, tell } from "./banner.ts";
import { CellPanel } from "./cell_panel.ts";
import { CityScene } from "./city_scene.ts";
import { Crowns } from "./crowns.ts";
import { Frames } from "./frames.ts";
import { GridLines } from "./grid_lines.ts";
import { GridView } from "./grid_view.ts";
import { GroundHeights } from "./ground_heights.ts";
import { listenToKeys, zoomStep } from "./keyboard.ts";
import { LayerBoxes } from "./layers.ts";
import { cameraOf, hashOf, linkedCamera, linkedPlace, type LinkedView, linkOf } from "./link.ts";
import { MapOrnaments } from "./map_ornaments.ts";
import { Marker } from "./marker.ts";
import { Navigation } from "./navigation.ts";
import { NoDataCheck } from "./no_data.ts";
import { part } from "./page_parts.ts";
import { type PickedFacet, Picker } from "./picking.ts";
import { PlacePanel } from "./place_panel.ts";
import { PlaceView } from "./place_view.ts";
import { listenToPointer } from "./pointing.ts";
import { ResultView } from "./result_view.ts";
import { ShownValues } from "./shown_values.ts";
import { loadViewInfo, type ViewInfo } from "./view_info.ts";
import { isSkyProjection, type SkyProjection } from "./sky_projection.ts";
import { ThemeSwitch } from "./theme.ts";
import { CityTiles } from "./tiles.ts";

/** A linked place is looked for this far in front of its facet and behind it: tiles are cut finer or coarser by turns. */
const reachOfLink_m = 2;
/** And this far, where it was on a facet of a simplified tile, once no finer tiles have come for a while. */
const reachOfSimplified_m = 50, beforeSimplified_ms = 1500;

/**
 * While tiles come, frames are at least this far apart, and the first one is that far behind the first tile. Without a graphics
 * processor, what draws them would delay what comes: it gets a quarter of the time at the most.
 */
const betweenFrames_ms = 500, framesToPause = 4;

/** The page: one package in its window. */
export class Page {
  readonly city: CityScene;
  readonly frames: Frames;
  readonly tiles: CityTiles;
  readonly crowns: Crowns;
  readonly navigation: Navigation;
  readonly place: PlaceView;
  readonly grid: GridView;
  readonly results: ResultView;
  /** When the first complete frame was drawn, in milliseconds of performance.now(). */
  readyAt_ms: number | null = null;
  private readonly values = new ShownValues();
  private readonly picker: Picker;
  private readonly heights: GroundHeights;
  private readonly marker: Marker;
  private readonly layers = new LayerBoxes(() => this.applyLayers());
  private readonly theme: ThemeSwitch;
  private readonly placePanel: PlacePanel;
  private readonly cellPanel: CellPanel;
  private readonly ornaments: MapOrnaments;
  private readonly projection = part("projection", HTMLSelectElement);
  private onReady: () => void = () => undefined;
  private waitingPlace: LinkedView["place"] = null;
  private linkTimer = 0;
  private simplifiedTimer = 0;
  private isStale = false;
  private readonly noData: NoDataCheck;
  /** Whether the legend tells of the last frame. */
  private legendIsDue = true;
  private firstCompleteFrame: "missing" | "begun" | "drawn" | "shown" = "missing";
  /** When the last frame was begun, or the first tile came; null before. */
  private begunAt_ms: number | null = null;

  constructor(readonly view: ViewInfo) {
    const canvas = part("city", HTMLCanvasElement), fail = (error: unknown): void => this.fail(error);
    this.frames = new Frames(view);
    this.city = new CityScene(canvas, () => this.beforeFrame(), () => this.afterFrame());
    this.tiles = new CityTiles(view, this.values, this.city.camera, fail);
    this.noData = new NoDataCheck(this.city, this.tiles.nodata);
    this.crowns = new Crowns(() => this.city.redraw(), fail);
    this.city.scene.add(this.tiles.group, this.crowns.group);
    if (view.counts.crowns === 0) this.layers.remove("trees");
    this.picker = new Picker(this.tiles);
    this.heights = new GroundHeights(this.picker, view.heights_m);
    this.navigation = new Navigation(this.city.camera, canvas, this.frames, view.heights_m);
    this.placePanel = new PlacePanel(view, this.frames);
    this.cellPanel = new CellPanel(this.frames, view.far_map_kind);
    this.place = new PlaceView(this.frames, this.placePanel, view.can_answer, () => this.skyProjection(), fail);
    this.grid = this.makeGridView(fail);
    this.marker = new Marker(part("marker", HTMLButtonElement), this.city, this.picker, (facet) => this.select(facet),
                             (dragging) => { this.navigation.enabled = !dragging; });
    this.ornaments = new MapOrnaments(this.city, this.frames);
    this.theme = new ThemeSwitch(part("theme", HTMLButtonElement), (background) => this.applyTheme(background));
    this.results = new ResultView(view, this.city, this.values, new Promise((resolve) => { this.onReady = resolve; }),
                                  (x, y) => this.heights.at(x, y), () => this.noteLink(), fail);
    this.listen(canvas);
    this.restore(linkOf(location.hash));
    this.city.start();
  }

  get isResting(): boolean {
    return this.hasAllDrawn && !this.legendIsDue;
  }

  private get hasAllDrawn(): boolean {
    return this.city.isResting && this.tiles.isComplete && !this.navigation.isFlying && !this.place.isAsking && !this.results.isLoading &&
      !this.crowns.isLoading;
  }

  select(facet: PickedFacet): void {
    this.waitingPlace = null;
    part("panel").hidden = false;
    this.marker.show(facet);
    this.place.select(facet);
    this.results.select(facet);
    if (this.grid.shown && this.view.can_answer) this.grid.choose(facet);
    this.noteLink();
  }

  close(): void {
    part("panel").hidden = true;
    this.marker.show(null);
    this.place.clear();
    this.results.select(null);
    this.grid.clear();
    this.noteLink();
  }

  dispose(): void {
    this.city.dispose();
    this.tiles.dispose();
    this.noData.dispose();
    this.crowns.dispose();
    this.values.dispose();
  }

  private makeGridView(fail: (error: unknown) => void): GridView {
    const lines = new GridLines(this.frames, (x, y) => this.heights.at(x, y));
    this.city.scene.add(lines.object);
    return new GridView(this.frames, lines, this.cellPanel, () => this.city.redraw(), fail);
  }

  private listen(canvas: HTMLCanvasElement): void {
    listenToPointer(canvas, (place) => this.choose(place), (place) => this.hover(place));
    listenToKeys(canvas, this.navigation, {
      choose: () => this.choose(new Vector2(0, 0)), close: () => this.close(), toggleTrees: () => this.layers.toggle("trees"),
    });
    const press = (id: string, action: () => void): void => part(id, HTMLButtonElement).addEventListener("click", action);
    press("zoom-in", () => this.navigation.zoom(1 / zoomStep));
    press("zoom-out", () => this.navigation.zoom(zoomStep));
    press("north", () => this.navigation.northUp());
    press("home", () => this.navigation.home());
    press("close-panel", () => this.close());
    press("ask-cell", () => this.showCellOfPlace());
    this.projection.addEventListener("change", () => {
      this.placePanel.redraw(this.skyProjection());
      this.noteLink();
    });
    window.addEventListener("hashchange", () => this.restore(linkOf(location.hash)));
    window.addEventListener("pagehide", (event) => {
      if (!event.persisted) this.dispose();
    });
  }

  private choose(place: Vector2): void {
    const facet = this.picker.below(place, this.city.camera);
    if (facet) this.select(facet);
    else tell("There is nothing at this place.");
  }

  private hover(place: Vector2 | null): void {
    if (this.grid.shown) this.grid.hover(place ? this.picker.below(place, this.city.camera) : null);
  }

  private showCellOfPlace(): void {
    this.layers.choose([...this.layers.shown, "grid"]);
    this.applyLayers();
    const { selection } = this.place;
    if (selection) this.grid.choose(selection.facet);
    part("cell").scrollIntoView({ block: "nearest" });
  }

  private applyLayers(): void {
    const shown = { ground: this.layers.shows("ground"), roofs: this.layers.shows("roofs"), facades: this.layers.shows("facades") };
    this.tiles.layers = shown;
    this.picker.layers = shown;
    this.crowns.shown = this.layers.shows("trees");
    this.loadCrowns();
    if (this.grid.shown !== this.layers.shows("grid")) this.grid.show(this.layers.shows("grid"));
    this.city.redraw();
    this.noteLink();
  }

  /** After the first picture of the city, which crowns shall not delay. */
  private loadCrowns(): void {
    if (this.readyAt_ms !== null && this.layers.shows("trees")) this.crowns.load();
  }

  private applyTheme(background: string): void {
    this.city.setBackground(background);
    if (this.place.skyIsDrawn) this.placePanel.redraw(this.skyProjection());
    this.cellPanel.redraw();
    this.noteLink();
  }

  private skyProjection(): SkyProjection {
    return isSkyProjection(this.projection.value) ? this.projection.value : "orthographic";
  }

  private beforeFrame(): boolean {
    this.followFirstFrame();
    const moved = this.navigation.update();
    if (moved) this.noteLink();
    const changed = this.tiles.update(this.city.size(), moved);
    part("loading").style.width = this.tiles.isComplete ? "0" : `${Math.max(4, 100 * this.tiles.progress)}%`;
    this.isStale ||= changed;
    const isDue = this.tiles.isComplete || this.isDueWhileTilesCome();
    if (this.tiles.visibleTiles > 0 && isDue) this.city.release();
    if (!moved && !(this.isStale && isDue)) {
      this.updateLegend();
      return false;
    }
    this.marker.prepare();
    return true;
  }

  /** Once after the last of some frames. */
  private updateLegend(): void {
    if (!this.legendIsDue || this.readyAt_ms === null || !this.hasAllDrawn) return;
    this.legendIsDue = false;
    this.results.nameNoData(() => this.noData.isSeen());
  }

  private isDueWhileTilesCome(): boolean {
    const now_ms = performance.now();
    if (this.tiles.visibleTiles > 0) this.begunAt_ms ??= now_ms;
    return now_ms - (this.begunAt_ms ?? now_ms) > Math.max(betweenFrames_ms, framesToPause * this.city.lastFrame_ms);
  }

  private afterFrame(): void {
    this.isStale = false;
    this.legendIsDue = true;
    this.begunAt_ms = performance.now();
    this.marker.follow();
    this.ornaments.update(this.navigation.view());
    if (!this.tiles.isComplete) return;
    if (this.firstCompleteFrame === "missing") this.firstCompleteFrame = "begun";
    if (this.readyAt_ms !== null) this.selectWaitingPlace();
  }

  /** What was drawn is shown at the next turn of the browser's loop. */
  private followFirstFrame(): void {
    if (this.firstCompleteFrame === "drawn") {
      this.firstCompleteFrame = "shown";
      this.becomeReady();
    } else if (this.firstCompleteFrame === "begun" && this.city.lastFrame_ms < Infinity) {
      this.firstCompleteFrame = "drawn";
    }
  }

  private becomeReady(): void {
    this.readyAt_ms = performance.now();
    document.documentElement.dataset["ready"] = "true";
    if (this.grid.shown) this.grid.show(true);
    tell(`${this.view.name} is shown.`);
    this.onReady();
    this.tiles.sharpen();
    this.loadCrowns();
  }

  private restore(link: LinkedView): void {
    if (link.camera) this.navigation.set(cameraOf(link.camera, this.frames));
    if (link.layers) this.layers.choose(link.layers);
    if (link.projection) this.projection.value = link.projection;
    this.results.restore(link.results, link.divider);
    this.waitingPlace = link.place;
    this.theme.choose(link.theme);
    this.applyLayers();
  }

  /** The place of a link is picked when its tiles are there; those of the first frames may be coarser than the place. */
  private selectWaitingPlace(): void {
    if (!this.waitingPlace) return;
    const facet = this.facetAt(this.waitingPlace, reachOfLink_m);
    window.clearTimeout(this.simplifiedTimer);
    if (facet) this.select(facet);
    else this.simplifiedTimer = window.setTimeout(() => this.selectNearWaitingPlace(), beforeSimplified_ms);
  }

  /** A place on a simplified facet is on none of the finer ones: the facet before or behind it has to do. */
  private selectNearWaitingPlace(): void {
    const facet = this.waitingPlace && this.tiles.isComplete ? this.facetAt(this.waitingPlace, reachOfSimplified_m) : null;
    if (facet) this.select(facet);
  }

  private facetAt([x, y, z, azimuth_deg, tilt]: NonNullable<LinkedView["place"]>, reach_m: number): PickedFacet | null {
    const normal = this.frames.directionOf(azimuth_deg, tilt);
    const front = this.frames.localOf([x, y, z]).addScaledVector(normal, 0.5 * reach_m);
    return this.picker.along(front, normal.negate(), reach_m);
  }

  /** Writes the address some time after the last change, since browsers refuse many writes at once. */
  private noteLink(): void {
    window.clearTimeout(this.linkTimer);
    this.linkTimer = window.setTimeout(() => history.replaceState(null, "", hashOf(this.link())), 250);
  }

  private link(): LinkedView {
    const { selection } = this.place;
    return {
      camera: linkedCamera(this.navigation.view(), this.frames),
      place: this.waitingPlace ?? (selection ? linkedPlace(selection.facet, this.frames) : null),
      layers: this.layers.shown, theme: this.theme.choice, projection: this.skyProjection(),
      results: this.view.results.length > 0 ? this.results.choice : null, divider: this.results.dividerShare,
    };
  }

  private fail(error: unknown): void {
    showBanner(sentenceOf(error), () => void this.tryAgain());
  }

  private async tryAgain(): Promise<void> {
    try {
      await loadViewInfo();
    } catch (error) {
      showBanner(sentenceOf(error) + (isSilent(error) ? " It is still silent." : ""), () => void this.tryAgain());
      return;
    }
    hideBanner();
    this.tiles.retry();
    this.loadCrowns();
    this.place.askAgain();
  }
}
