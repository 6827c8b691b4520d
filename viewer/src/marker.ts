// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { Vector2, Vector3 } from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import type { CityScene } from "./city_scene.ts";
import type { PickedFacet, Picker } from "./picking.ts";

const colour = "#d81b60", step_px = 4, longStep_px = 24;
/** The line along the normal, as a share of the distance to the eye. */
const normalShare = 0.05;

/** The selected place on the screen: a button that can be dragged over the city, and a line along its facet's normal. */
export class Marker {
  private facet: PickedFacet | null = null;
  private readonly normalLine = new LineSegments2(new LineSegmentsGeometry(), new LineMaterial({ color: colour, linewidth: 2.5 }));
  private dragging = false;

  constructor(private readonly button: HTMLButtonElement, private readonly city: CityScene, private readonly picker: Picker,
              private readonly onMove: (facet: PickedFacet) => void, private readonly onDrag: (dragging: boolean) => void) {
    this.normalLine.visible = false;
    this.normalLine.frustumCulled = false;
    this.city.scene.add(this.normalLine);
    this.listen();
  }

  get isDragged(): boolean {
    return this.dragging;
  }

  show(facet: PickedFacet | null): void {
    this.facet = facet;
    this.normalLine.visible = facet !== null;
    this.button.hidden = facet === null;
    this.prepare();
    this.follow();
    this.city.redraw();
  }

  /** Before each frame: the line keeps its length on the screen. */
  prepare(): void {
    if (!this.facet) return;
    const { p_local, normal_local } = this.facet;
    const length_m = normalShare * this.city.camera.position.distanceTo(p_local);
    const end = p_local.clone().addScaledVector(normal_local, length_m);
    this.normalLine.geometry.setPositions([...p_local.toArray(), ...end.toArray()]);
  }

  /** After each frame, follows the camera. */
  follow(): void {
    if (!this.facet) return;
    const seen = this.facet.p_local.clone().project(this.city.camera), size = this.city.size();
    this.button.hidden = seen.z > 1 || Math.abs(seen.x) > 1 || Math.abs(seen.y) > 1;
    const x_px = 0.5 * (seen.x + 1) * size.x, y_px = 0.5 * (1 - seen.y) * size.y;
    this.button.style.transform = `translate(${x_px.toFixed(1)}px, ${y_px.toFixed(1)}px)`;
    this.button.classList.toggle("behind", !this.dragging && this.isBehind(this.facet.p_local));
  }

  private isBehind(p_local: Vector3): boolean {
    const eye = this.city.camera.position, sight = p_local.clone().sub(eye), distance_m = sight.length();
    return this.picker.along(eye, sight.normalize(), 0.995 * distance_m - 0.2) !== null;
  }

  private listen(): void {
    this.button.addEventListener("pointerdown", (event) => {
      this.button.setPointerCapture(event.pointerId);
      this.setDragging(true);
    });
    this.button.addEventListener("pointermove", (event) => {
      if (this.dragging) this.moveTo(event.clientX, event.clientY);
    });
    for (const end of ["pointerup", "pointercancel"] as const) this.button.addEventListener(end, () => this.setDragging(false));
    this.button.addEventListener("keydown", (event) => this.step(event));
  }

  private setDragging(dragging: boolean): void {
    this.dragging = dragging;
    this.onDrag(dragging);
  }

  private step(event: KeyboardEvent): void {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!step || !this.facet) return;
    event.preventDefault();
    event.stopPropagation();
    const { left, top, width } = this.button.getBoundingClientRect(), pixels = event.shiftKey ? longStep_px : step_px;
    this.moveTo(left + 0.5 * width + pixels * (step[0] ?? 0), top + 0.5 * width + pixels * (step[1] ?? 0));
  }

  private moveTo(x_px: number, y_px: number): void {
    const size = this.city.size();
    const facet = this.picker.below(new Vector2((x_px / size.x) * 2 - 1, 1 - (y_px / size.y) * 2), this.city.camera);
    if (facet) this.onMove(facet);
  }
}
