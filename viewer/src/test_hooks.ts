// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import type { CellIndex, Triple } from "./view_info.ts";
import type { CameraView } from "./navigation.ts";
import type { Page } from "./page.ts";
import type { PickedFacet } from "./picking.ts";

/** What tests ask of the page: `farlod.state()`. The attribute `data-ready` of the document says when it is worth asking. */
interface PageState {
  loaded: boolean;
  /** The camera stands still, all tiles are drawn, and no question is open. */
  resting: boolean;
  readyAt_ms: number | null;
  visibleTiles: number;
  /** Columns of crowns. */
  drawnCrowns: number;
  drawnFrames: number;
  camera: CameraView;
  picked: (Omit<PickedFacet, "p_local" | "normal_local"> & { projected_m: Triple }) | null;
  answer: string | null;
  skyIsDrawn: boolean;
  cell: CellIndex | null;
}

declare global {
  interface Window {
    farlod?: { state(): PageState };
  }
}

export function offerState(page: Page): void {
  window.farlod = { state: () => stateOf(page) };
}

function stateOf(page: Page): PageState {
  return {
    loaded: page.readyAt_ms !== null && page.tiles.isComplete,
    resting: page.isResting,
    readyAt_ms: page.readyAt_ms,
    visibleTiles: page.tiles.visibleTiles,
    drawnCrowns: page.crowns.drawn,
    drawnFrames: page.city.renderer.info.render.frame,
    camera: page.navigation.view(),
    picked: page.place.selection && pickedOf(page.place.selection.facet, page),
    answer: page.place.isAnswered ? (page.place.answer?.text ?? "no data") : null,
    skyIsDrawn: page.place.skyIsDrawn,
    cell: page.grid.chosen,
  };
}

function pickedOf({ p_local, building, surface, kind, svf, isSimplified }: PickedFacet, page: Page): PageState["picked"] {
  return { building, surface, kind, svf, isSimplified, projected_m: page.frames.projectedOf(p_local) };
}
