// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0

/** Fails with a sentence that says what was expected and what there is. */
export function expect(condition, sentence) {
  if (!condition) throw new Error(sentence);
}

export const expectEqual = (found, expected, what) =>
  expect(JSON.stringify(found) === JSON.stringify(expected), `${what}: expected ${JSON.stringify(expected)}, found ${JSON.stringify(found)}`);

export const expectNear = (found, expected, tolerance, what) =>
  expect(Math.abs(found - expected) <= tolerance, `${what}: expected ${expected} to ${tolerance}, found ${found}`);
