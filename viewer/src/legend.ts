// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { cssOf } from "./drawing.ts";
import { differenceColours } from "./value_colours.ts";
import { element, part } from "./page_parts.ts";
import type { Triple, ViewInfo } from "./view_info.ts";

const mostSteps = 7, ticksOfDifferences = 5;

interface Tick {
  value: number;
  /** Of the bar, from its left end. */
  share: number;
}

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
    this.show(title, this.view.colours, roundTicks(range[0], range[1]));
    const words = range[0] === 0 && range[1] === 1 ? "Colours from violet, no sky, over green to yellow, open sky"
      : `Colours from violet, ${tickText(range[0])}, over green to yellow, ${tickText(range[1])}`;
    this.ramp.setAttribute("aria-label", words);
  }

  showDifferences(title: string, greatest: number): void {
    this.show(title, differenceColours, evenTicks(-greatest, greatest));
    this.ramp.setAttribute("aria-label", `Colours from blue, ${tickText(-greatest)}, over white to red, ${tickText(greatest)}`);
  }

  /** Names the colour of no data where it is seen. */
  set namesNoData(isSeen: boolean) {
    part("nodata").hidden = !isSeen;
  }

  private show(title: string, colours: readonly Triple[], ticks: readonly Tick[]): void {
    const context = this.ramp.getContext("2d");
    this.ramp.width = colours.length;
    colours.forEach((colour, n) => {
      if (!context) return;
      context.fillStyle = cssOf(colour);
      context.fillRect(n, 0, 1, 1);
    });
    part("ramp-title").textContent = title;
    part("ticks").replaceChildren(...ticks.map(tickAt));
  }
}

function tickAt({ value, share }: Tick): HTMLElement {
  const tick = element("span", "", tickText(value));
  tick.style.left = `${100 * share}%`;
  return tick;
}

const evenTicks = (low: number, high: number): Tick[] =>
  Array.from({ length: ticksOfDifferences }, (_, n) => n / (ticksOfDifferences - 1))
    .map((share) => ({ value: low + (high - low) * share, share }));

/** Multiples of 1, 2 or 5 times a power of ten, as people read them, wherever the scale ends. */
function roundTicks(low: number, high: number): Tick[] {
  if (!(high > low)) return [{ value: low, share: 0 }];
  const atLeast = (high - low) / mostSteps, power = 10 ** Math.floor(Math.log10(atLeast));
  const step = power * ([1, 2, 5].find((digit) => digit * power >= atLeast) ?? 10);
  // Division may miss a whole number by its rounding
  const first = Math.ceil(low / step - 1e-9), last = Math.floor(high / step + 1e-9);
  return Array.from({ length: last - first + 1 }, (_, n) => (first + n) * step)
    .map((value) => ({ value, share: (value - low) / (high - low) }));
}

/** .2 rather than 0.2, as scales have it. */
const tickText = (value: number): string => String(Number(value.toPrecision(3))).replace("-", "−").replace(/^(−?)0\./, "$1.");
