// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { WebGLRenderTarget } from "three";
import type { CityScene } from "./city_scene.ts";

/** Finer than what is seen of a city; a frame of this size takes little even without a graphics processor. */
const columns = 320, rows = 200;
/** Neither a ramp nor anything else that is drawn has it, however it is dimmed. */
const marker = [1, 0, 1] as const;

/** Tells whether a spot without data is seen: many facets have none, most of which others hide. */
export class NoDataCheck {
  private readonly target = new WebGLRenderTarget(columns, rows);
  private readonly pixels = new Uint8Array(4 * columns * rows);

  /** `colour` is that of no data, in the shaders. */
  constructor(private readonly city: CityScene, private readonly colour: { value: readonly number[] }) {}

  /** Draws the scene once more, small, with another colour of no data. */
  isSeen(): boolean {
    const { renderer, scene, camera } = this.city, own = this.colour.value;
    this.colour.value = marker;
    renderer.setRenderTarget(this.target);
    renderer.render(scene, camera);
    renderer.readRenderTargetPixels(this.target, 0, 0, columns, rows, this.pixels);
    renderer.setRenderTarget(null);
    this.colour.value = own;
    for (let row = 1; row + 1 < rows; ++row)
      for (let column = 1; column + 1 < columns; ++column) if (this.isSpotAround(column, row)) return true;
    return false;
  }

  /** Ground at the feet of walls has none in slivers, which nobody takes for a colour of the legend. */
  private isSpotAround(column: number, row: number): boolean {
    for (let r = row - 1; r <= row + 1; ++r)
      for (let c = column - 1; c <= column + 1; ++c) if (!this.hasMarker(4 * (r * columns + c))) return false;
    return true;
  }

  private hasMarker(n: number): boolean {
    const [red = 0, green = 0, blue = 0] = this.pixels.subarray(n, n + 3);
    return red > 150 && blue > 150 && green < 20;
  }

  dispose(): void {
    this.target.dispose();
  }
}
