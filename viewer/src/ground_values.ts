// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { DataTexture, FloatType, Matrix3, NearestFilter, RedFormat } from "three";
import type { RasterResult } from "./results.ts";
import type { SourcePair } from "./value_pairs.ts";

/** The vertical part of the normal of the steepest ground that a raster lies on: walls of a surface model would show its pixels as stripes. */
export const leastUpward = 0.25;

/** What the ground shows: the values of the tiles, or a raster. */
type GroundSource = RasterResult | "computed";

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
  choice: SourcePair<RasterResult> = { shown: "computed", compared: null };

  get uniforms(): Record<string, { value: unknown }> {
    return {
      shownRaster: this.shown.raster, shownPixel: this.shown.pixel_from_local, shownIsComputed: this.shown.isComputed,
      comparedRaster: this.compared.raster, comparedPixel: this.compared.pixel_from_local, comparedIsComputed: this.compared.isComputed,
    };
  }

  choose(choice: SourcePair<RasterResult>): void {
    if (choice.shown !== this.choice.shown) setSource(this.shown, choice.shown);
    if (choice.compared && choice.compared !== this.choice.compared) setSource(this.compared, choice.compared);
    this.choice = choice;
  }

  dispose(): void {
    for (const texture of [this.shown.raster, this.compared.raster]) texture.value.dispose();
  }
}

/** Differences of pixels: of so many at the most, evenly spread. */
export function differencesOfRasters(shown: RasterResult, compared: RasterResult, most: number): [number, number][] {
  const step = Math.max(1, Math.floor(shown.values.length / most)), pairs: [number, number][] = [];
  for (let n = 0; n < shown.values.length; n += step) pairs.push([shown.values[n] ?? 0, compared.at(...shown.middleOf(n))]);
  return pairs;
}
