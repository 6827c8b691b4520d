// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { Color, PerspectiveCamera, Scene, Vector2, WebGLRenderer } from "three";
import { FrameStopwatch } from "./frame_stopwatch.ts";

/** The browser cannot draw. */
export class NoWebGl extends Error {
  constructor() {
    super("This browser offers no WebGL 2, without which the city cannot be drawn. Another browser may, or a graphics driver has to " +
      "be enabled.");
  }
}

/** Screens with more pixels a point gain nothing that is worth four times the work. */
const greatestPixelRatio = 2;

/** The canvas, its camera, and when it is drawn: only when something has changed. */
export class CityScene {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(40, 1, 1, 10000);
  readonly renderer: WebGLRenderer;
  private readonly stopwatch: FrameStopwatch;
  private dirty = true;
  private moving = true;
  private isHeld = true;
  private frame = 0;

  /** `beforeFrame` prepares a frame, and says whether it would look other than the last one. */
  constructor(readonly canvas: HTMLCanvasElement, private readonly beforeFrame: () => boolean,
              private readonly afterFrame: () => void) {
    const context = canvas.getContext("webgl2", { antialias: true, powerPreference: "high-performance" });
    if (!context) throw new NoWebGl();
    this.renderer = new WebGLRenderer({ canvas, context });
    this.stopwatch = new FrameStopwatch(context);
    this.camera.up.set(0, 0, 1);
    this.resize();
    window.addEventListener("resize", () => this.resize());
  }

  start(): void {
    const loop = (): void => {
      this.frame = requestAnimationFrame(loop);
      this.stopwatch.look();
      this.moving = this.beforeFrame();
      if (this.isHeld || (!this.moving && !this.dirty)) return;
      this.dirty = false;
      this.stopwatch.begin();
      this.renderer.render(this.scene, this.camera);
      this.stopwatch.end();
      this.afterFrame();
    };
    loop();
  }

  /** Whether all is drawn that was asked for, and stays as it is. */
  get isResting(): boolean {
    return !this.moving && !this.dirty && this.lastFrame_ms < Infinity;
  }

  /** How long the last frame took until it was drawn, in milliseconds; Infinity as long as it is not. */
  get lastFrame_ms(): number {
    return this.stopwatch.last_ms;
  }

  /** Asks for a frame. Several requests give one. */
  redraw(): void {
    this.dirty = true;
  }

  /** Until then nothing is drawn: an empty frame would only delay the first one. */
  release(): void {
    this.isHeld = false;
  }

  setBackground(css: string): void {
    this.canvas.style.background = css;
    this.scene.background = new Color(css);
    this.redraw();
  }

  /** The size in CSS pixels. */
  size(): Vector2 {
    return this.renderer.getSize(new Vector2());
  }

  dispose(): void {
    cancelAnimationFrame(this.frame);
    this.renderer.dispose();
  }

  private resize(): void {
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, greatestPixelRatio));
    this.renderer.setSize(window.innerWidth, window.innerHeight, false);
    this.camera.aspect = window.innerWidth / window.innerHeight;
    this.camera.updateProjectionMatrix();
    this.redraw();
  }
}
