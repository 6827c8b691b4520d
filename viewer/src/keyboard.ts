// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import type { Navigation } from "./navigation.ts";

/** Shares of the distance, and degrees, that one key moves and turns. */
const step = 0.12, turn_deg = 12, tilt_deg = 6, zoomFactor = 1.35;

export interface KeyActions {
  /** Asks for the place in the middle of the view. */
  choose(): void;
  close(): void;
  /** Shows the crowns of trees, or hides them. */
  toggleTrees(): void;
}

type Action = (event: KeyboardEvent) => void;

function actionsOf(navigation: Navigation, actions: KeyActions): Record<string, Action> {
  const arrow = (right: number, forward: number): Action => (event) => {
    if (event.shiftKey) navigation.turn(right * turn_deg, -forward * tilt_deg);
    else navigation.move(right * step, forward * step);
  };
  const nearer = (): void => navigation.zoom(1 / zoomFactor), farther = (): void => navigation.zoom(zoomFactor);
  return {
    ArrowLeft: arrow(-1, 0), ArrowRight: arrow(1, 0), ArrowUp: arrow(0, 1), ArrowDown: arrow(0, -1),
    "+": nearer, "=": nearer, "-": farther, "−": farther,
    n: () => navigation.northUp(), h: () => navigation.home(), t: () => actions.toggleTrees(), Enter: () => actions.choose(), Escape: () => actions.close(),
  };
}

/** Keys belong to the map where nothing else has the focus, but Esc, which always closes. */
export function listenToKeys(canvas: HTMLCanvasElement, navigation: Navigation, actions: KeyActions): void {
  const known = actionsOf(navigation, actions);
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const name = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const ofMap = document.activeElement === canvas || document.activeElement === document.body;
    const action = known[name];
    if (!action || (!ofMap && name !== "Escape")) return;
    event.preventDefault();
    action(event);
  });
}

export const zoomStep = zoomFactor;
