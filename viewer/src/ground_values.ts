// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { DataTexture, FloatType, LinearFilter, Matrix3, NearestFilter, RedFormat, RGBAFormat, UnsignedByteType, Vector2 } from "three";
import { isValue, noValue, type RasterResult } from "./results.ts";
import type { Triple } from "./view_info.ts";

/** What the ground shows: the values of the tiles, or a raster. */
export type GroundSource = RasterResult | "computed";
/** How two sources are compared: side by side at a divider, or the first less the second. */
export const comparisons = ["divider", "difference"] as const;
export type Comparison = (typeof comparisons)[number];

export interface GroundChoice {
  shown: GroundSource;
  compared: GroundSource | null;
  comparison: Comparison;
}

/** The numbers of the shader's variable `comparing`. */
const comparingNothing = 0, comparingSideBySide = 1, comparingByDifference = 2;
/** From blue over white to red, which people with colour blindness keep apart, too. */
export const differenceColours: readonly Triple[] = rampOf([[33, 102, 172], [103, 169, 207], [247, 247, 247], [239, 138, 98], [178, 24, 43]]);
/** Of a difference to values that only the tiles have. */
const usualDifference = 0.2;

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

/** One source in the shader. */
interface SourceUniforms {
  raster: { value: DataTexture };
  pixel_from_local: { value: Matrix3 };
  isComputed: { value: boolean };
}

const noRaster = (): DataTexture => textureOf(1, 1, new Float32Array(1));

function textureOf(width: number, height: number, values: Float32Array): DataTexture {
  const texture = new DataTexture(values, width, height, RedFormat, FloatType);
  texture.magFilter = texture.minFilter = NearestFilter;
  texture.needsUpdate = true;
  return texture;
}

function sourceUniforms(): SourceUniforms {
  return { raster: { value: noRaster() }, pixel_from_local: { value: new Matrix3() }, isComputed: { value: true } };
}

function setSource(uniforms: SourceUniforms, source: GroundSource): void {
  uniforms.raster.value.dispose();
  uniforms.isComputed.value = source === "computed";
  if (source === "computed") {
    uniforms.raster.value = noRaster();
    return;
  }
  const [a, b, c, d, e, f] = source.pixel_from_local;
  uniforms.raster.value = textureOf(source.width, source.height, source.values);
  uniforms.pixel_from_local.value.set(a, b, c, d, e, f, 0, 0, 1);
}

/** What the shader of the ground reads. Rasters are looked up by place, so that they lie on the ground at any level of detail. */
export class GroundValues {
  private readonly shown = sourceUniforms();
  private readonly compared = sourceUniforms();
  private readonly range = { value: new Vector2(0, 1) };
  private readonly comparing = { value: comparingNothing };
  private readonly greatest = { value: usualDifference };
  private readonly divider_px = { value: 0 };
  private readonly differences = { value: rampTexture(differenceColours) };
  choice: GroundChoice = { shown: "computed", compared: null, comparison: "divider" };

  get uniforms(): Record<string, { value: unknown }> {
    return {
      shownRaster: this.shown.raster, shownPixel: this.shown.pixel_from_local, shownIsComputed: this.shown.isComputed,
      range: this.range, comparedRaster: this.compared.raster, comparedPixel: this.compared.pixel_from_local,
      comparedIsComputed: this.compared.isComputed, comparing: this.comparing,
      greatestDifference: this.greatest, divider_px: this.divider_px, differences: this.differences,
    };
  }

  /** Of the colours, which are the same on both sides of a divider. */
  get colouredRange(): [number, number] {
    return [this.range.value.x, this.range.value.y];
  }

  /** Differences are coloured from minus this to plus this. */
  get greatestDifference(): number {
    return this.greatest.value;
  }

  choose(choice: GroundChoice): void {
    if (choice.shown !== this.choice.shown) setSource(this.shown, choice.shown);
    if (choice.compared && choice.compared !== this.choice.compared) setSource(this.compared, choice.compared);
    const comparing = choice.comparison === "difference" ? comparingByDifference : comparingSideBySide;
    this.comparing.value = choice.compared ? comparing : comparingNothing;
    this.range.value.set(...commonRange(choice.shown, choice.compared ?? choice.shown));
    if (choice.compared) this.greatest.value = greatestDifferenceOf(choice.shown, choice.compared);
    this.choice = choice;
  }

  /** In pixels of the drawing, from its left. */
  setDivider(x_px: number): void {
    this.divider_px.value = x_px;
  }

  dispose(): void {
    for (const texture of [this.shown.raster, this.compared.raster, this.differences]) texture.value.dispose();
  }
}

function commonRange(...sources: GroundSource[]): [number, number] {
  const ranges = sources.map((source): [number, number] => (source === "computed" ? [0, 1] : source.info.range));
  return [Math.min(...ranges.map(([low]) => low)), Math.max(...ranges.map(([, high]) => high))];
}

/** What nearly all differences lie within, rounded up to 1, 2 or 5. */
function greatestDifferenceOf(shown: GroundSource, compared: GroundSource): number {
  if (shown === "computed" || compared === "computed") return usualDifference;
  const most = 50000, step = Math.max(1, Math.floor(shown.values.length / most)), differences: number[] = [];
  for (let n = 0; n < shown.values.length; n += step) {
    const a = shown.values[n] ?? 0, b = compared.at(...shown.middleOf(n));
    if (isValue(a) && isValue(b)) differences.push(Math.abs(a - b));
  }
  differences.sort((a, b) => a - b);
  return roundedUp(differences[Math.floor(0.99 * differences.length)] ?? usualDifference);
}

function roundedUp(value: number): number {
  const least = 0.001;
  if (value <= least) return least;
  const power = 10 ** Math.floor(Math.log10(value));
  return ([1, 2, 5].find((digit) => value <= digit * power * 1.000001) ?? 10) * power;
}
