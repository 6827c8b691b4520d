// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import type { LayerName } from "./link.ts";
import { part } from "./page_parts.ts";

const names: readonly LayerName[] = ["ground", "roofs", "facades", "grid", "trees"];

/** On a screen as small as style.css has it, the boxes and lists would cover the city: they are folded until somebody opens them. */
const smallScreen = "(max-width: 760px)";

/** The boxes that switch layers. */
export class LayerBoxes {
  private readonly boxes = new Map(names.map((name) => [name, part(`layer-${name}`, HTMLInputElement)]));

  constructor(onChange: () => void) {
    for (const box of this.boxes.values()) box.addEventListener("change", onChange);
    part("controls", HTMLDetailsElement).open = !window.matchMedia(smallScreen).matches;
  }

  /** Takes a box away that would switch nothing. */
  remove(name: LayerName): void {
    const box = this.boxes.get(name);
    box?.closest("label")?.setAttribute("hidden", "");
    this.boxes.delete(name);
  }

  toggle(name: LayerName): void {
    this.boxes.get(name)?.click();
  }

  shows(name: LayerName): boolean {
    return this.boxes.get(name)?.checked ?? false;
  }

  get shown(): LayerName[] {
    return names.filter((name) => this.shows(name));
  }

  choose(shown: readonly LayerName[]): void {
    for (const [name, box] of this.boxes) box.checked = shown.includes(name);
  }
}
