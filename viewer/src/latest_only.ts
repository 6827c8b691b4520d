// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0

/**
 * Runs one piece of work at a time. Of the pieces that come meanwhile, only the latest is kept: who drags a point wants the
 * answer for where it is now.
 */
export class LatestOnly<T> {
  private waiting: { input: T } | null = null;
  private running = false;

  constructor(private readonly work: (input: T) => Promise<void>) {}

  ask(input: T): void {
    this.waiting = { input };
    if (!this.running) void this.run();
  }

  get isBusy(): boolean {
    return this.running;
  }

  private async run(): Promise<void> {
    this.running = true;
    while (this.waiting) {
      const { input } = this.waiting;
      this.waiting = null;
      await this.work(input);
    }
    this.running = false;
  }
}
