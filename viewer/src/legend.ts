// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { cssOf } from "./drawing.ts";
import { part } from "./page_parts.ts";
import type { ViewInfo } from "./view_info.ts";

/** The colours of the legend and of the bar below a value. */
export function showLegend(view: ViewInfo): void {
  const canvas = part("ramp", HTMLCanvasElement), context = canvas.getContext("2d");
  canvas.width = view.colours.length;
  view.colours.forEach((colour, n) => {
    if (!context) return;
    context.fillStyle = cssOf(colour);
    context.fillRect(n, 0, 1, 1);
  });
  part("nodata-colour").style.background = cssOf(view.nodata_colour);
  const stops = view.colours.filter((_, n) => n % 15 === 0).map(cssOf);
  part("value-scale").style.background = `linear-gradient(to right, ${stops.join(", ")})`;
}
