// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { isSilent, sentenceOf, tell } from "./banner.ts";
import type { Frames } from "./frames.ts";
import { LatestOnly } from "./latest_only.ts";
import type { PickedFacet } from "./picking.ts";
import type { PlacePanel } from "./place_panel.ts";
import { type Selection, selectionOf } from "./selection.ts";
import { askAt, askHemisphere, type PointAnswer } from "./server.ts";
import type { SkyProjection } from "./sky_projection.ts";

/** The selected place: asks the server for its value and for what it sees, one question at a time. */
export class PlaceView {
  private selected: Selection | null = null;
  private lastAnswer: PointAnswer | null = null;
  private hasSky = false;
  private readonly question = new LatestOnly<Selection>((selection) => this.ask(selection));

  constructor(private readonly frames: Frames, private readonly panel: PlacePanel, private readonly canAnswer: boolean,
              private readonly projection: () => SkyProjection, private readonly onError: (error: unknown) => void) {}

  get selection(): Selection | null {
    return this.selected;
  }

  /** The answer for the selected place, once it has come. */
  get answer(): PointAnswer | null {
    return this.lastAnswer;
  }

  get isAsking(): boolean {
    return this.question.isBusy;
  }

  get isAnswered(): boolean {
    return !this.question.isBusy && this.lastAnswer !== null;
  }

  get skyIsDrawn(): boolean {
    return this.hasSky && !this.question.isBusy;
  }

  select(facet: PickedFacet): void {
    this.selected = selectionOf(facet, this.frames);
    this.lastAnswer = null;
    this.panel.showFacet(this.selected);
    if (this.canAnswer) this.question.ask(this.selected);
  }

  clear(): void {
    this.selected = this.lastAnswer = null;
  }

  /** After an error. */
  askAgain(): void {
    if (this.selected && this.canAnswer) this.question.ask(this.selected);
  }

  private async ask(selection: Selection): Promise<void> {
    try {
      const answer = await askAt(selection.receiver);
      if (!this.selected) return;
      this.lastAnswer = answer;
      this.panel.showAnswer(answer, selection);
      tell(answer.svf === null ? "No data at this place." : `Sky view factor ${answer.text}, ${selection.facet.building || "ground"}.`);
      const hemisphere = await askHemisphere(selection.receiver);
      this.panel.showHemisphere(hemisphere, this.projection());
      this.hasSky = hemisphere !== null;
    } catch (error) {
      this.panel.showFailure(sentenceOf(error));
      if (isSilent(error)) this.onError(error);
    }
  }
}
