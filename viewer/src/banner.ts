// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { part } from "./page_parts.ts";
import { ServerSilent } from "./server.ts";

const banner = part("banner"), text = part("banner-text"), button = part("retry", HTMLButtonElement);
let retry: (() => void) | null = null;
button.addEventListener("click", () => retry?.());

/** Says what keeps the page from its work. With `again`, there is a button to try it once more. */
export function showBanner(sentence: string, again: (() => void) | null): void {
  retry = again;
  text.textContent = sentence;
  button.hidden = again === null;
  banner.hidden = false;
}

export function hideBanner(): void {
  banner.hidden = true;
}

export const sentenceOf = (error: unknown): string => (error instanceof Error ? error.message : String(error));

export const isSilent = (error: unknown): boolean => error instanceof ServerSilent;

/** One sentence for those who hear the page. */
export function tell(sentence: string): void {
  part("status").textContent = sentence;
}
