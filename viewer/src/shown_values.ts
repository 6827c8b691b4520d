// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { Vector2 } from "three";
import { BuildingValues } from "./building_values.ts";
import { differencesOfRasters, GroundValues } from "./ground_values.ts";
import type { RasterResult, SurfacesResult } from "./results.ts";
import { differenceColours, rampTexture } from "./value_colours.ts";
import { commonRange, type Comparison, greatestDifference, isUnit, type SourcePair, usualDifference } from "./value_pairs.ts";

interface ValueChoice {
  ground: SourcePair<RasterResult>;
  buildings: SourcePair<SurfacesResult>;
  comparison: Comparison;
}

/** The numbers of the shader's variables `groundComparing` and `buildingsComparing`. What is paper has no colours in the legend. */
const comparingNothing = 0, comparingSideBySide = 1, comparingByDifference = 2, paper = 3;
/** Pairs of values that a scale of differences is made of. */
const mostPairs = 50000;

/** Which values the ground and the buildings show, and by which one scale of colours. */
export class ShownValues {
  readonly ground = new GroundValues();
  readonly buildings = new BuildingValues();
  private readonly range = { value: new Vector2(0, 1) };
  private readonly groundComparing = { value: comparingNothing };
  private readonly buildingsComparing = { value: comparingNothing };
  private readonly greatest = { value: usualDifference };
  private readonly divider_px = { value: 0 };
  private readonly differences = { value: rampTexture(differenceColours) };

  get uniforms(): Record<string, { value: unknown }> {
    return {
      ...this.ground.uniforms, ...this.buildings.uniforms, range: this.range, groundComparing: this.groundComparing,
      buildingsComparing: this.buildingsComparing, greatestDifference: this.greatest, divider_px: this.divider_px, differences: this.differences,
    };
  }

  /** Of the colours, which are the same on both sides of a divider. */
  get colouredRange(): [number, number] {
    return [this.range.value.x, this.range.value.y];
  }

  /** Differences are coloured from minus this to plus this. */
  get greatestDifference(): number {
    return this.greatest.value;
  }

  choose({ ground, buildings, comparison }: ValueChoice): void {
    this.ground.choose(ground);
    this.buildings.choose(buildings);
    const ofGround = commonRange(ground), ofBuildings = commonRange(buildings), range = legendRange(ofGround, ofBuildings);
    const byDifference = comparison === "difference" && (ground.compared !== null || buildings.compared !== null);
    const modeOf = (pair: SourcePair<unknown>, own: [number, number]): number => {
      if (byDifference) return pair.compared === null ? paper : comparingByDifference;
      if (isUnit(own) && !isUnit(range)) return paper;
      return pair.compared === null ? comparingNothing : comparingSideBySide;
    };
    this.range.value.set(...range);
    this.groundComparing.value = modeOf(ground, ofGround);
    this.buildingsComparing.value = modeOf(buildings, ofBuildings);
    if (byDifference) this.greatest.value = Math.max(...greatestOfGround(ground), ...greatestOfBuildings(buildings));
  }

  /** In pixels of the drawing, from its left. */
  setDivider(x_px: number): void {
    this.divider_px.value = x_px;
  }

  dispose(): void {
    this.ground.dispose();
    this.differences.value.dispose();
  }
}

/** The legend has one scale. Beside other quantities than shares of the sky, these are not shown. */
function legendRange(ground: [number, number], buildings: [number, number]): [number, number] {
  if (isUnit(ground)) return buildings;
  return isUnit(buildings) ? ground : [Math.min(ground[0], buildings[0]), Math.max(ground[1], buildings[1])];
}

/** None where nothing is compared. */
function greatestOfGround({ shown, compared }: SourcePair<RasterResult>): number[] {
  if (compared === null) return [];
  return [shown === "computed" || compared === "computed" ? usualDifference : greatestDifference(differencesOfRasters(shown, compared, mostPairs))];
}

function greatestOfBuildings({ shown, compared }: SourcePair<SurfacesResult>): number[] {
  if (compared === null) return [];
  return [shown === "computed" || compared === "computed" ? usualDifference : greatestDifference(shown.pairsWith(compared, mostPairs))];
}
