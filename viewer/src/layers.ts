// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import type { LayerName } from "./link.ts";
import { part } from "./page_parts.ts";

const names: readonly LayerName[] = ["ground", "roofs", "facades", "grid"];

/** On a screen as small as style.css has it, the boxes and lists would cover the city: they are folded until somebody opens them. */
const smallScreen = "(max-width: 760px)";

/** The boxes that switch layers. */
export class LayerBoxes {
  private readonly boxes = new Map(names.map((name) => [name, part(`layer-${name}`, HTMLInputElement)]));

  constructor(onChange: () => void) {
    for (const box of this.boxes.values()) box.addEventListener("change", onChange);
    part("controls", HTMLDetailsElement).open = !window.matchMedia(smallScreen).matches;
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
