// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
//
// Results beside the town of boxes, as farlod-view hands them over: rasters,
// points, a problem, and tables of the surfaces of its buildings.

import { boxesOfCell, grid } from "./mock_town.mjs";

const floats = (numbers) => Buffer.from(new Float32Array(numbers).buffer);

/** 2 × 2 pixels over the whole town; the western half has the first value, the eastern one the second. */
const raster = (name, url, west, east, range = [0, 1]) => ({
  name, form: "raster", quantity: "svf", unit: "", url, count: 4, range, width: 2, height: 2, local_from_pixel: [-2000, 2000, 0, 2000, 0, -2000],
  body: floats([west, east, west, east]),
});

const boxes = Array.from({ length: grid.i_end * grid.j_end }, (_, n) => boxesOfCell(n % grid.i_end, Math.floor(n / grid.i_end))).flat();

/** One value for all roofs but those of some buildings, which the table lacks. */
function tableOfRoofs(name, url, value, range = [0, 1], isKnown = () => true, of = { quantity: "svf_mean", unit: "" }) {
  const known = boxes.filter(isKnown);
  return { name, form: "surfaces", ...of, url, count: known.length, range, labels: known.map((box) => box.name),
           body: floats(known.flatMap((_, n) => [n, 0, value])) };
}

/** Low in the west and high in the east, and the other way round. The third has a hole in the west. */
export const resultsOfTown = [
  raster("summer.tif", "results/0", 0.25, 0.75),
  raster("winter.tif", "results/1", 0.5, 0.5),
  raster("hole.tif", "results/2", NaN, 1),
  { name: "posts.csv", form: "points", quantity: "svf", unit: "", url: "results/3", count: 2, range: [0, 1], labels: ["north post", "south post"],
    body: floats([0, 40, 1.5, 0.125, 0, -40, 1.5, NaN]) },
  { name: "report.geojson", form: "problems", quantity: "", unit: "", url: "results/4", count: 1, range: [0, 1],
    labels: ["107 zero_area, left out: b-3-3-1. All points lie on a line."], body: floats([-60, 0, NaN, NaN]) },
  raster("hours.tif", "results/5", 2.5, 7.5, [0, 10]),
  tableOfRoofs("before.surfaces.csv", "results/6", 0.875),
  tableOfRoofs("after.surfaces.csv", "results/7", 0.375),
  tableOfRoofs("sun.surfaces.csv", "results/8", 5, [0, 10]),
  tableOfRoofs("some.surfaces.csv", "results/9", 0.375, [0, 1], ({ name }) => Number(name.split("-")[3]) % 2 === 0),
  tableOfRoofs("year.surfaces.csv", "results/10", 625, [0, 1250], () => true, { quantity: "irradiation_mean", unit: "kWh/m²" }),
];
