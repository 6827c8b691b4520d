// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { drawText, lineColours, type Paper, paperOf, partColours, partNames } from "./drawing.ts";
import { azimuthsOfHemisphere, elevationsOfHemisphere, type Hemisphere } from "./server.ts";
import { radiusOf, type SkyProjection, zenithAngleOf } from "./sky_projection.ts";

const degree = Math.PI / 180, edge_px = 316, margin_px = 17;
const colours = partNames.map((name) => partColours[name]);

/** For each pixel of the disk, which direction of a hemisphere it shows; −1 outside. North is up and east on the left. */
function directionsOfPixels(diameter: number, projection: SkyProjection): Int32Array {
  const directions = new Int32Array(diameter * diameter).fill(-1), radius = 0.5 * diameter;
  for (let row = 0; row < diameter; ++row)
    for (let column = 0; column < diameter; ++column) {
      const east = (radius - column - 0.5) / radius, north = (radius - row - 0.5) / radius, r = Math.hypot(east, north);
      if (r >= 1) continue;
      const turn = (Math.atan2(east, north) / (2 * Math.PI) + 1) % 1, elevation = 1 - zenithAngleOf(r, projection) / (0.5 * Math.PI);
      const a = Math.min(azimuthsOfHemisphere - 1, Math.floor(turn * azimuthsOfHemisphere));
      const e = Math.min(elevationsOfHemisphere - 1, Math.max(0, Math.floor(elevation * elevationsOfHemisphere)));
      directions[row * diameter + column] = a * elevationsOfHemisphere + e;
    }
  return directions;
}

/** Shares of the view of a horizontal receiver, each direction weighted by the cosine of its angle to the zenith. */
export function sharesOf(hemisphere: Hemisphere): Record<(typeof partNames)[number], number> {
  const shares = [0, 0, 0, 0];
  const step = 90 / elevationsOfHemisphere;
  const weights = Array.from({ length: elevationsOfHemisphere }, (_, e) =>
    (Math.sin((e + 1) * step * degree) ** 2 - Math.sin(e * step * degree) ** 2) / azimuthsOfHemisphere);
  hemisphere.parts.forEach((part, n) => {
    shares[part] = (shares[part] ?? 0) + (weights[n % elevationsOfHemisphere] ?? 0);
  });
  return { sky: shares[0] ?? 0, near: shares[1] ?? 0, far: shares[2] ?? 0, crown: shares[3] ?? 0 };
}

/** Draws what a point sees when it looks up. */
export class Fisheye {
  private directions: Int32Array = new Int32Array(0);
  private made: { diameter: number; projection: SkyProjection } | null = null;

  constructor(private readonly canvas: HTMLCanvasElement) {}

  draw(hemisphere: Hemisphere, projection: SkyProjection): void {
    const paper = paperOf(this.canvas, edge_px, edge_px);
    this.drawDisk(paper, hemisphere, projection);
    drawRings(paper, projection);
    drawHorizon(paper, hemisphere, projection);
    drawElevations(paper, projection);
    drawDirections(paper);
  }

  /** An empty circle, for a place that has no sky. */
  clear(): void {
    const paper = paperOf(this.canvas, edge_px, edge_px);
    drawRings(paper, "orthographic");
    drawText(paper, "no data", middle, middle, "center", 13, paper.muted);
  }

  private drawDisk(paper: Paper, hemisphere: Hemisphere, projection: SkyProjection): void {
    const diameter = Math.round(2 * radius_px * paper.ratio), image = paper.context.createImageData(diameter, diameter);
    if (this.made?.diameter !== diameter || this.made.projection !== projection) {
      this.directions = directionsOfPixels(diameter, projection);
      this.made = { diameter, projection };
    }
    this.directions.forEach((direction, n) => {
      const colour = colours[hemisphere.parts[direction] ?? -1];
      if (colour) image.data.set([...colour, 255], 4 * n);
    });
    paper.context.putImageData(image, margin_px * paper.ratio, margin_px * paper.ratio);
  }
}

const middle = 0.5 * edge_px, radius_px = middle - margin_px;

function placeOf(azimuth_deg: number, elevation_deg: number, projection: SkyProjection): [number, number] {
  const r = radius_px * radiusOf((90 - elevation_deg) * degree, projection);
  return [middle - r * Math.sin(azimuth_deg * degree), middle - r * Math.cos(azimuth_deg * degree)];
}

const elevations_deg = [30, 60];

function drawRings({ context, ...paper }: Paper, projection: SkyProjection): void {
  context.lineWidth = 0.7;
  for (const elevation_deg of elevations_deg)
    circle(context, radius_px * radiusOf((90 - elevation_deg) * degree, projection), "rgb(140 150 160 / 80%)");
  context.lineWidth = 1.2;
  circle(context, radius_px, paper.muted);
}

/** On all colours of the sky, which are the same in both themes, and on the horizon. */
const inkOnSky = "rgb(32 32 32)", halo = "rgb(255 255 255)";

function drawElevations(paper: Paper, projection: SkyProjection): void {
  for (const elevation_deg of elevations_deg) {
    const [x, y] = placeOf(45, elevation_deg, projection);
    drawText(paper, `${elevation_deg}°`, x + 3, y - 3, "left", 10, inkOnSky, halo);
  }
}

function circle(context: CanvasRenderingContext2D, radius: number, colour: string): void {
  context.beginPath();
  context.arc(middle, middle, radius, 0, 2 * Math.PI);
  context.strokeStyle = colour;
  context.stroke();
}

function drawHorizon({ context }: Paper, hemisphere: Hemisphere, projection: SkyProjection): void {
  const step_deg = 360 / azimuthsOfHemisphere;
  context.beginPath();
  hemisphere.slopes.forEach((slope, n) => {
    const elevation_deg = Math.atan(slope) / degree;
    // From one end of the part to the other
    context.lineTo(...placeOf(n * step_deg, elevation_deg, projection));
    context.lineTo(...placeOf((n + 1) * step_deg, elevation_deg, projection));
  });
  context.closePath();
  context.lineJoin = "round";
  context.lineWidth = 1.3;
  context.strokeStyle = lineColours.horizon;
  context.stroke();
}

function drawDirections(paper: Paper): void {
  const away = radius_px + 9;
  drawText(paper, "N", middle, middle - away, "center", 12);
  drawText(paper, "S", middle, middle + away, "center", 12);
  drawText(paper, "E", middle - away, middle, "center", 12);
  drawText(paper, "W", middle + away, middle, "center", 12);
}
