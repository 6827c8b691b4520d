// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import {
  BoxGeometry, EqualDepth, GLSL3, Group, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, NoBlending, ShaderMaterial, Vector2, Vector4,
} from "three";
import { fetchOfServer } from "./server.ts";

const vertexShader = /* glsl */ `
  in vec4 crown;  // column and row of a square from the north-west, bottom and top in units
  uniform vec2 corner;  // local
  uniform float step_m, low_m, unit_m;
  out float shade;

  const vec3 light = vec3(-0.51, 0.51, 0.69);  // as facets of the city have it

  void main() {
    float height = mix(crown.z, crown.w, position.z + 0.5);
    vec2 place = corner + step_m * vec2(crown.x + 0.5 + position.x, position.y - crown.y - 0.5);
    shade = 0.8 + 0.3 * dot(normal, light);
    gl_Position = projectionMatrix * modelViewMatrix * vec4(place, low_m + unit_m * height, 1.0);
  }
`;

const fragmentShader = /* glsl */ `
  in float shade;
  uniform vec4 leaves;
  out vec4 colour;

  void main() {
    colour = vec4(leaves.rgb * shade, leaves.a);
  }
`;

/** Darker than any green of the ramp; what is behind shows through. index.html has it in the box of the layer. */
const leaves = new Vector4(0.16, 0.31, 0.13, 0.72);
const numbersOfColumn = 4, numbersOfHead = 5;

/** The crowns of trees as columns over squares of the plan, as farlod-view makes them. */
export class Crowns {
  readonly group = new Group();
  private asked: Promise<void> | null = null;
  private isLoaded = false;

  constructor(private readonly redraw: () => void, private readonly onError: (error: unknown) => void) {
    this.group.visible = false;
  }

  get isLoading(): boolean {
    return this.asked !== null && !this.isLoaded;
  }

  /** Of columns that are drawn. */
  get drawn(): number {
    const [first] = this.group.children;
    return this.group.visible && first instanceof Mesh ? (first.geometry as InstancedBufferGeometry).instanceCount : 0;
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
        (mesh.geometry as InstancedBufferGeometry).dispose();
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
    const geometry = geometryOf(new Uint16Array(bytes, 4 * numbersOfHead));
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

function geometryOf(columns: Uint16Array): InstancedBufferGeometry {
  const box = new BoxGeometry(1, 1, 1), geometry = new InstancedBufferGeometry();
  geometry.index = box.index;
  for (const name of ["position", "normal"]) geometry.setAttribute(name, box.getAttribute(name));
  geometry.setAttribute("crown", new InstancedBufferAttribute(columns, numbersOfColumn));
  geometry.instanceCount = columns.length / numbersOfColumn;
  return geometry;
}
