// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { Vector3 } from "three";
import type { Picker } from "./picking.ts";

const down = new Vector3(0, 0, -1);
/** Corners of cells are where tiles meet, and a ray may pass between two: then one close by has to do. */
const beside: readonly (readonly [number, number])[] = [[0, 0], [0.1, 0.03], [-0.03, 0.1], [-0.1, -0.03], [0.03, -0.1]];

/** Heights of the ground as far as its tiles are loaded; the lowest height of the package elsewhere. */
export class GroundHeights {
  private readonly known = new Map<string, number>();

  constructor(private readonly picker: Picker, private readonly heights_m: [number, number]) {}

  at(x_local: number, y_local: number): number {
    const key = `${x_local.toFixed(1)},${y_local.toFixed(1)}`, known = this.known.get(key);
    if (known !== undefined) return known;
    for (const [dx, dy] of beside) {
      const ground_m = this.below(x_local + dx, y_local + dy);
      if (ground_m === null) continue;
      this.known.set(key, ground_m);
      return ground_m;
    }
    return this.heights_m[0];
  }

  private below(x_local: number, y_local: number): number | null {
    const top_m = this.heights_m[1] + 10;
    return this.picker.ground(new Vector3(x_local, y_local, top_m), down, top_m - this.heights_m[0] + 20);
  }
}
