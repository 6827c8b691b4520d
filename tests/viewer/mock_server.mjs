// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
//
// Serves the page and a town of boxes as farlod-view does (viewer/README.md, "What the page asks for").
//
//   node tests/viewer/mock_server.mjs [PORT] [--damaged | --export]
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { fileURLToPath } from "node:url";
import { resultsOfTown } from "./mock_results.mjs";
import { boxesOfCell, sizeOfGrove, crownsOfTown, glbOfTile, grid, gridOfLocal, localOfGrid, origin_m, subtreeOfTown, tilesetOfTown, valueAt } from "./mock_town.mjs";

const bundle = new URL("../../viewer/bundle/", import.meta.url);
const types = { html: "text/html; charset=utf-8", js: "text/javascript", css: "text/css", txt: "text/plain; charset=utf-8" };

// Viridis at every eighth, as farlod-svf's pictures have it
const viridis = [[68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37]];
const colours = Array.from({ length: 256 }, (_, n) => {
  const place = (n / 255) * 8, below = Math.min(7, Math.floor(place));
  return viridis[below].map((c, k) => Math.round(c + (place - below) * (viridis[below + 1][k] - c)));
});

const boxes = [];
for (let i = grid.i_begin; i < grid.i_end; ++i) for (let j = grid.j_begin; j < grid.j_end; ++j) boxes.push(...boxesOfCell(i, j));

function viewOf(canAnswer, hasTrees) {
  return {
    software: "mock of farlod-view", name: "boxes.farlod", crs: "JGD2011 / Japan Plane Rectangular CS IX", epsg: 6677, origin_m, can_answer: canAnswer, grid,
    heights_m: [0, 85], counts: { buildings: boxes.length, polygons: boxes.length * 5, triangles: boxes.length * 10, crowns: hasTrees ? sizeOfGrove : 0 },
    far_map_kind: "horizon", receiver_height_m: 1.5, colours, nodata_colour: [190, 190, 190], tileset: "tileset.json",
    results: resultsOfTown.map(({ body, labels, ...info }) => info),
  };
}

const cellAt = (x, y) => gridOfLocal(x, y).map((m) => Math.floor(m / grid.cell_edge_m));
const isInGrid = ([i, j]) => i >= grid.i_begin && i < grid.i_end && j >= grid.j_begin && j < grid.j_end;

class Refusal extends Error {
  constructor(status, message) { super(message); this.status = status; }
}

function numberOf(query, name, fallback) {
  const text = query.get(name);
  if (text === null && fallback !== undefined) return fallback;
  if (text === null || !Number.isFinite(Number(text))) throw new Refusal(400, `${name} is no number`);
  return Number(text);
}

function insideOfBox(x, y, z) {
  const [u, v] = gridOfLocal(x, y);
  return boxes.some((b) => u > b.u && u < b.u + b.width && v > b.v && v < b.v + b.depth && z < b.height);
}

function placeOf(query) {
  const x = numberOf(query, "x") - origin_m[0], y = numberOf(query, "y") - origin_m[1];
  const z = query.has("z") ? numberOf(query, "z") - origin_m[2] : 1.5;
  return { x, y, z, answer: isInGrid(cellAt(x, y)) && !insideOfBox(x, y, z) };
}

function at(query) {
  const { x, y, z, answer } = placeOf(query), cell = isInGrid(cellAt(x, y)) ? cellAt(x, y) : null;
  const place = { x_m: x + origin_m[0], y_m: y + origin_m[1], z_m: z + origin_m[2], cell, seconds: 0.001 };
  if (!answer) return { svf: null, text: null, low: null, high: null, ...place };
  const svf = valueAt(x, y, query.has("z") ? z : 0, numberOf(query, "tilt", 0));
  return { svf, text: svf.toFixed(4), low: svf - 0.004, high: Math.min(1, svf + 0.003), ...place };
}

/** A horizon that is no town's, but has near and far parts. */
function hemisphere(query) {
  const { x, y, answer } = placeOf(query);
  if (!answer) return null;
  const parts = new Uint8Array(1440 * 360), slopes = new Float32Array(1440);
  for (let a = 0; a < 1440; ++a) {
    const azimuth = (a / 1440) * 2 * Math.PI;
    const near = 70 + 60 * Math.sin(3 * azimuth + x / 40) + (a % 180 < 60 ? 40 : 0), far = 40 + 8 * Math.sin(40 * azimuth + y / 40);
    for (let e = 0; e < 360; ++e) parts[a * 360 + e] = e < near ? 1 : e < far ? 2 : a > 300 && a < 420 && e > 200 && e < 260 ? 3 : 0;
    slopes[a] = Math.tan((Math.max(near, far, 0) / 4) * (Math.PI / 180));
  }
  return Buffer.concat([Buffer.from(parts.buffer), Buffer.from(slopes.buffer)]);
}

function farOf(i, j) {
  const eye = [...localOfGrid((i + 0.5) * 150, (j + 0.5) * 150), 1.5], bins = 256;
  const slopes = (f) => Array.from({ length: bins }, (_, n) => f * (0.12 + 0.05 * Math.sin((n / bins) * 40) + 0.04 * Math.sin((n / bins) * 13)));
  const far = boxes.filter((b) => b.height > 30 && Math.hypot(b.u - (i + 0.5) * 150, b.v - (j + 0.5) * 150) > 300);
  const edges = far.map((b) => [...localOfGrid(b.u, b.v), b.height, ...localOfGrid(b.u + b.width, b.v), b.height]);
  return { eye_m: eye, first_azimuth_deg: 0, low: slopes(0.7), estimate: slopes(0.85), high: slopes(1), edges };
}

function cell(query) {
  const i = numberOf(query, "i"), j = numberOf(query, "j"), half = (grid.neighborhood - 1) / 2;
  if (!isInGrid([i, j])) throw new Refusal(404, `there is no cell ${i}, ${j}`);
  const trianglesOf = (a, b) => boxesOfCell(a, b).length * 10 + 2;
  const range = { i_begin: Math.max(0, i - half), j_begin: Math.max(0, j - half), i_end: Math.min(8, i + half + 1), j_end: Math.min(8, j + half + 1) };
  const near = [];
  for (let a = range.i_begin; a < range.i_end; ++a) for (let b = range.j_begin; b < range.j_end; ++b) near.push({ cell: [a, b], triangles: trianglesOf(a, b) });
  const far = farOf(i, j), corners = [[0, 0], [1, 0], [1, 1], [0, 1]].map(([u, v]) => localOfGrid((i + u) * 150, (j + v) * 150));
  return {
    cell: [i, j], corners_m: corners, triangles: trianglesOf(i, j), vertices: 3 * trianglesOf(i, j), buildings: boxesOfCell(i, j).length, grounded_edges: 120,
    overhang_edges: 0, tile_bytes: 14210, far_map_bytes: 20480, explicit_edges: far.edges.length, neighborhood: range, near_cells: near, low_m: 0, high_m: 40, far,
  };
}

function file(path) {
  const tile = path.match(/^tiles\/(\d)\/(\d+)\/(\d+)\.glb$/);
  if (tile) return { type: "model/gltf-binary", body: glbOfTile(...tile.slice(1).map(Number)) };
  const result = resultsOfTown.find(({ url }) => url === path), labels = resultsOfTown.find(({ url }) => `${url}.json` === path)?.labels;
  if (result) return { type: "application/octet-stream", body: result.body };
  if (labels) return { type: "application/json", body: Buffer.from(JSON.stringify(labels)) };
  if (/^subtrees\/0\/0\/0\.subtree$/.test(path)) return { type: "application/octet-stream", body: subtreeOfTown() };
  const name = path === "" ? "index.html" : path;
  if (!/^(index\.html|viewer\.js|viewer\.css|licences\.txt)$/.test(name)) throw new Refusal(404, `there is no ${path}`);
  return { type: types[name.split(".").pop()], body: readFileSync(fileURLToPath(new URL(name, bundle))) };
}

function answer(url, { damaged, canAnswer, hasTrees, counts }) {
  const path = url.pathname.slice(1);
  counts[path] = (counts[path] ?? 0) + 1;
  if (damaged && path === "view.json") throw new Refusal(500, "The package boxes.farlod is damaged: index.bin has a wrong checksum.");
  if (!canAnswer && ["at", "hemisphere", "cell"].includes(path)) throw new Refusal(404, `there is no ${path}`);
  const json = { "view.json": () => viewOf(canAnswer, hasTrees), "tileset.json": tilesetOfTown, at: () => at(url.searchParams), cell: () => cell(url.searchParams) }[path];
  if (json) return { type: "application/json", body: Buffer.from(JSON.stringify(json())) };
  if (path === "crowns" && hasTrees) return { type: "application/octet-stream", body: crownsOfTown() };
  if (path === "hemisphere") return { type: "application/octet-stream", body: hemisphere(url.searchParams) };
  return file(path);
}

/** The server, listening on a port of its own choice unless told. `counts` has how often each path was asked for. */
export async function startMock({ port = 0, damaged = false, canAnswer = true, hasTrees = true } = {}) {
  const counts = {};
  const server = createServer((request, response) => {
    try {
      const { type, body } = answer(new URL(request.url, "http://localhost"), { damaged, canAnswer, hasTrees, counts });
      response.writeHead(body ? 200 : 204, { "Content-Type": type, "Cache-Control": "no-store" }).end(body ?? undefined);
    } catch (error) {
      response.writeHead(error.status ?? 500, { "Content-Type": "application/json" }).end(JSON.stringify({ error: error.message }));
    }
  });
  await new Promise((resolve) => server.listen(port, "127.0.0.1", resolve));
  const stop = () => new Promise((resolve) => { server.close(resolve); server.closeAllConnections(); });
  return { url: `http://127.0.0.1:${server.address().port}/`, counts, stop };
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const options = process.argv.slice(2);
  const { url } = await startMock({ port: Number(options[0] ?? 8124), damaged: options.includes("--damaged"), canAnswer: !options.includes("--export") });
  console.log(url);
}
