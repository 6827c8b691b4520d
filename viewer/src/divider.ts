// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0

const step = 0.01, longStep = 0.1;

/** The line between two results that are compared side by side: dragged, or moved by the arrow keys. */
export class Divider {
  /** From the left, as a share of the window's width. */
  private at = 0.5;

  constructor(private readonly handle: HTMLElement, private readonly onMove: (share: number) => void) {
    handle.addEventListener("pointerdown", (event) => handle.setPointerCapture(event.pointerId));
    handle.addEventListener("pointermove", (event) => {
      if (handle.hasPointerCapture(event.pointerId)) this.move(event.clientX / window.innerWidth);
    });
    handle.addEventListener("keydown", (event) => this.press(event));
    this.move(this.at);
  }

  get share(): number {
    return this.at;
  }

  get shown(): boolean {
    return !this.handle.hidden;
  }

  set shown(shown: boolean) {
    this.handle.hidden = !shown;
  }

  move(share: number): void {
    this.at = Math.min(1, Math.max(0, share));
    this.handle.style.left = `${(100 * this.at).toFixed(2)}%`;
    this.handle.setAttribute("aria-valuenow", (100 * this.at).toFixed(0));
    this.onMove(this.at);
  }

  private press(event: KeyboardEvent): void {
    const towards = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (towards === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    this.move(this.at + towards * (event.shiftKey ? longStep : step));
  }
}
