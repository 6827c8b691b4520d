// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { drawText, lineColours, type Paper, paperOf, partColours, cssOf } from "./drawing.ts";
import { type Frames, turned } from "./frames.ts";
import { Vector3 } from "three";
import type { FarEdge, FarView } from "./server.ts";

const degree = Math.PI / 180, width_px = 316, height_px = 150;
const box = { left: 26, top: 6, width: width_px - 34, height: height_px - 26 };
/** A straight edge is bent on a panorama. */
const partsOfEdge = 12;

const elevation_deg = (slope: number): number => Math.atan(slope) / degree;

/** The least round elevation that shows the residual city and the ends of all edges; none below 5°. */
function topOf(far: FarView): number {
  const [x, y, z] = far.eye_m, steepness = (px: number, py: number, pz: number): number => (pz - z) / Math.hypot(px - x, py - y);
  const steepest = (most: number, [ax, ay, az, bx, by, bz]: FarEdge): number =>
    Math.max(most, steepness(ax, ay, az), steepness(bx, by, bz));
  const highest = elevation_deg(far.edges.reduce(steepest, Math.max(...far.high)));
  return [5, 10, 15, 30, 45, 60, 90].find((top) => top >= highest) ?? 90;
}

const xOf = (azimuth_deg: number): number => box.left + (azimuth_deg / 360) * box.width;
const yOf = (elevation: number, top: number): number => box.top + box.height * (1 - Math.min(top, Math.max(0, elevation)) / top);

/** Slopes of azimuths as a path of steps, from the north to the north. */
function stepsOf(slopes: readonly number[], first_azimuth_deg: number, top: number): Path2D {
  const path = new Path2D();
  for (let column = 0; column < box.width; ++column) {
    const turn = turned(((column + 0.5) / box.width) * 360 - first_azimuth_deg) / 360;
    const y = yOf(elevation_deg(slopes[Math.floor(turn * slopes.length)] ?? 0), top);
    path.lineTo(box.left + column, y);
    path.lineTo(box.left + column + 1, y);
  }
  return path;
}

function fillBelow({ context }: Paper, steps: Path2D, colour: string): void {
  const area = new Path2D(steps);
  area.lineTo(box.left + box.width, box.top + box.height);
  area.lineTo(box.left, box.top + box.height);
  context.fillStyle = colour;
  context.fill(area);
}

function drawEdges({ context }: Paper, far: FarView, frames: Frames, top: number): void {
  context.beginPath();
  const eye = new Vector3(...far.eye_m);
  for (const [ax, ay, az, bx, by, bz] of far.edges) {
    let last: number | null = null;
    for (let n = 0; n <= partsOfEdge; ++n) {
      const sight = new Vector3(ax, ay, az).lerp(new Vector3(bx, by, bz), n / partsOfEdge).sub(eye);
      const azimuth = frames.trueAzimuth_deg(sight), y = yOf(elevation_deg(sight.z / Math.hypot(sight.x, sight.y)), top);
      // What crosses the north would run through the whole picture
      if (last !== null && Math.abs(azimuth - last) < 180) context.lineTo(xOf(azimuth), y);
      else context.moveTo(xOf(azimuth), y);
      last = azimuth;
    }
  }
  context.lineWidth = 1;
  context.strokeStyle = lineColours.edge;
  context.stroke();
}

function drawAxes(paper: Paper, top: number): void {
  const step = top > 45 ? 30 : top > 10 ? 5 * Math.ceil(top / 15) : top / 5;
  for (let elevation = 0; elevation <= top; elevation += step)
    drawText(paper, `${elevation}°`, box.left - 4, yOf(elevation, top), "right", 10, paper.muted);
  ["N", "E", "S", "W", "N"].forEach((letter, n) => drawText(paper, letter, xOf(90 * n), height_px - 9, "center", 11));
  paper.context.strokeStyle = paper.muted;
  paper.context.lineWidth = 0.7;
  paper.context.strokeRect(box.left, box.top, box.width, box.height);
}

/** Draws what a cell's far map says of the far city as seen from its middle. */
export function drawFarPanorama(canvas: HTMLCanvasElement, far: FarView, frames: Frames): void {
  const paper = paperOf(canvas, width_px, height_px), top = topOf(far), { context } = paper;
  context.fillStyle = cssOf(partColours.sky);
  context.fillRect(box.left, box.top, box.width, box.height);
  fillBelow(paper, stepsOf(far.high, far.first_azimuth_deg, top), lineColours.undecided);
  fillBelow(paper, stepsOf(far.low, far.first_azimuth_deg, top), lineColours.hidden);
  context.lineWidth = 1.2;
  context.strokeStyle = lineColours.horizon;
  context.stroke(stepsOf(far.estimate, far.first_azimuth_deg, top));
  drawEdges(paper, far, frames, top);
  drawAxes(paper, top);
}
