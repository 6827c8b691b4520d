// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
/** How an angle to the zenith becomes a distance from the middle of a disk of radius 1: the projections of farlod-svf's pictures. */
export type SkyProjection = "orthographic" | "equal-area" | "equidistant";

export const isSkyProjection = (name: string): name is SkyProjection => ["orthographic", "equal-area", "equidistant"].includes(name);

export function radiusOf(zenithAngle: number, projection: SkyProjection): number {
  if (projection === "equidistant") return zenithAngle / (0.5 * Math.PI);
  return projection === "equal-area" ? Math.SQRT2 * Math.sin(0.5 * zenithAngle) : Math.sin(zenithAngle);
}

/** The inverse of `radiusOf`. */
export function zenithAngleOf(radius: number, projection: SkyProjection): number {
  if (projection === "equidistant") return radius * 0.5 * Math.PI;
  return projection === "equal-area" ? 2 * Math.asin(radius / Math.SQRT2) : Math.asin(radius);
}
