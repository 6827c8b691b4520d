// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
//
// A town of boxes as 3D Tiles, made as farlod-view makes them: for tests of the page that need no package.

export const grid = {
  bearing_deg: 20, convergence_deg: 0.4, cell_edge_m: 150, neighborhood: 3,
  i_begin: 0, j_begin: 0, i_end: 8, j_end: 8, corner_m: [-400, -650],
};
export const origin_m = [-23500, -9800, 12.25];
export const levelOfCells = 3;
const bearing = (grid.bearing_deg * Math.PI) / 180;
const ex = [Math.cos(bearing), -Math.sin(bearing)], ey = [Math.sin(bearing), Math.cos(bearing)];

/** Local metres of a place of the grid, counted in metres along its axes. */
export const localOfGrid = (u, v) =>
  [grid.corner_m[0] + u * ex[0] + v * ey[0], grid.corner_m[1] + u * ex[1] + v * ey[1]];
export const gridOfLocal = (x, y) => {
  const dx = x - grid.corner_m[0], dy = y - grid.corner_m[1];
  return [dx * ex[0] + dy * ex[1], dx * ey[0] + dy * ey[1]];
};

const chance = (i, j, n) => {
  const s = Math.sin(i * 127.1 + j * 311.7 + n * 74.7) * 43758.5453;
  return s - Math.floor(s);
};

/** Nine boxes a cell, with the streets between them. */
export function boxesOfCell(i, j) {
  const boxes = [];
  for (let n = 0; n < 9; ++n) {
    const u = i * 150 + (n % 3) * 50 + 9, v = j * 150 + Math.floor(n / 3) * 50 + 9;
    const height = 6 + 30 * chance(i, j, n) ** 3 + (chance(i, j, n + 20) > 0.97 ? 45 : 0);
    if (chance(i, j, n + 40) > 0.12) boxes.push({ name: `b-${i}-${j}-${n}`, u, v, width: 32, depth: 26 + 6 * chance(i, j, n + 9), height });
  }
  return boxes;
}

/** A grove above the roofs in the middle of the town: 40 × 40 columns of 3 m, from 40 m to 60 m. */
export function crownsOfTown() {
  const [x, y] = localOfGrid(600, 600), side = 40, step_m = 3;
  const head = new Float32Array([x - (side * step_m) / 2, y + (side * step_m) / 2, step_m, 40, 0.1]);
  const columns = Uint16Array.from({ length: side * side * 4 }, (_, n) =>
    [Math.floor(n / 4) % side, Math.floor(n / 4 / side), 0, 200][n % 4]);
  return Buffer.concat([Buffer.from(head.buffer), Buffer.from(columns.buffer)]);
}
export const sizeOfGrove = 1600;

/** Not a sky view factor, but something as smooth, between 0 and 1. */
export function valueAt(x, y, z, tilt_deg) {
  const [u, v] = gridOfLocal(x, y);
  const street = 0.62 + 0.2 * Math.cos((2 * Math.PI * u) / 50) * Math.cos((2 * Math.PI * v) / 50);
  return Math.min(1, (street + Math.min(0.3, z * 0.01)) * (tilt_deg > 45 ? 0.5 : 1));
}

class Facets {
  positions = []; values = []; ids = []; surfaces = [];

  addSurface(building, surface, kind) { return this.surfaces.push({ building, surface, kind }) - 1; }

  /** A quadrangle by corners of grid metres and height, cut into parts × parts facets. */
  addQuad(id, corners, parts, tilt_deg, withoutValue = false) {
    const at = (s, t) => [0, 1, 2].map((k) =>
      (1 - s) * (1 - t) * corners[0][k] + s * (1 - t) * corners[1][k] + s * t * corners[2][k] + (1 - s) * t * corners[3][k]);
    for (let a = 0; a < parts; ++a)
      for (let b = 0; b < parts; ++b) {
        const s = [a / parts, (a + 1) / parts], t = [b / parts, (b + 1) / parts];
        this.addTriangle(id, [at(s[0], t[0]), at(s[1], t[0]), at(s[1], t[1])], tilt_deg, withoutValue);
        this.addTriangle(id, [at(s[0], t[0]), at(s[1], t[1]), at(s[0], t[1])], tilt_deg, withoutValue);
      }
  }

  addTriangle(id, corners, tilt_deg, withoutValue) {
    const places = corners.map(([u, v, z]) => [...localOfGrid(u, v), z]);
    const middle = [0, 1, 2].map((k) => (places[0][k] + places[1][k] + places[2][k]) / 3);
    const value = withoutValue ? NaN : valueAt(...middle, tilt_deg);
    for (const [x, y, z] of places) {
      this.positions.push(x, z, -y);  // glTF is y up
      this.values.push(value);
      this.ids.push(id);
    }
  }
}

function addBox(facets, box, parts) {
  const { u, v, width: w, depth: d, height: h, name } = box;
  const foot = [[u, v], [u + w, v], [u + w, v + d], [u, v + d]];
  facets.addQuad(facets.addSurface(name, 0, "roof"), foot.map(([a, b]) => [a, b, h]), parts, 0);
  foot.forEach((a, n) => {
    const b = foot[(n + 1) % 4];
    facets.addQuad(facets.addSurface(name, n + 1, "wall"), [[...a, 0], [...b, 0], [...b, h], [...a, h]], parts, 90);
  });
}

/** At the southern border of the first cell, and seen from the south. */
export const wallOfGround = [[20, 4, 0], [130, 4, 0], [130, 4, 20], [20, 4, 20]];

/** The facets of a tile, finer the deeper it lies. */
function facetsOfTile(level, x, y) {
  const facets = new Facets(), cells = 2 ** (levelOfCells - level), parts = [1, 2, 3, 6][level];
  for (let i = x * cells; i < (x + 1) * cells; ++i)
    for (let j = y * cells; j < (y + 1) * cells; ++j) {
      const corners = [[0, 0], [150, 0], [150, 150], [0, 150]].map(([u, v]) => [i * 150 + u, j * 150 + v, 0]);
      facets.addQuad(facets.addSurface("", i * 8 + j, "ground"), corners, 6 * parts, 0, i === 7 && j === 7);
      // As in a surface model, whose walls are ground
      if (i === 0 && j === 0) facets.addQuad(facets.addSurface("", 64, "ground"), wallOfGround, parts, 90);
      for (const box of boxesOfCell(i, j)) addBox(facets, box, parts);
    }
  return facets;
}

const padded = (buffer, filling) => Buffer.concat([buffer, Buffer.alloc((4 - (buffer.length % 4)) % 4, filling)]);

/** The binary chunk of a GLB, and the views into it. */
class BinaryChunk {
  parts = []; views = []; length = 0;

  add(data, target) {
    const bytes = padded(Buffer.from(data.buffer, data.byteOffset, data.byteLength), 0);
    this.views.push({ buffer: 0, byteOffset: this.length, byteLength: data.byteLength, ...(target ? { target } : {}) });
    this.parts.push(bytes);
    this.length += bytes.length;
    return this.views.length - 1;
  }

  addStrings(strings) {
    const texts = strings.map((text) => Buffer.from(text)), offsets = new Uint32Array(texts.length + 1);
    texts.forEach((text, n) => { offsets[n + 1] = offsets[n] + text.length; });
    return { values: this.add(Buffer.concat([...texts, Buffer.alloc(1)])), stringOffsets: this.add(offsets) };
  }
}

const arrayBuffer = 34962;

function primitiveOf(json, chunk, facets, withValue) {
  const chosen = facets.values.flatMap((value, n) => (Number.isNaN(value) === withValue ? [] : [n]));
  if (chosen.length === 0) return [];
  const accessor = (data, type, extra = {}) => json.accessors.push(
    { bufferView: chunk.add(data, arrayBuffer), componentType: 5126, count: chosen.length, type, ...extra }) - 1;
  const positions = new Float32Array(chosen.flatMap((n) => facets.positions.slice(3 * n, 3 * n + 3)));
  const extreme = (f) => [0, 1, 2].map((k) => positions.reduce((m, p, n) => (n % 3 === k ? f(m, p) : m), f === Math.min ? Infinity : -Infinity));
  const attributes = {
    POSITION: accessor(positions, "VEC3", { min: extreme(Math.min), max: extreme(Math.max) }),
    _FEATURE_ID_0: accessor(new Float32Array(chosen.map((n) => facets.ids[n])), "SCALAR"),
  };
  if (withValue) {
    attributes._SVF = accessor(new Float32Array(chosen.map((n) => facets.values[n])), "SCALAR");
    attributes.TEXCOORD_0 = accessor(new Float32Array(chosen.flatMap((n) => [facets.values[n], 0.5])), "VEC2");
  }
  const features = { featureIds: [{ featureCount: facets.surfaces.length, attribute: 0, propertyTable: 0 }] };
  return [{ attributes, material: withValue ? 0 : 1, extensions: { EXT_mesh_features: features } }];
}

function metadataOf(chunk, surfaces) {
  const building = chunk.addStrings(surfaces.map((s) => s.building)), kind = chunk.addStrings(surfaces.map((s) => s.kind));
  const surface = { values: chunk.add(new Uint32Array(surfaces.map((s) => s.surface))) };
  const properties = { building: { type: "STRING" }, surface: { type: "SCALAR", componentType: "UINT32" }, kind: { type: "STRING" } };
  return {
    schema: { id: "farlod", classes: { surface: { properties } } },
    propertyTables: [{ class: "surface", count: surfaces.length, properties: { building, surface, kind } }],
  };
}

const tiles = new Map();

/** The tile, made once. */
export function glbOfTile(level, x, y) {
  const name = `${level}/${x}/${y}`;
  if (!tiles.has(name)) tiles.set(name, makeGlb(level, x, y));
  return tiles.get(name);
}

function makeGlb(level, x, y) {
  const facets = facetsOfTile(level, x, y), chunk = new BinaryChunk();
  const json = {
    asset: { version: "2.0" }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }], accessors: [],
    materials: [{ name: "svf", extensions: { KHR_materials_unlit: {} } }, { name: "no data", extensions: { KHR_materials_unlit: {} } }],
    extensionsUsed: ["KHR_materials_unlit", "EXT_mesh_features", "EXT_structural_metadata"],
  };
  json.meshes = [{ primitives: [...primitiveOf(json, chunk, facets, true), ...primitiveOf(json, chunk, facets, false)] }];
  json.extensions = { EXT_structural_metadata: metadataOf(chunk, facets.surfaces) };
  json.bufferViews = chunk.views;
  json.buffers = [{ byteLength: chunk.length }];
  const text = padded(Buffer.from(JSON.stringify(json)), 32), head = Buffer.alloc(20), middle = Buffer.alloc(8);
  head.write("glTF", 0);
  [2, 28 + text.length + chunk.length, text.length, 0x4e4f534a].forEach((value, n) => head.writeUInt32LE(value, 4 + 4 * n));
  [chunk.length, 0x004e4942].forEach((value, n) => middle.writeUInt32LE(value, 4 * n));
  return Buffer.concat([head, text, middle, ...chunk.parts]);
}

/** East, north and up at a place of the Earth as a sphere would have them: the page shall undo whatever stands here. */
function ecefOfLocal() {
  const lon = 2.44, lat = 0.627, r = 6371000, { sin, cos } = Math;
  return [-sin(lon), cos(lon), 0, 0, -sin(lat) * cos(lon), -sin(lat) * sin(lon), cos(lat), 0,
          cos(lat) * cos(lon), cos(lat) * sin(lon), sin(lat), 0,
          r * cos(lat) * cos(lon), r * cos(lat) * sin(lon), r * sin(lat), 1];
}

export function tilesetOfTown() {
  const half = 600, [cx, cy] = localOfGrid(half, half), high = 90;
  return {
    asset: { version: "1.1" }, geometricError: 200,
    root: {
      transform: ecefOfLocal(), refine: "REPLACE", geometricError: 40, content: { uri: "tiles/{level}/{x}/{y}.glb" },
      boundingVolume: { box: [cx, cy, high / 2, ex[0] * half, ex[1] * half, 0, ey[0] * half, ey[1] * half, 0, 0, 0, high / 2] },
      implicitTiling: { subdivisionScheme: "QUADTREE", availableLevels: levelOfCells + 1, subtreeLevels: levelOfCells + 1,
                        subtrees: { uri: "subtrees/{level}/{x}/{y}.subtree" } },
    },
  };
}

export function subtreeOfTown() {
  const all = { constant: 1 };
  const text = Buffer.from(JSON.stringify({ tileAvailability: all, contentAvailability: [all], childSubtreeAvailability: { constant: 0 } }));
  const json = Buffer.concat([text, Buffer.alloc((8 - (text.length % 8)) % 8, 32)]), head = Buffer.alloc(24);
  head.write("subt", 0);
  head.writeUInt32LE(1, 4);
  head.writeUInt32LE(json.length, 8);
  return Buffer.concat([head, json]);
}
