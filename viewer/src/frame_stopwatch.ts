// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0

/** How long frames take. What draws them works on while the page does: a fence behind a frame tells when it is done. */
export class FrameStopwatch {
  /** Of the last frame, in milliseconds; Infinity as long as it is being drawn. */
  last_ms = 0;
  private begun_ms = 0;
  private fence: WebGLSync | null = null;

  constructor(private readonly context: WebGL2RenderingContext) {}

  begin(): void {
    this.begun_ms = performance.now();
  }

  end(): void {
    if (this.fence) this.context.deleteSync(this.fence);
    this.fence = this.context.fenceSync(this.context.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.context.flush();
    // A context that was lost gives no fence, and draws nothing
    this.last_ms = this.fence ? Infinity : 0;
  }

  /** To be called once a turn of the browser's loop, which is how often it has news. */
  look(): void {
    if (!this.fence) return;
    const { context } = this, isDone = context.getSyncParameter(this.fence, context.SYNC_STATUS) === context.SIGNALED;
    if (!isDone && !context.isContextLost()) return;
    context.deleteSync(this.fence);
    this.fence = null;
    this.last_ms = performance.now() - this.begun_ms;
  }
}
