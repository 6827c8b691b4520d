// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { Vector2 } from "three";

/** Farther than this, or longer, and it was a drag of the map. */
const greatestMove_px = 5, greatestTime_ms = 600;

const placeOn = (canvas: HTMLCanvasElement, event: PointerEvent): Vector2 => {
  const box = canvas.getBoundingClientRect();
  return new Vector2(((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2);
};

/** Tells clicks on the canvas from drags, and where the pointer hovers; places are from −1 to 1 rightwards and upwards. */
export function listenToPointer(canvas: HTMLCanvasElement, onClick: (place: Vector2) => void,
                                onHover: (place: Vector2 | null) => void): void {
  let down: { x: number; y: number; time_ms: number } | null = null;
  canvas.addEventListener("pointerdown", (event) => {
    down = event.isPrimary && event.button === 0 ? { x: event.clientX, y: event.clientY, time_ms: event.timeStamp } : null;
    canvas.classList.add("panning");
    onHover(null);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (event.buttons === 0 && event.pointerType === "mouse") onHover(placeOn(canvas, event));
  });
  canvas.addEventListener("pointerleave", () => onHover(null));
  canvas.addEventListener("pointerup", (event) => {
    canvas.classList.remove("panning");
    const began = down;
    down = null;
    if (!began || !event.isPrimary || event.timeStamp - began.time_ms > greatestTime_ms) return;
    if (Math.hypot(event.clientX - began.x, event.clientY - began.y) <= greatestMove_px) onClick(placeOn(canvas, event));
  });
  canvas.addEventListener("pointercancel", () => {
    down = null;
    canvas.classList.remove("panning");
  });
}
