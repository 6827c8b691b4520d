// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { countText, element, part } from "./page_parts.ts";
import { type ResultForm, type ResultInfo, titleOf } from "./results.ts";
import { type Comparison, comparisons } from "./value_pairs.ts";

/** Numbers of results, −1 for the values that are computed, null for no comparison. */
export interface NumberPair {
  shown: number;
  compared: number | null;
}

/** What the controls say. */
export interface ResultChoice {
  ground: NumberPair;
  buildings: NumberPair;
  comparison: Comparison;
  /** Of points and problems. */
  dots: number[];
}

export const computed = -1;

/** Two lists of sources: what is shown, and what it is compared with. They are hidden where there is nothing to choose. */
class PairOfLists {
  private readonly shown: HTMLSelectElement;
  private readonly compared: HTMLSelectElement;

  constructor(group: string, ids: { shown: string; compared: string }, form: ResultForm, results: readonly ResultInfo[], onChange: () => void) {
    this.shown = part(ids.shown, HTMLSelectElement);
    this.compared = part(ids.compared, HTMLSelectElement);
    const ofForm = [...results.entries()].filter(([, info]) => info.form === form);
    const sources: [number, string][] = [[computed, "computed values"], ...ofForm.map(([n, info]): [number, string] => [n, titleOf(info)])];
    for (const [n, title] of sources) this.shown.append(new Option(title, String(n)));
    this.compared.append(new Option("nothing", ""));
    for (const [n, title] of sources) this.compared.append(new Option(title, String(n)));
    part(group).hidden = ofForm.length === 0;
    for (const list of [this.shown, this.compared]) list.addEventListener("change", onChange);
  }

  get pair(): NumberPair {
    const compared = this.compared.value;
    return { shown: Number(this.shown.value), compared: compared === "" ? null : Number(compared) };
  }

  choose({ shown, compared }: NumberPair): void {
    chooseIn(this.shown, String(shown));
    chooseIn(this.compared, compared === null ? "" : String(compared));
  }
}

/** The boxes and lists that choose among results. Without any results, there are none. */
export class ResultControls {
  private readonly ground: PairOfLists;
  private readonly buildings: PairOfLists;
  private readonly comparison = part("comparison", HTMLSelectElement);
  private readonly boxes = new Map<number, HTMLInputElement>();

  constructor(results: readonly ResultInfo[], onChange: () => void) {
    this.ground = new PairOfLists("ground-results", { shown: "ground-values", compared: "compared" }, "raster", results, onChange);
    this.buildings = new PairOfLists("building-results", { shown: "building-values", compared: "buildings-compared" }, "surfaces", results, onChange);
    results.forEach((info, n) => {
      if (info.form === "points" || info.form === "problems") this.addBox(info, n);
    });
    this.comparison.addEventListener("change", onChange);
    for (const box of this.boxes.values()) box.addEventListener("change", onChange);
  }

  get choice(): ResultChoice {
    const dots = [...this.boxes].filter(([, box]) => box.checked).map(([n]) => n);
    return {
      ground: this.ground.pair, buildings: this.buildings.pair,
      comparison: comparisons.find((name) => name === this.comparison.value) ?? "divider", dots,
    };
  }

  /** What there is none of is left as it is. */
  choose(choice: ResultChoice): void {
    this.ground.choose(choice.ground);
    this.buildings.choose(choice.buildings);
    chooseIn(this.comparison, choice.comparison);
    for (const [n, box] of this.boxes) box.checked = choice.dots.includes(n);
    this.showComparison();
  }

  showComparison(): void {
    part("comparison-row").hidden = this.ground.pair.compared === null && this.buildings.pair.compared === null;
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
