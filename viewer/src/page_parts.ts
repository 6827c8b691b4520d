// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0

/** The element of index.html with this id. A page without it is not the one of this script. */
export function part<T extends Element = HTMLElement>(id: string, kind: new () => T = HTMLElement as unknown as new () => T): T {
  const found = document.getElementById(id);
  if (!(found instanceof kind)) throw new Error(`index.html has no ${kind.name} with the id ${id}`);
  return found;
}

/** A new element with a class and a text. */
export function element(tag: string, className = "", text = ""): HTMLElement {
  const made = document.createElement(tag);
  if (className) made.className = className;
  if (text) made.textContent = text;
  return made;
}

/** Replaces a list of descriptions. Rows without a text are left out. */
export function showFacts(list: HTMLElement, rows: readonly (readonly [string, string | null])[]): void {
  list.replaceChildren(...rows.flatMap(([name, text]) => (text === null ? [] : [element("dt", "", name), element("dd", "", text)])));
}

const thousands = new Intl.NumberFormat("en-GB");

/** 1234567 as 1,234,567. */
export const countText = (count: number): string => thousands.format(count);

/** Sizes of files: 20,480 as 20 KiB. */
export function bytesText(bytes: number): string {
  if (bytes < 1024) return `${bytes} B`;
  return bytes < 1048576 ? `${(bytes / 1024).toFixed(1)} KiB` : `${(bytes / 1048576).toFixed(1)} MiB`;
}
