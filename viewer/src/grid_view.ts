// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { isSilent, sentenceOf, tell } from "./banner.ts";
import type { CellPanel } from "./cell_panel.ts";
import type { Frames } from "./frames.ts";
import type { GridLines } from "./grid_lines.ts";
import { LatestOnly } from "./latest_only.ts";
import type { PickedFacet } from "./picking.ts";
import { askCell } from "./server.ts";
import type { CellIndex } from "./view_info.ts";

/** The grid of cells: which one is under the pointer, and the facts of the chosen one. */
export class GridView {
  private chosenCell: CellIndex | null = null;
  private isShown = false;
  private readonly question = new LatestOnly<CellIndex>((cell) => this.ask(cell));

  constructor(private readonly frames: Frames, private readonly lines: GridLines, private readonly panel: CellPanel,
              private readonly redraw: () => void, private readonly onError: (error: unknown) => void) {}

  get chosen(): CellIndex | null {
    return this.chosenCell;
  }

  get shown(): boolean {
    return this.isShown;
  }

  show(shown: boolean): void {
    this.isShown = shown;
    this.lines.object.visible = shown;
    if (shown) this.lines.drape();
    else this.clear();
    this.redraw();
  }

  /** Of what lies under the pointer; the chosen cell where nothing does. */
  hover(facet: PickedFacet | null): void {
    if (!this.isShown) return;
    this.lines.highlight((facet && this.frames.cellAt(facet.p_local.x, facet.p_local.y)) ?? this.chosenCell);
    this.redraw();
  }

  choose(facet: PickedFacet): void {
    const cell = this.frames.cellAt(facet.p_local.x, facet.p_local.y);
    if (!cell) return;
    if (this.chosenCell && cell[0] === this.chosenCell[0] && cell[1] === this.chosenCell[1]) return;
    this.chosenCell = cell;
    this.lines.highlight(cell);
    this.question.ask(cell);
  }

  clear(): void {
    this.chosenCell = null;
    this.lines.highlight(null);
    this.lines.showEdges(null);
    this.panel.hide();
    this.redraw();
  }

  private async ask(cell: CellIndex): Promise<void> {
    try {
      const facts = await askCell(cell);
      if (!this.chosenCell) return;
      this.panel.show(facts);
      this.lines.showEdges(facts.far);
      tell(`Cell ${cell[0]}, ${cell[1]}: ${facts.buildings} buildings, ${facts.explicit_edges} explicit edges.`);
    } catch (error) {
      this.chosenCell = null;
      if (isSilent(error)) this.onError(error);
      else this.panel.showFailure(sentenceOf(error));
    }
    this.redraw();
  }
}
