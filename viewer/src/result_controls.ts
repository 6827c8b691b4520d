// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { type Comparison, comparisons } from "./ground_values.ts";
import { countText, element, part } from "./page_parts.ts";
import { type ResultInfo, titleOf } from "./results.ts";

/** What the controls say: numbers of results, −1 for the values that are computed, null for no comparison. */
export interface ResultChoice {
  shown: number;
  compared: number | null;
  comparison: Comparison;
  /** Of points and problems. */
  dots: number[];
}

export const computed = -1;

/** The boxes and lists that choose among results. Without any results, there are none. */
export class ResultControls {
  private readonly shown = part("ground-values", HTMLSelectElement);
  private readonly compared = part("compared", HTMLSelectElement);
  private readonly comparison = part("comparison", HTMLSelectElement);
  private readonly boxes = new Map<number, HTMLInputElement>();

  constructor(results: readonly ResultInfo[], onChange: () => void) {
    const rasters = [...results.entries()].filter(([, info]) => info.form === "raster");
    const sources: [number, string][] = [[computed, "computed values"], ...rasters.map(([n, info]): [number, string] => [n, titleOf(info)])];
    for (const [n, title] of sources) this.shown.append(new Option(title, String(n)));
    this.compared.append(new Option("nothing", ""));
    for (const [n, title] of sources) this.compared.append(new Option(title, String(n)));
    part("results").hidden = rasters.length === 0;
    results.forEach((info, n) => {
      if (info.form !== "raster") this.addBox(info, n);
    });
    for (const list of [this.shown, this.compared, this.comparison]) list.addEventListener("change", onChange);
    for (const box of this.boxes.values()) box.addEventListener("change", onChange);
  }

  get choice(): ResultChoice {
    const dots = [...this.boxes].filter(([, box]) => box.checked).map(([n]) => n), compared = this.compared.value;
    return {
      shown: Number(this.shown.value), compared: compared === "" ? null : Number(compared),
      comparison: comparisons.find((name) => name === this.comparison.value) ?? "divider", dots,
    };
  }

  /** What there is none of is left as it is. */
  choose(choice: ResultChoice): void {
    chooseIn(this.shown, String(choice.shown));
    chooseIn(this.compared, choice.compared === null ? "" : String(choice.compared));
    chooseIn(this.comparison, choice.comparison);
    for (const [n, box] of this.boxes) box.checked = choice.dots.includes(n);
    this.showComparison();
  }

  showComparison(): void {
    part("comparison-row").hidden = this.choice.compared === null;
  }

  private addBox(info: ResultInfo, n: number): void {
    const box = document.createElement("input"), label = element("label");
    box.type = "checkbox";
    box.id = `result-${n}`;
    box.checked = true;
    label.append(box, ` ${titleOf(info)} (${countText(info.count)})`);
    part("layers").append(label);
    this.boxes.set(n, box);
  }
}

function chooseIn(list: HTMLSelectElement, value: string): void {
  if ([...list.options].some((option) => option.value === value)) list.value = value;
}
