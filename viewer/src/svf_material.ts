// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { type DataTexture, DoubleSide, GLSL3, ShaderMaterial } from "three";
import { leastUpward } from "./ground_values.ts";
import { noValue } from "./results.ts";
import type { ShownValues } from "./shown_values.ts";
import { colourOfRamp, rampTexture } from "./value_colours.ts";
import type { ViewInfo } from "./view_info.ts";

/** What both materials read, changed in one place. */
export interface SharedUniforms {
  hidden: { value: number };
  ramp: { value: DataTexture };
}

const vertexShader = /* glsl */ `
  in vec4 facet;  // the normal, local, and the number of the kind
  in vec2 tabled;  // of a surface of a building, where tables have values: shown and compared
  #ifdef WITH_VALUE
  in float _svf;
  #endif
  uniform int hidden;
  uniform bool shownIsTabled, comparedIsTabled;
  out float shade;
  out vec2 place;  // local
  flat out int isGround, isSteep;
  flat out vec2 values;  // shown and compared; of the ground, those that its rasters stand in for

  const float noValue = ${noValue.toExponential()};

  // From the north-west and above, as maps are lit. A level facet keeps the colour of the legend
  const vec3 light = vec3(-0.51, 0.51, 0.69);

  void main() {
    int kind = int(facet.w * 127.0 + 0.5);
    #ifdef WITH_VALUE
    values = vec2(_svf);
    #else
    values = vec2(noValue);
    #endif
    if (kind != 0 && shownIsTabled) values.x = tabled.x;
    if (kind != 0 && comparedIsTabled) values.y = tabled.y;
    isGround = kind == 0 ? 1 : 0;
    place = (modelMatrix * vec4(position, 1.0)).xy;
    vec3 normal = normalize(facet.xyz);
    isSteep = abs(normal.z) < ${leastUpward} ? 1 : 0;
    // Simplified ground has slivers, whichever way they look
    if (kind == 0) normal = normalize(vec3(0.5 * normal.xy, max(0.5, abs(normal.z))));
    shade = 1.0 + 0.17 * min(0.0, dot(normal, light) - light.z);
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    // A facet of a hidden kind shrinks to a point outside of the view
    if ((hidden >> kind & 1) == 1) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  }
`;

const fragmentShader = /* glsl */ `
  precision highp sampler2D;
  in float shade;
  in vec2 place;
  flat in int isGround, isSteep;
  flat in vec2 values;
  uniform sampler2D ramp, differences, shownRaster, comparedRaster;
  uniform mat3 shownPixel, comparedPixel;
  uniform bool shownIsComputed, comparedIsComputed;
  uniform vec2 range;
  uniform int groundComparing, buildingsComparing;  // 0: nothing; 1: side by side; 2: by the difference; 3: without colours
  uniform float greatestDifference, divider_px;
  uniform vec3 nodata;
  out vec4 colour;

  const vec3 paper = vec3(0.87, 0.87, 0.85);

  ${colourOfRamp}
  float valueAt(sampler2D raster, mat3 pixel_from_local) {
    if (isSteep == 1) return noValue;
    ivec2 pixel = ivec2(floor((pixel_from_local * vec3(place, 1.0)).xy)), size = textureSize(raster, 0);
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= size.x || pixel.y >= size.y) return noValue;
    return texelFetch(raster, pixel, 0).r;
  }

  vec3 colourOfPair(float a, float b, int comparing) {
    if (comparing == 3) return paper;
    if (comparing == 0) return colourOf(ramp, a, range, nodata);
    if (comparing == 1) return colourOf(ramp, gl_FragCoord.x < divider_px ? a : b, range, nodata);
    float difference = isValue(a) && isValue(b) ? a - b : noValue;
    return colourOf(differences, difference, vec2(-greatestDifference, greatestDifference), nodata);
  }

  void main() {
    vec2 shown = values;
    if (isGround == 1 && !shownIsComputed) shown.x = valueAt(shownRaster, shownPixel);
    if (isGround == 1 && !comparedIsComputed && groundComparing != 0) shown.y = valueAt(comparedRaster, comparedPixel);
    colour = vec4(colourOfPair(shown.x, shown.y, isGround == 1 ? groundComparing : buildingsComparing) * shade, 1.0);
  }
`;

/** The two materials of all tiles: facets with a value, and facets without. Colours are written as they are, without light. */
export class SvfMaterials {
  readonly withValue: ShaderMaterial;
  readonly withoutValue: ShaderMaterial;
  readonly nodata: { value: readonly number[] };
  private readonly shared: SharedUniforms;

  constructor(view: ViewInfo, values: ShownValues) {
    this.shared = { hidden: { value: 0 }, ramp: { value: rampTexture(view.colours) } };
    this.nodata = { value: view.nodata_colour.map((c) => c / 255) };
    const uniforms = { ...this.shared, ...values.uniforms, nodata: this.nodata };
    const common = { vertexShader, fragmentShader, glslVersion: GLSL3, side: DoubleSide, uniforms };
    this.withValue = new ShaderMaterial({ ...common, defines: { WITH_VALUE: 1 } });
    this.withoutValue = new ShaderMaterial(common);
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
