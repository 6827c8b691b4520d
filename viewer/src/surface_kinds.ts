// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0

/** What the tiles call a surface. The order is that of the numbers in the facets' attribute. */
export const surfaceKinds = ["ground", "roof", "wall", "floor", "unknown"] as const;
export type SurfaceKind = (typeof surfaceKinds)[number];

export const kindNumber = (name: string): number => Math.max(0, surfaceKinds.indexOf(isKind(name) ? name : "unknown"));

function isKind(name: string): name is SurfaceKind {
  return (surfaceKinds as readonly string[]).includes(name);
}

/** The layers that a user switches, and the kinds that go with each. Floors are seen from below, with the façades. */
export interface ShownLayers {
  ground: boolean;
  roofs: boolean;
  facades: boolean;
}

/** Bit n is set where kind n is not drawn. */
export function hiddenMask(layers: ShownLayers): number {
  const hidden = [!layers.ground, !layers.roofs, !layers.facades, !layers.facades, !layers.facades];
  return hidden.reduce((mask, bit, n) => mask | (bit ? 1 << n : 0), 0);
}
