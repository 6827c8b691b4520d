// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
//
// An exported tileset, as the validator of Khronos and the tools of Cesium read it. They are no packages of the page, so that
// the test is skipped unless FARLOD_VALIDATORS names a folder where they are installed.
//
//   npm install --prefix FOLDER --ignore-scripts gltf-validator 3d-tiles-tools
//   FARLOD_VALIDATORS=FOLDER node tests/viewer/tileset_test.mjs FOLDER_OF_PROGRAMS
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { expect, expectEqual } from "./checks.mjs";

const skipped = 77, programs = process.argv[2], validators = process.env.FARLOD_VALIDATORS;
if (!validators || !existsSync(join(validators, "node_modules/gltf-validator"))) {
  console.log("skipped: FARLOD_VALIDATORS names no folder with the packages gltf-validator and 3d-tiles-tools");
  process.exit(skipped);
}
const require = createRequire(join(validators, "package.json")), validator = require("gltf-validator");
const { TilesetTraverser, ResourceResolvers } = await import(pathToFileURL(join(validators, "node_modules/3d-tiles-tools/build/src/index.js")).href);

/** Tiles of a tileset below its implicit root, with what the tools make of them. */
async function tilesOf(folder) {
  const tileset = JSON.parse(readFileSync(join(folder, "tileset.json"), "utf8")), tiles = [];
  const traverser = new TilesetTraverser(folder, ResourceResolvers.createFileResourceResolver(folder), { depthFirst: false, traverseExternalTilesets: false });
  await traverser.traverse(tileset, async (tile) => {
    if (tile.level > 0) tiles.push({ error_m: tile.asFinalTile().geometricError, contents: tile.getFinalContents().map(({ uri }) => uri) });
    return true;
  });
  return { tileset, tiles };
}

async function expectValid(path) {
  const { issues } = await validator.validateBytes(new Uint8Array(readFileSync(path)));
  const told = issues.messages.map(({ code, message }) => `${code} ${message}`).join("; ");
  expect(issues.numErrors === 0 && issues.numWarnings === 0, `${path} has ${issues.numErrors} errors and ${issues.numWarnings} warnings: ${told}`);
}

const folder = mkdtempSync(join(tmpdir(), "farlod-tileset-")), of = (name) => join(folder, name);
const run = (program, ...options) => execFileSync(join(programs, program), [...options, "--quiet"]);
try {
  run("farlod-city", "--size", "600", "--seed", "7", "--rotation", "20", "-o", of("town.gml"));
  // So many cells that the root has no content
  run("farlod-pack", of("town.gml"), "-o", of("town.farlod"), "--cell", "60");
  run("farlod-view", of("town.farlod"), "--export", of("page"));
  const { tileset, tiles } = await tilesOf(of("page")), contents = tiles.flatMap((tile) => tile.contents);
  const files = readdirSync(of("page/tiles"), { recursive: true }).filter((name) => name.endsWith(".glb")).map((name) => `tiles/${name}`);
  expectEqual(contents.sort(), files.sort(), "the contents that the tools find");
  for (const name of files) await expectValid(join(of("page"), name));
  const empty = tiles.filter((tile) => tile.contents.length === 0);
  expect(empty.length > 0, "all tiles have content");
  for (const { error_m } of empty) expect(error_m > tileset.root.geometricError, `a tile without content has an error of ${error_m} m only`);
  console.log(`passed: ${files.length} tiles without an error, ${empty.length} without content`);
} finally {
  rmSync(folder, { recursive: true });
}
