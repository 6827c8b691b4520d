// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { Vector3 } from "three";
import type { CellIndex, GridInfo, Triple, ViewInfo } from "./view_info.ts";

const degree = Math.PI / 180;

export const turned = (angle_deg: number): number => ((angle_deg % 360) + 360) % 360;

/** The frames of a package: local (x east, y north, z up, from its origin), projected, and the cells of its grid. */
export class Frames {
  private readonly origin: Vector3;
  readonly grid: GridInfo;
  private readonly x_axis: [number, number];
  private readonly y_axis: [number, number];

  constructor(view: ViewInfo) {
    this.origin = new Vector3(...view.origin_m);
    this.grid = view.grid;
    const bearing = view.grid.bearing_deg * degree;
    this.x_axis = [Math.cos(bearing), -Math.sin(bearing)];
    this.y_axis = [Math.sin(bearing), Math.cos(bearing)];
  }

  projectedOf(p_local: Vector3): Triple {
    return [p_local.x + this.origin.x, p_local.y + this.origin.y, p_local.z + this.origin.z];
  }

  localOf(p_projected: Triple): Vector3 {
    return new Vector3(...p_projected).sub(this.origin);
  }

  /** Clockwise from true north; 0 for a direction straight up or down. */
  trueAzimuth_deg(direction_local: Vector3): number {
    if (Math.hypot(direction_local.x, direction_local.y) < 1e-6) return 0;
    return turned(Math.atan2(direction_local.x, direction_local.y) / degree + this.grid.convergence_deg);
  }

  directionOf(azimuth_deg: number, tilt_deg: number): Vector3 {
    const azimuth = (azimuth_deg - this.grid.convergence_deg) * degree, tilt = tilt_deg * degree;
    return new Vector3(Math.sin(tilt) * Math.sin(azimuth), Math.sin(tilt) * Math.cos(azimuth), Math.cos(tilt));
  }

  /** The south-west corner of a cell, whole numbers or not. */
  cornerOfCell(i: number, j: number): [number, number] {
    const u = (i - this.grid.i_begin) * this.grid.cell_edge_m, v = (j - this.grid.j_begin) * this.grid.cell_edge_m;
    return [
      this.grid.corner_m[0] + u * this.x_axis[0] + v * this.y_axis[0],
      this.grid.corner_m[1] + u * this.x_axis[1] + v * this.y_axis[1],
    ];
  }

  cellAt(x_local: number, y_local: number): CellIndex | null {
    const dx = x_local - this.grid.corner_m[0], dy = y_local - this.grid.corner_m[1];
    const i = this.grid.i_begin + Math.floor((dx * this.x_axis[0] + dy * this.x_axis[1]) / this.grid.cell_edge_m);
    const j = this.grid.j_begin + Math.floor((dx * this.y_axis[0] + dy * this.y_axis[1]) / this.grid.cell_edge_m);
    const inside = i >= this.grid.i_begin && i < this.grid.i_end && j >= this.grid.j_begin && j < this.grid.j_end;
    return inside ? [i, j] : null;
  }

  /** The middle of all cells, and half of the diagonal of their square. */
  extent(): { middle: [number, number]; radius_m: number } {
    const { i_begin, i_end, j_begin, j_end, cell_edge_m } = this.grid;
    return {
      middle: this.cornerOfCell((i_begin + i_end) / 2, (j_begin + j_end) / 2),
      radius_m: 0.5 * cell_edge_m * Math.hypot(i_end - i_begin, j_end - j_begin),
    };
  }
}

/** Of a normal, its angle to straight up. */
export const tilt_deg = (normal: Vector3): number => Math.acos(Math.min(1, Math.max(-1, normal.z))) / degree;
