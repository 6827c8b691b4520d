// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { type Group, Mesh, MeshBasicMaterial, type Object3D, type PerspectiveCamera, type Vector2 } from "three";
import type { Tile } from "3d-tiles-renderer/core";
import { ImplicitTilingPlugin } from "3d-tiles-renderer/core/plugins";
import { TilesRenderer } from "3d-tiles-renderer/three";
import { GLTFExtensionsPlugin } from "3d-tiles-renderer/three/plugins";
import { addFacetAttribute, nameOfValue, type SurfaceTable } from "./facets.ts";
import { fetchJson, fetchOfServer } from "./server.ts";
import type { ShownValues } from "./shown_values.ts";
import { hiddenMask, type ShownLayers } from "./surface_kinds.ts";
import { SvfMaterials } from "./svf_material.ts";
import type { ViewInfo } from "./view_info.ts";

const mebibyte = 1048576;
/** Tiles out of view are kept up to the first, and given up from the second on. */
const keptBytes = 280 * mebibyte, greatestBytes = 400 * mebibyte;
/** Pixels of geometric error at which a tile is replaced by finer ones: first the whole picture soon, then a sharp one. */
const firstError_px = 16, error_px = 6;

/** Answers the loader with a material that has no texture: the page has materials of its own. */
class NoMaterials {
  readonly name = "FARLOD_NO_MATERIALS";
  loadMaterial(): Promise<MeshBasicMaterial> {
    return Promise.resolve(new MeshBasicMaterial());
  }
}

interface Tileset {
  root: { transform?: number[]; boundingVolume: { box: number[] } };
}

/** What the implicit tiling says of its tiles. */
type ImplicitTile = Tile & { implicitTilingData?: { level: number } };

/** Lets all files of tiles come through the door of server.ts, so that what goes wrong is told in one way. */
class FetchOfTiles {
  readonly name = "FARLOD_FETCH";
  constructor(private readonly tileset: string, private readonly onError: (error: unknown) => void) {}

  /** The renderer puts two slashes before a tile where the page lies right at its host's root. */
  preprocessURL(url: string): string {
    const clean = new URL(url, document.baseURI);
    clean.pathname = clean.pathname.replace(/\/{2,}/g, "/");
    return clean.href;
  }

  fetchData(url: string, options: RequestInit): Promise<Response | Tileset> {
    const answer = url === this.tileset ? localTileset(url) : fetchOfServer(url, options);
    answer.catch((error: unknown) => {
      if (!options.signal?.aborted) this.onError(error);
    });
    return answer;
  }
}

/** Has tiles without content replaced by their children from however far: the renderer would draw nothing in their place. */
class PassEmptyTiles {
  readonly name = "FARLOD_PASS_EMPTY_TILES";

  calculateTileViewError(tile: Tile, target: { error: number }): boolean {
    if (tile.internal.hasContent) return false;
    target.error = Infinity;
    return true;
  }
}

/** Without its way to the middle of the Earth: the page draws in local metres, where floats are fine enough. */
async function localTileset(url: string): Promise<Tileset> {
  const tileset = await fetchJson<Tileset>(url);
  delete tileset.root.transform;
  return tileset;
}

/** The tiles of a package: which are loaded and drawn, for what the camera looks at. */
export class CityTiles {
  private readonly renderer: TilesRenderer;
  private readonly materials: SvfMaterials;
  private readonly cellEdge_m: number;
  private readonly meshes = new Map<Tile, Mesh[]>();
  private readonly failed = new Set<Tile>();
  /** The next update may choose other tiles. */
  private changed = true;
  /** Other tiles are drawn than in the frame before. */
  private drawnChanged = false;
  private quietUpdates = 0;

  constructor(view: ViewInfo, private readonly values: ShownValues, private readonly camera: PerspectiveCamera, onError: (error: unknown) => void) {
    this.cellEdge_m = view.grid.cell_edge_m;
    this.materials = new SvfMaterials(view, values);
    const tileset = new URL(view.tileset, document.baseURI).href;
    this.renderer = new TilesRenderer(tileset);
    this.renderer.registerPlugin(new ImplicitTilingPlugin());
    this.renderer.registerPlugin(new FetchOfTiles(tileset, onError));
    this.renderer.registerPlugin(new PassEmptyTiles());
    this.renderer.registerPlugin(new GLTFExtensionsPlugin({ plugins: [() => new NoMaterials()] }));
    this.renderer.setCamera(camera);
    this.renderer.errorTarget = firstError_px;
    // Coarser tiles need not come first. The first picture is made of the tiles in view alone
    this.renderer.loadAncestors = this.renderer.loadSiblings = false;
    this.renderer.lruCache.minBytesSize = keptBytes;
    this.renderer.lruCache.maxBytesSize = greatestBytes;
    this.listen();
  }

  get group(): Group {
    return this.renderer.group;
  }

  get visibleTiles(): number {
    return this.renderer.visibleTiles.size;
  }

  /** Whether the geometry that a mesh shows is a simplified one: tiles larger than a cell are. */
  isSimplified(mesh: Mesh): boolean {
    const box = (this.renderer.rootTileset as Tileset | null)?.root.boundingVolume.box ?? [];
    const edge_m = 2 * Math.hypot(box[3] ?? 0, box[4] ?? 0, box[5] ?? 0), tile = mesh.userData["tile"] as ImplicitTile;
    return edge_m / 2 ** (tile.implicitTilingData?.level ?? 0) > 1.01 * this.cellEdge_m;
  }

  /** The share of what is being loaded that has come. */
  get progress(): number {
    return this.renderer.rootTileset ? this.renderer.loadProgress : 0;
  }

  /** Whether all tiles are drawn that this view needs. */
  get isComplete(): boolean {
    return this.quietUpdates >= 2 && this.visibleTiles > 0;
  }

  /** The colour of facets without a value, in the shaders. */
  get nodata(): { value: readonly number[] } {
    return this.materials.nodata;
  }

  set layers(layers: ShownLayers) {
    this.materials.hiddenKinds = hiddenMask(layers);
  }

  /** Chooses tiles for the camera; whether a new frame would look other than the last one, or is the first complete one. */
  update(size: Vector2, cameraMoved: boolean): boolean {
    const wasComplete = this.isComplete;
    if (!cameraMoved && !this.changed && wasComplete) return false;
    this.changed = this.drawnChanged = false;
    this.camera.updateMatrixWorld();
    this.renderer.setResolution(this.camera, size);
    this.renderer.update();
    // A tile that came makes the next traversal ask for its children: one quiet update does not prove completeness
    const quiet = this.progress === 1 && !this.changed && !cameraMoved;
    this.quietUpdates = quiet ? this.quietUpdates + 1 : 0;
    return this.drawnChanged || this.isComplete !== wasComplete;
  }

  /** The meshes that stand for the city now, in view or not. */
  *shownMeshes(): Iterable<Mesh> {
    for (const tile of this.renderer.activeTiles) yield* this.meshes.get(tile) ?? [];
  }

  /** After the first complete picture. From now on, tiles beside those in view are loaded, too: a camera that turns sees no holes. */
  sharpen(): void {
    this.renderer.loadSiblings = true;
    this.renderer.errorTarget = error_px;
    this.changed = true;
    this.quietUpdates = 0;
  }

  retry(): void {
    // The renderer would not ask again for a tile that its cache holds, failed or not
    for (const tile of this.failed) this.renderer.lruCache.remove(tile);
    this.failed.clear();
    this.renderer.resetFailedTiles();
    this.changed = true;
  }

  dispose(): void {
    this.renderer.dispose();
    this.materials.dispose();
  }

  private listen(): void {
    const change = (): void => {
      this.changed = true;
    };
    this.renderer.addEventListener("needs-update", change);
    this.renderer.addEventListener("tile-visibility-change", () => {
      this.changed = this.drawnChanged = true;
    });
    this.renderer.addEventListener("load-model", ({ scene, tile }) => this.take(scene, tile));
    this.renderer.addEventListener("load-error", ({ tile }) => {
      if (tile) this.failed.add(tile);
    });
    this.renderer.addEventListener("dispose-model", ({ tile }) => {
      for (const { geometry } of this.meshes.get(tile) ?? []) this.values.buildings.remove(geometry);
      this.meshes.delete(tile);
    });
  }

  private take(scene: Object3D, tile: Tile): void {
    const meshes: Mesh[] = [];
    scene.traverse((object) => {
      if (object instanceof Mesh) meshes.push(object);
    });
    for (const mesh of meshes) {
      const table = mesh.userData["structuralMetadata"] as SurfaceTable;
      addFacetAttribute(mesh.geometry, table);
      this.values.buildings.add(mesh.geometry, table);
      // Only other programs need the texture's coordinates
      mesh.geometry.deleteAttribute("uv");
      mesh.material = mesh.geometry.hasAttribute(nameOfValue) ? this.materials.withValue : this.materials.withoutValue;
    }
    this.meshes.set(tile, meshes);
    this.changed = true;
  }
}
