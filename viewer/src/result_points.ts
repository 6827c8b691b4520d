// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { BufferAttribute, BufferGeometry, GLSL3, Points, ShaderMaterial, Vector2 } from "three";
import { colourOfRamp, rampTexture } from "./value_colours.ts";
import type { PointsResult } from "./results.ts";
import type { ViewInfo } from "./view_info.ts";

const vertexShader = /* glsl */ `
  in float value;
  uniform float size_px;
  out float v;

  void main() {
    v = value;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    gl_PointSize = size_px;
    // Nearer by a little than the surface that it lies on
    gl_Position.z -= 0.0005 * gl_Position.w;
  }
`;

const fragmentShader = /* glsl */ `
  in float v;
  uniform sampler2D ramp;
  uniform vec2 range;
  uniform vec3 nodata;
  out vec4 colour;
  ${colourOfRamp}

  void main() {
    vec2 p = 2.0 * gl_PointCoord - 1.0;
    #ifdef PROBLEMS
    float distance = abs(p.x) + abs(p.y);
    vec3 inside = vec3(0.85, 0.11, 0.38);
    #else
    float distance = length(p);
    vec3 inside = colourOf(ramp, v, range, nodata);
    #endif
    if (distance > 1.0) discard;
    colour = vec4(distance > 0.72 ? vec3(1.0) : inside, 1.0);
  }
`;

/** The dots of a result's points, or the marks of problems: those are seen through walls, since many lie within. */
export function dotsOf(result: PointsResult, view: ViewInfo): Points {
  const geometry = new BufferGeometry(), isProblems = result.info.form === "problems";
  geometry.setAttribute("position", new BufferAttribute(result.places_local, 3));
  geometry.setAttribute("value", new BufferAttribute(result.values, 1));
  const size_px = (isProblems ? 15 : 9) * Math.min(window.devicePixelRatio, 2);
  const uniforms = {
    size_px: { value: size_px }, ramp: { value: rampTexture(view.colours) }, range: { value: new Vector2(...result.info.range) },
    nodata: { value: view.nodata_colour.map((c) => c / 255) },
  };
  const material = new ShaderMaterial({ vertexShader, fragmentShader, glslVersion: GLSL3, uniforms, depthTest: !isProblems,
                                        defines: isProblems ? { PROBLEMS: 1 } : {} });
  const dots = new Points(geometry, material);
  dots.frustumCulled = false;
  dots.renderOrder = isProblems ? 2 : 1;
  return dots;
}
