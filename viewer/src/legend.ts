// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { cssOf } from "./drawing.ts";
import { differenceColours } from "./value_colours.ts";
import { element, part } from "./page_parts.ts";
import type { Triple, ViewInfo } from "./view_info.ts";

const ticksOfRange = 6, ticksOfDifferences = 5;

/** The colours of what the ground shows, and those of the bar below a value. */
export class Legend {
  private readonly ramp = part("ramp", HTMLCanvasElement);

  constructor(private readonly view: ViewInfo) {
    part("nodata-colour").style.background = cssOf(view.nodata_colour);
    const stops = view.colours.filter((_, n) => n % 15 === 0).map(cssOf);
    part("value-scale").style.background = `linear-gradient(to right, ${stops.join(", ")})`;
    this.showValues("Sky view factor", [0, 1]);
  }

  showValues(title: string, range: readonly [number, number]): void {
    this.show(title, this.view.colours, ticksBetween(range[0], range[1], ticksOfRange));
    const words = range[0] === 0 && range[1] === 1 ? "Colours from violet, no sky, over green to yellow, open sky"
      : `Colours from violet, ${tickText(range[0])}, over green to yellow, ${tickText(range[1])}`;
    this.ramp.setAttribute("aria-label", words);
  }

  showDifferences(title: string, greatest: number): void {
    this.show(title, differenceColours, ticksBetween(-greatest, greatest, ticksOfDifferences));
    this.ramp.setAttribute("aria-label", `Colours from blue, ${tickText(-greatest)}, over white to red, ${tickText(greatest)}`);
  }

  private show(title: string, colours: readonly Triple[], ticks: readonly number[]): void {
    const context = this.ramp.getContext("2d");
    this.ramp.width = colours.length;
    colours.forEach((colour, n) => {
      if (!context) return;
      context.fillStyle = cssOf(colour);
      context.fillRect(n, 0, 1, 1);
    });
    part("ramp-title").textContent = title;
    part("ticks").replaceChildren(...ticks.map((tick, n) => tickAt(tick, n / (ticks.length - 1))));
  }
}

function tickAt(value: number, share: number): HTMLElement {
  const tick = element("span", "", tickText(value));
  tick.style.left = `${100 * share}%`;
  return tick;
}

const ticksBetween = (low: number, high: number, count: number): number[] =>
  Array.from({ length: count }, (_, n) => low + ((high - low) * n) / (count - 1));

/** .2 rather than 0.2, as scales have it. */
const tickText = (value: number): string => String(Number(value.toPrecision(3))).replace("-", "−").replace(/^(−?)0\./, "$1.");
