// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { type PerspectiveCamera, Vector3 } from "three";
import { MapControls } from "three/addons/controls/MapControls.js";
import { type Frames, turned } from "./frames.ts";

const degree = Math.PI / 180;
const greatestTilt_deg = 89, tiltAtHome_deg = 52;
/** A city with a larger radius is first seen in a part with the second one, from steeper above: fewer tiles are in view. */
const greatestWhole_m = 4000, middleOfLarge_m = 1500, tiltOfLarge_deg = 35;

/** What the camera looks at. The bearing is where it looks, clockwise from the local y axis; a tilt of 0 looks straight down. */
export interface CameraView {
  target_local: Vector3;
  distance_m: number;
  bearing_deg: number;
  tilt_deg: number;
}

const stillness = typeof matchMedia === "function" && matchMedia("(prefers-reduced-motion: reduce)").matches;
const flight_ms = stillness ? 0 : 350;

/** Moves the camera by mouse, touch and keyboard. */
export class Navigation {
  private readonly controls: MapControls;
  private flight: { from: CameraView; to: CameraView; begin_ms: number } | null = null;
  private moved = true;

  constructor(private readonly camera: PerspectiveCamera, canvas: HTMLCanvasElement, private readonly frames: Frames,
              private readonly heights_m: [number, number]) {
    this.controls = new MapControls(camera, canvas);
    this.controls.enableDamping = !stillness;
    this.controls.dampingFactor = 0.18;
    this.controls.zoomToCursor = true;
    this.controls.zoomSpeed = 1.4;
    this.controls.minDistance = 3;
    this.controls.maxDistance = 8 * frames.extent().radius_m;
    this.controls.maxPolarAngle = greatestTilt_deg * degree;
    this.controls.addEventListener("change", () => {
      this.moved = true;
    });
    this.controls.addEventListener("start", () => {
      this.flight = null;
    });
    this.set(this.firstView());
  }

  /** While a marker is dragged, the city stands still. */
  set enabled(enabled: boolean) {
    this.controls.enabled = enabled;
  }

  get isFlying(): boolean {
    return this.flight !== null;
  }

  /** The whole city; of a very large one, whose tiles would take a minute, its middle. */
  firstView(): CameraView {
    return this.frames.extent().radius_m > greatestWhole_m ? { ...this.viewOf(middleOfLarge_m), tilt_deg: tiltOfLarge_deg } : this.homeView();
  }

  homeView(): CameraView {
    return this.viewOf(this.frames.extent().radius_m);
  }

  private viewOf(radius_m: number): CameraView {
    const { middle } = this.frames.extent();
    const narrow = Math.min(1, this.camera.aspect);
    const distance_m = (0.92 * radius_m) / Math.tan(0.5 * this.camera.fov * degree) / narrow;
    const target_local = new Vector3(...middle, this.heights_m[0]);
    return { target_local, distance_m, bearing_deg: this.northUp_deg(), tilt_deg: tiltAtHome_deg };
  }

  view(): CameraView {
    const back = this.camera.position.clone().sub(this.controls.target), distance_m = back.length();
    return {
      target_local: this.controls.target.clone(),
      distance_m,
      bearing_deg: turned(-this.controls.getAzimuthalAngle() / degree),
      tilt_deg: Math.acos(Math.min(1, back.z / distance_m)) / degree,
    };
  }

  set(view: CameraView): void {
    const bearing = view.bearing_deg * degree, tilt = Math.min(greatestTilt_deg, Math.max(0.001, view.tilt_deg)) * degree;
    this.controls.target.copy(view.target_local);
    this.camera.position.set(-Math.sin(tilt) * Math.sin(bearing), -Math.sin(tilt) * Math.cos(bearing), Math.cos(tilt))
      .multiplyScalar(view.distance_m).add(view.target_local);
    this.controls.update();
    this.moved = true;
  }

  flyTo(to: Partial<CameraView>): void {
    const from = this.flight?.to ?? this.view();
    this.flight = { from: this.view(), to: { ...from, ...to }, begin_ms: performance.now() };
  }

  home(): void {
    this.flyTo(this.homeView());
  }

  northUp(): void {
    this.flyTo({ bearing_deg: this.northUp_deg() });
  }

  zoom(factor: number): void {
    const aim = this.flight?.to ?? this.view();
    this.flyTo({ distance_m: Math.min(this.controls.maxDistance, Math.max(this.controls.minDistance, aim.distance_m * factor)) });
  }

  turn(bearing_deg: number, tilt_deg: number): void {
    const aim = this.flight?.to ?? this.view();
    const tilt = Math.min(greatestTilt_deg, Math.max(0, aim.tilt_deg + tilt_deg));
    this.flyTo({ bearing_deg: aim.bearing_deg + bearing_deg, tilt_deg: tilt });
  }

  /** By shares of the distance, rightwards and forwards as the user sees it. */
  move(right: number, forward: number): void {
    const aim = this.flight?.to ?? this.view(), bearing = aim.bearing_deg * degree;
    const step = new Vector3(
      right * Math.cos(bearing) + forward * Math.sin(bearing), -right * Math.sin(bearing) + forward * Math.cos(bearing), 0);
    this.flyTo({ target_local: aim.target_local.clone().addScaledVector(step, aim.distance_m) });
  }

  /** Before each frame; whether the camera has moved since the last one. */
  update(): boolean {
    if (this.flight) this.fly();
    else this.controls.update();
    const moved = this.moved;
    this.moved = false;
    if (moved) this.adaptDepth();
    return moved;
  }

  /** True north, as fisheyes have it. */
  private northUp_deg(): number {
    return -this.frames.grid.convergence_deg;
  }

  private fly(): void {
    if (!this.flight) return;
    const { from, to, begin_ms } = this.flight;
    const t = flight_ms > 0 ? Math.min(1, (performance.now() - begin_ms) / flight_ms) : 1, s = 1 - (1 - t) ** 3;
    const mixed = (a: number, b: number): number => a + s * (b - a);
    // The short way round
    const turn_deg = turned(to.bearing_deg - from.bearing_deg + 180) - 180;
    this.set({
      target_local: from.target_local.clone().lerp(to.target_local, s),
      distance_m: Math.exp(mixed(Math.log(from.distance_m), Math.log(to.distance_m))),
      bearing_deg: from.bearing_deg + s * turn_deg,
      tilt_deg: mixed(from.tilt_deg, to.tilt_deg),
    });
    if (t === 1) this.flight = null;
  }

  /** The nearest and farthest depth: floats are fine enough for a street or for a city, not for both at once. */
  private adaptDepth(): void {
    const { middle, radius_m } = this.frames.extent(), eye = this.camera.position;
    const toMiddle = Math.hypot(eye.x - middle[0], eye.y - middle[1]);
    const above = Math.max(0, eye.z - this.heights_m[1], toMiddle - 1.2 * radius_m);
    this.camera.near = Math.max(0.3, 0.5 * above);
    this.camera.far = Math.hypot(toMiddle + 1.5 * radius_m, eye.z - this.heights_m[0]) + 100;
    this.camera.updateProjectionMatrix();
  }
}
