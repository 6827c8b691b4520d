// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { isValue, type ResultInfo } from "./results.ts";

/** Two sources of values are compared side by side at a divider, or by the first less the second. */
export const comparisons = ["divider", "difference"] as const;
export type Comparison = (typeof comparisons)[number];

/** What is shown, and what it is compared with: a result each, or the values of the tiles. */
export interface SourcePair<Result> {
  shown: Result | "computed";
  compared: Result | "computed" | null;
}

/** Of a difference to values that only the tiles have. */
export const usualDifference = 0.2;

/** Of the colours of both: from 0 to 1 where all values lie there. */
export function commonRange(pair: SourcePair<{ info: ResultInfo }>): [number, number] {
  const ranges = [pair.shown, pair.compared ?? pair.shown].map((source): [number, number] => (source === "computed" ? [0, 1] : source.info.range));
  return [Math.min(...ranges.map(([low]) => low)), Math.max(...ranges.map(([, high]) => high))];
}

/** Whether the colours of sky view factors fit. */
export const isUnit = ([low, high]: readonly [number, number]): boolean => low === 0 && high === 1;

/** What nearly all differences of pairs lie within, rounded up to 1, 2 or 5. */
export function greatestDifference(pairs: readonly [number, number][]): number {
  const differences = pairs.filter(([a, b]) => isValue(a) && isValue(b)).map(([a, b]) => Math.abs(a - b)).sort((a, b) => a - b);
  return roundedUp(differences[Math.floor(0.99 * differences.length)] ?? usualDifference);
}

function roundedUp(value: number): number {
  const least = 0.001;
  if (value <= least) return least;
  const power = 10 ** Math.floor(Math.log10(value));
  return ([1, 2, 5].find((digit) => value <= digit * power * 1.000001) ?? 10) * power;
}
