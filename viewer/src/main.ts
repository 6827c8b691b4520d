// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { sentenceOf, showBanner } from "./banner.ts";
import { NoWebGl } from "./city_scene.ts";
import { Page } from "./page.ts";
import { countText, part, showFacts } from "./page_parts.ts";
import { offerState } from "./test_hooks.ts";
import { loadViewInfo, type ViewInfo } from "./view_info.ts";

function showPackage(view: ViewInfo): void {
  document.title = `${view.name} – Far-LoD`;
  part("package-name").textContent = view.name.replace(/\.farlod$/, "");
  showFacts(part("package-facts"), [
    ["Reference system", view.epsg === null ? view.crs : `${view.crs} (EPSG:${view.epsg})`],
    ["Buildings", countText(view.counts.buildings)],
    ["Polygons", countText(view.counts.polygons)],
    ["Triangles", countText(view.counts.triangles)],
    ["Crowns of trees", view.counts.crowns > 0 ? countText(view.counts.crowns) : null],
    ["Cells", `${view.grid.cell_edge_m} m, ${view.grid.neighborhood} × ${view.grid.neighborhood} near`],
    ["Ground values", `${view.receiver_height_m} m above the ground`],
    ["Software", view.software],
  ]);
}

async function start(): Promise<void> {
  try {
    const view = await loadViewInfo();
    showPackage(view);
    offerState(new Page(view));
  } catch (error) {
    showBanner(sentenceOf(error), error instanceof NoWebGl ? null : () => location.reload());
  }
}

void start();
