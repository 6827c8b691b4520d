// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import {
  BufferAttribute, BufferGeometry, EqualDepth, GLSL3, Group, Mesh, NoBlending, ShaderMaterial, Vector2, Vector4,
} from "three";
import { fetchOfServer } from "./server.ts";

const vertexShader = /* glsl */ `
  in vec3 crown;  // to the east and to the south in squares, up in units
  uniform vec2 corner;  // local
  uniform float step_m, low_m, unit_m;
  out vec3 place;  // local

  void main() {
    place = vec3(corner + step_m * vec2(crown.x, -crown.y), low_m + unit_m * crown.z);
    gl_Position = projectionMatrix * modelViewMatrix * vec4(place, 1.0);
  }
`;

const fragmentShader = /* glsl */ `
  in vec3 place;
  uniform vec4 leaves;
  out vec4 colour;

  const vec3 light = vec3(-0.51, 0.51, 0.69);  // as facets of the city have it

  void main() {
    // A corner is of three faces: the normal is that of the pixel
    vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
    colour = vec4(leaves.rgb * (0.8 + 0.3 * dot(normal, light)), leaves.a);
  }
`;

/** Darker than any green of the ramp; what is behind shows through. index.html has it in the box of the layer. */
const leaves = new Vector4(0.16, 0.31, 0.13, 0.72);
/** Two triangles of each face; bit k of a corner's number is its coordinate k: east, south, up. */
const facesOfColumn = [[0, 2, 6, 4], [1, 5, 7, 3], [0, 4, 5, 1], [2, 3, 7, 6], [0, 1, 3, 2], [4, 6, 7, 5]].flatMap(([a = 0, b = 0, c = 0, d = 0]) => [a, b, c, a, c, d]);
const cornersOfColumn = 8;
const numbersOfColumn = 4, numbersOfHead = 5;

/** The crowns of trees as columns over squares of the plan, as farlod-view makes them. */
export class Crowns {
  readonly group = new Group();
  private asked: Promise<void> | null = null;
  private isLoaded = false;
  private loaded = 0;

  constructor(private readonly redraw: () => void, private readonly onError: (error: unknown) => void) {
    this.group.visible = false;
  }

  get isLoading(): boolean {
    return this.asked !== null && !this.isLoaded;
  }

  /** Of columns that are drawn. */
  get drawn(): number {
    return this.group.visible ? this.loaded : 0;
  }

  set shown(shown: boolean) {
    this.group.visible = shown;
    this.redraw();
  }

  /** Once; where it fails, the next call tries again. */
  load(): void {
    this.asked ??= this.fetch().catch((error: unknown) => {
      this.asked = null;
      this.onError(error);
    });
  }

  dispose(): void {
    for (const mesh of this.group.children)
      if (mesh instanceof Mesh) {
        (mesh.geometry as BufferGeometry).dispose();
        (mesh.material as ShaderMaterial).dispose();
      }
  }

  private async fetch(): Promise<void> {
    const bytes = await (await fetchOfServer("crowns")).arrayBuffer();
    if (!this.isLoaded) this.add(bytes);
    this.isLoaded = true;
    this.redraw();
  }

  /** The nearest faces alone are blended: a first mesh writes their depths, and no colours. */
  private add(bytes: ArrayBuffer): void {
    const [x = 0, y = 0, step_m = 1, low_m = 0, unit_m = 1] = new Float32Array(bytes, 0, numbersOfHead);
    const columns = new Uint16Array(bytes, 4 * numbersOfHead), geometry = geometryOf(columns);
    this.loaded = columns.length / numbersOfColumn;
    const uniforms = {
      corner: { value: new Vector2(x, y) }, step_m: { value: step_m }, low_m: { value: low_m }, unit_m: { value: unit_m }, leaves: { value: leaves },
    };
    const common = { vertexShader, fragmentShader, glslVersion: GLSL3, uniforms };
    const depths = new ShaderMaterial({ ...common, colorWrite: false, blending: NoBlending, transparent: true });
    const colours = new ShaderMaterial({ ...common, transparent: true, depthFunc: EqualDepth, depthWrite: false });
    [depths, colours].forEach((material, order) => {
      const mesh = new Mesh(geometry, material);
      mesh.frustumCulled = false;
      mesh.renderOrder = 3 + order;
      this.group.add(mesh);
    });
  }
}

/** One mesh of all columns: what draws without a graphics processor takes instances one by one. */
function geometryOf(columns: Uint16Array): BufferGeometry {
  const count = columns.length / numbersOfColumn, corners = new Uint16Array(3 * cornersOfColumn * count);
  const index = new Uint32Array(facesOfColumn.length * count);
  for (let n = 0; n < count; ++n) {
    const [column = 0, row = 0, bottom = 0, top = 0] = columns.subarray(numbersOfColumn * n, numbersOfColumn * (n + 1)), first = cornersOfColumn * n;
    for (let k = 0; k < cornersOfColumn; ++k) corners.set([column + (k & 1), row + ((k >> 1) & 1), k >> 2 ? top : bottom], 3 * (first + k));
    facesOfColumn.forEach((corner, k) => { index[facesOfColumn.length * n + k] = first + corner; });
  }
  const geometry = new BufferGeometry();
  geometry.setIndex(new BufferAttribute(index, 1));
  geometry.setAttribute("crown", new BufferAttribute(corners, 3));
  return geometry;
}
