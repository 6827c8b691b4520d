// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { lineColours, partColours, cssOf } from "./drawing.ts";
import { drawFarPanorama } from "./far_panorama.ts";
import type { Frames } from "./frames.ts";
import { bytesText, countText, element, part, showFacts } from "./page_parts.ts";
import type { CellFacts, FarView } from "./server.ts";

const sentences = {
  near: "Near geometry: what lies in these cells is used without simplification.",
  explicit: "Far edges that may rise noticeably over everything else are stored as edges, and each receiver sees them from where " +
    "it stands. They are the orange lines in the city.",
  residual: "All other far geometry is left to the residual horizon: for each azimuth the slope that is hidden for certain, the one " +
    "above which all is sky, and an estimate between them. This is the layer nearest to the ground, seen from the middle of the cell.",
  noFar: "This cell has no far map: there is nothing but near geometry, or it lies outside of the area that was packed.",
  box: "The far map of this package is a box map, the picture of the far city on the walls around the neighbourhood; it has no " +
    "edges and no residual horizon.",
} as const;

/** What is told of a cell: the method, step by step. */
export class CellPanel {
  private readonly root = part("cell");
  private shown: FarView | null = null;
  private panorama: HTMLCanvasElement | null = null;

  constructor(private readonly frames: Frames, private readonly farMapKind: string) {}

  show(facts: CellFacts): void {
    this.root.hidden = false;
    this.root.replaceChildren(headingOf(facts), sizesOf(facts), this.nearOf(facts), ...this.farOf(facts));
    this.redraw();
  }

  showFailure(sentence: string): void {
    this.root.hidden = false;
    this.root.replaceChildren(note(sentence));
  }

  hide(): void {
    this.root.hidden = true;
    this.root.replaceChildren();
    this.shown = this.panorama = null;
  }

  /** After a change of the theme. */
  redraw(): void {
    if (this.shown && this.panorama) drawFarPanorama(this.panorama, this.shown, this.frames);
  }

  private nearOf(facts: CellFacts): HTMLElement {
    const triangles = facts.near_cells.reduce((sum, near) => sum + near.triangles, 0), section = element("section");
    section.append(heading(`Near: ${countText(triangles)} triangles`), note(sentences.near), nearTable(facts));
    return section;
  }

  private farOf(facts: CellFacts): HTMLElement[] {
    const { far } = facts, explicit = element("section"), residual = element("section");
    if (!far) {
      explicit.append(heading("Far"), note(this.farMapKind === "box" ? sentences.box : sentences.noFar));
      this.shown = this.panorama = null;
      return [explicit];
    }
    explicit.append(heading(`Far, by name: ${countText(facts.explicit_edges)} explicit edges`), note(sentences.explicit));
    this.shown = far;
    this.panorama = document.createElement("canvas");
    this.panorama.className = "panorama";
    this.panorama.setAttribute("role", "img");
    this.panorama.setAttribute("aria-label", panoramaLabel(far));
    residual.append(heading("Far, the rest: the residual horizon"), this.panorama, keyOfPanorama(), note(sentences.residual));
    return [explicit, residual];
  }
}

const heading = (text: string): HTMLElement => element("h3", "", text);
const note = (text: string): HTMLElement => element("p", "note", text);
const headingOf = (facts: CellFacts): HTMLElement => element("h2", "", `Cell ${facts.cell[0]}, ${facts.cell[1]}`);

function sizesOf(facts: CellFacts): HTMLElement {
  const list = element("dl"), { low_m, high_m } = facts;
  const heights = low_m === null || high_m === null ? null : `${low_m.toFixed(1)} to ${high_m.toFixed(1)} m`;
  showFacts(list, [
    ["Buildings", countText(facts.buildings)],
    ["Triangles, vertices", `${countText(facts.triangles)}, ${countText(facts.vertices)}`],
    ["Grounded edges", countText(facts.grounded_edges)],
    ["Overhang edges", countText(facts.overhang_edges)],
    ["Heights", heights],
    ["Tile, far map", `${bytesText(facts.tile_bytes)}, ${bytesText(facts.far_map_bytes)}`],
  ]);
  return list;
}

/** The cells of the neighbourhood as they lie, with their triangles. */
function nearTable(facts: CellFacts): HTMLElement {
  const table = element("table", "near-table"), { i_begin, i_end, j_begin, j_end } = facts.neighborhood;
  table.setAttribute("aria-label", "Triangles of the cells of the neighbourhood");
  const triangles = new Map(facts.near_cells.map((near) => [near.cell.join(), near.triangles]));
  for (let j = j_end - 1; j >= j_begin; --j) {
    const row = element("tr");
    for (let i = i_begin; i < i_end; ++i)
      row.append(element("td", `${i},${j}` === facts.cell.join() ? "middle" : "", countText(triangles.get(`${i},${j}`) ?? 0)));
    table.append(row);
  }
  return table;
}

function keyOfPanorama(): HTMLElement {
  const list = element("ul", "key-list");
  const add = (words: string, colour: string, kind: string): void => {
    const row = element("li"), swatch = element("span", kind);
    swatch.style.background = colour;
    row.append(swatch, words);
    list.append(row);
  };
  add("hidden for certain (low)", lineColours.hidden, "swatch");
  add("undecided (up to high)", lineColours.undecided, "swatch");
  add("estimate", lineColours.horizon, "line-swatch");
  add("explicit edges", lineColours.edge, "line-swatch");
  add("sky, as far as the far city goes", cssOf(partColours.sky), "swatch");
  return list;
}

function panoramaLabel(far: FarView): string {
  const highest = (slopes: readonly number[]): string => ((Math.atan(Math.max(...slopes)) * 180) / Math.PI).toFixed(1);
  const elevations = `${highest(far.low)}° for certain, ${highest(far.estimate)}° as estimated, ${highest(far.high)}° at the most`;
  return `Panorama of the residual horizon: its highest elevation is ${elevations}.`;
}
