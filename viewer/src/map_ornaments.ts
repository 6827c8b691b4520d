// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { part } from "./page_parts.ts";
import type { CityScene } from "./city_scene.ts";
import type { Frames } from "./frames.ts";
import type { CameraView } from "./navigation.ts";

const longest_px = 120, shortest_px = 45;

/** The round length whose bar is as long as may be. */
export function roundLength_m(metresOfPixel: number): number {
  const lengths = [...Array(7).keys()].flatMap((n) => [1, 2, 5].map((digit) => digit * 10 ** (n - 1)));
  return lengths.filter((length_m) => length_m / metresOfPixel <= longest_px).pop() ?? 0.1;
}

/** The scale bar holds at the middle of the view; the arrow shows true north. */
export class MapOrnaments {
  private readonly bar = part("scale-bar");
  private readonly text = part("scale-text");
  private readonly arrow = part("north-arrow", SVGElement);

  constructor(private readonly city: CityScene, private readonly frames: Frames) {}

  update(view: CameraView): void {
    const metresOfPixel = (2 * view.distance_m * Math.tan((0.5 * this.city.camera.fov * Math.PI) / 180)) / this.city.size().y;
    const length_m = roundLength_m(metresOfPixel), text = length_m < 1000 ? `${length_m} m` : `${length_m / 1000} km`;
    this.bar.style.width = `${Math.max(shortest_px / 3, length_m / metresOfPixel).toFixed(1)}px`;
    this.text.textContent = text;
    part("scale").setAttribute("aria-label", `Scale bar of ${text}, in the middle of the view`);
    this.arrow.style.transform = `rotate(${(-(view.bearing_deg + this.frames.grid.convergence_deg)).toFixed(2)}deg)`;
  }
}
