// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { DataTexture, LinearFilter, RGBAFormat, UnsignedByteType } from "three";
import { noValue } from "./results.ts";
import type { Triple } from "./view_info.ts";

/** From blue over white to red, which people with colour blindness keep apart, too. */
export const differenceColours: readonly Triple[] = rampOf([[33, 102, 172], [103, 169, 207], [247, 247, 247], [239, 138, 98], [178, 24, 43]]);

function rampOf(stops: readonly Triple[]): Triple[] {
  return Array.from({ length: 256 }, (_, n) => {
    const at = (n / 255) * (stops.length - 1), k = Math.min(Math.floor(at), stops.length - 2), t = at - k;
    const a = stops[k] ?? [0, 0, 0], b = stops[k + 1] ?? a;
    return a.map((channel, c) => Math.round(channel + t * ((b[c] ?? channel) - channel))) as Triple;
  });
}

/** In a shader: the colour of a value, of a ramp whose outermost texels have the ends of the range in their middles. */
export const colourOfRamp = /* glsl */ `
  const float noValue = ${noValue.toExponential()};
  bool isValue(float value) { return value > 0.5 * noValue; }

  vec3 colourOf(sampler2D colours, float value, vec2 range, vec3 nodata) {
    float t = clamp((value - range.x) / (range.y - range.x), 0.0, 1.0);
    return isValue(value) ? texture(colours, vec2(t * (255.0 / 256.0) + 0.5 / 256.0, 0.5)).rgb : nodata;
  }
`;

/** A ramp of colours as a texture of one row. */
export function rampTexture(colours: readonly Triple[]): DataTexture {
  const bytes = new Uint8Array(4 * colours.length);
  colours.forEach(([red, green, blue], n) => bytes.set([red, green, blue, 255], 4 * n));
  const texture = new DataTexture(bytes, colours.length, 1, RGBAFormat, UnsignedByteType);
  texture.magFilter = texture.minFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}
