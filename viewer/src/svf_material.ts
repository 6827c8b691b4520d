// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { DataTexture, DoubleSide, GLSL3, LinearFilter, RGBAFormat, ShaderMaterial, UnsignedByteType } from "three";
import type { Triple, ViewInfo } from "./view_info.ts";

/** What both materials read, changed in one place. */
export interface SharedUniforms {
  hidden: { value: number };
  ramp: { value: DataTexture };
}

const vertexShader = /* glsl */ `
  in vec4 facet;  // the normal, local, and the number of the kind
  #ifdef WITH_VALUE
  in float _svf;
  out float svf;
  #endif
  uniform int hidden;
  out float shade;

  // From the north-west and above, as maps are lit. A level facet keeps the colour of the legend
  const vec3 light = vec3(-0.51, 0.51, 0.69);

  void main() {
    int kind = int(facet.w * 127.0 + 0.5);
    #ifdef WITH_VALUE
    svf = _svf;
    #endif
    vec3 normal = normalize(facet.xyz);
    // Simplified ground has slivers, whichever way they look
    if (kind == 0) normal = normalize(vec3(0.5 * normal.xy, max(0.5, abs(normal.z))));
    shade = 1.0 + 0.17 * min(0.0, dot(normal, light) - light.z);
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    // A facet of a hidden kind shrinks to a point outside of the view
    if ((hidden >> kind & 1) == 1) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  }
`;

const fragmentShader = /* glsl */ `
  in float shade;
  #ifdef WITH_VALUE
  in float svf;
  uniform sampler2D ramp;
  #else
  uniform vec3 nodata;
  #endif
  out vec4 colour;

  void main() {
    #ifdef WITH_VALUE
    // The middles of the ramp's outermost texels are 0 and 1
    vec3 flatColour = texture(ramp, vec2(svf * (255.0 / 256.0) + 0.5 / 256.0, 0.5)).rgb;
    #else
    vec3 flatColour = nodata;
    #endif
    colour = vec4(flatColour * shade, 1.0);
  }
`;

function rampOf(colours: readonly Triple[]): DataTexture {
  const bytes = new Uint8Array(4 * colours.length);
  colours.forEach(([red, green, blue], n) => bytes.set([red, green, blue, 255], 4 * n));
  const texture = new DataTexture(bytes, colours.length, 1, RGBAFormat, UnsignedByteType);
  texture.magFilter = texture.minFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

/** The two materials of all tiles: facets with a value, and facets without. Colours are written as they are, without light. */
export class SvfMaterials {
  readonly withValue: ShaderMaterial;
  readonly withoutValue: ShaderMaterial;
  private readonly shared: SharedUniforms;

  constructor(view: ViewInfo) {
    this.shared = { hidden: { value: 0 }, ramp: { value: rampOf(view.colours) } };
    const common = { vertexShader, fragmentShader, glslVersion: GLSL3, side: DoubleSide };
    this.withValue = new ShaderMaterial({ ...common, defines: { WITH_VALUE: 1 }, uniforms: { ...this.shared } });
    const nodata = { value: view.nodata_colour.map((c) => c / 255) };
    this.withoutValue = new ShaderMaterial({ ...common, uniforms: { hidden: this.shared.hidden, nodata } });
  }

  set hiddenKinds(mask: number) {
    this.shared.hidden.value = mask;
  }

  dispose(): void {
    this.shared.ramp.value.dispose();
    this.withValue.dispose();
    this.withoutValue.dispose();
  }
}
