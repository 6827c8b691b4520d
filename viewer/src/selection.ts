// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import type { Frames } from "./frames.ts";
import { tilt_deg } from "./frames.ts";
import type { PickedFacet } from "./picking.ts";
import type { Receiver } from "./server.ts";

/** A receiver on a roof or a façade stands this far in front of it, so that its own facet does not hide the sky. */
const distanceOfFacet_m = 0.01;

/** The place that a user has chosen, and the receiver that is asked for it. */
export interface Selection {
  facet: PickedFacet;
  receiver: Receiver;
}

/** On the ground a receiver as those of a map, on everything else one that looks as the facet does. */
export function selectionOf(facet: PickedFacet, frames: Frames): Selection {
  const front = facet.p_local.clone();
  if (facet.kind !== "ground") front.addScaledVector(facet.normal_local, distanceOfFacet_m);
  const [x_m, y_m, z_m] = frames.projectedOf(front);
  if (facet.kind === "ground") return { facet, receiver: { x_m, y_m } };
  const normal = facet.normal_local;
  return { facet, receiver: { x_m, y_m, z_m, azimuth_deg: frames.trueAzimuth_deg(normal), tilt_deg: tilt_deg(normal) } };
}
