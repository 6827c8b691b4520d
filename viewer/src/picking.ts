// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import type { BufferAttribute, BufferGeometry, Intersection, Mesh, PerspectiveCamera, Vector2 } from "three";
import { Raycaster, Vector3 } from "three";
import { acceleratedRaycast, MeshBVH } from "three-mesh-bvh";
import { kindOfVertex, nameOfFeature, nameOfValue, type SurfaceTable } from "./facets.ts";
import { hiddenMask, type ShownLayers, type SurfaceKind, surfaceKinds } from "./surface_kinds.ts";
import type { CityTiles } from "./tiles.ts";

/** A place on a facet, and what the tiles know of it. */
export interface PickedFacet {
  p_local: Vector3;
  /** Outward, or towards who looks at a facet from its back. */
  normal_local: Vector3;
  /** Empty on the ground. */
  building: string;
  surface: number;
  kind: SurfaceKind;
  /** null where the facet has no value. */
  svf: number | null;
  /** The facet stands for others, of which it lies some metres off. */
  isSimplified: boolean;
}

interface TreeOwner {
  boundsTree?: MeshBVH;
}

/** Finds what a ray meets first among what is drawn. */
export class Picker {
  private readonly raycaster = new Raycaster();
  private hidden = 0;

  constructor(private readonly tiles: CityTiles) {}

  set layers(layers: ShownLayers) {
    this.hidden = hiddenMask(layers);
  }

  /** Below a place of the canvas, from −1 to 1 rightwards and upwards. */
  below(place: Vector2, camera: PerspectiveCamera): PickedFacet | null {
    this.raycaster.setFromCamera(place, camera);
    this.raycaster.far = Infinity;
    return this.firstFacet();
  }

  along(origin_local: Vector3, direction_local: Vector3, reach_m: number): PickedFacet | null {
    this.raycaster.set(origin_local, direction_local);
    this.raycaster.far = reach_m;
    return this.firstFacet();
  }

  /** The height of the ground that a ray meets, hidden or not. */
  ground(origin_local: Vector3, direction_local: Vector3, reach_m: number): number | null {
    this.raycaster.set(origin_local, direction_local);
    this.raycaster.far = reach_m;
    const first = this.hits().find((hit) => kindOfHit(hit) === surfaceKinds.indexOf("ground"));
    return first?.point.z ?? null;
  }

  private firstFacet(): PickedFacet | null {
    const first = this.hits().find((hit) => (this.hidden & (1 << kindOfHit(hit))) === 0);
    return first ? { ...facetOf(first, this.raycaster.ray.direction), isSimplified: this.tiles.isSimplified(first.object) } : null;
  }

  /** All facets on the ray, the nearest first. */
  private hits(): Intersection<Mesh>[] {
    const hits: Intersection<Mesh>[] = [];
    for (const mesh of this.tiles.shownMeshes()) {
      if (!this.mayMeet(mesh)) continue;
      prepare(mesh);
      mesh.raycast(this.raycaster, hits);
    }
    return hits.sort((a, b) => a.distance - b.distance);
  }

  private mayMeet(mesh: Mesh): boolean {
    if (!mesh.geometry.boundingSphere) mesh.geometry.computeBoundingSphere();
    const sphere = mesh.geometry.boundingSphere?.clone().applyMatrix4(mesh.matrixWorld);
    return sphere !== undefined && this.raycaster.ray.intersectsSphere(sphere);
  }
}

/** The tree of a mesh is built when the first ray comes near: most tiles are never asked. */
function prepare(mesh: Mesh): void {
  const owner = mesh.geometry as BufferGeometry & TreeOwner;
  // "indirect" leaves the order of the facets as it is
  owner.boundsTree ??= new MeshBVH(mesh.geometry, { indirect: true });
  mesh.raycast = acceleratedRaycast;
}

const firstVertex = (hit: Intersection): number => 3 * (hit.faceIndex ?? 0);
const kindOfHit = (hit: Intersection<Mesh>): number => kindOfVertex(hit.object.geometry, firstVertex(hit));

function facetOf(hit: Intersection<Mesh>, direction: Vector3): Omit<PickedFacet, "isSimplified"> {
  const geometry = hit.object.geometry, vertex = firstVertex(hit);
  const normal_local = (hit.face?.normal.clone() ?? new Vector3(0, 1, 0)).transformDirection(hit.object.matrixWorld);
  if (normal_local.dot(direction) > 0) normal_local.negate();
  const row = (geometry.getAttribute(nameOfFeature) as BufferAttribute).getX(vertex);
  const { building, surface } = (hit.object.userData["structuralMetadata"] as SurfaceTable).getPropertyTableData(0, row);
  const svf = geometry.hasAttribute(nameOfValue) ? geometry.getAttribute(nameOfValue).getX(vertex) : null;
  return { p_local: hit.point.clone(), normal_local, building, surface, kind: surfaceKinds[kindOfHit(hit)] ?? "unknown", svf };
}
