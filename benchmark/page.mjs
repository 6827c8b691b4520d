#!/usr/bin/env node
// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
//
// What a user of farlod-view waits for: the first picture, the answer to a click, the fisheye; and what a flight takes of memory.
//
//   benchmark/page.mjs [--turns 5] [--clicks 40] [--flight 0] PACKAGE...
//
// The first picture counts from the start of the program to the first complete frame, in an empty page of a headless Chromium that
// is open already, and draws without a graphics processor. A click's answer and its fisheye count from the request to the last byte
// of the answer. --flight N looks at N places along a path through the whole city, close to the ground and from afar by turns, and
// prints the memory of the browser's processes and of the server in the thirds of the flight. FARLOD_BIN says which program is
// measured (default: build/bin). It needs what the tests of the page need: scripts/viewer, and Chromium.
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { basename } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";
import { missing, openBrowser, ready, state, atRest, until } from "../tests/viewer/browser.mjs";
import { starterOf } from "../tests/viewer/servers.mjs";

const { values: options, positionals: packages } = parseArgs({
  allowPositionals: true,
  options: { turns: { type: "string", default: "5" }, clicks: { type: "string", default: "40" }, flight: { type: "string", default: "0" } },
});
const program = `${process.env.FARLOD_BIN ?? fileURLToPath(new URL("../build/bin", import.meta.url))}/farlod-view`;
const size = { width: 1280, height: 800 };
const median = (numbers) => [...numbers].sort((a, b) => a - b)[Math.floor(numbers.length / 2)];
const greatest = (numbers) => Math.max(...numbers);

async function withPage(browser, url, look) {
  const context = await browser.newContext({ viewport: size }), page = await context.newPage();
  await page.goto(url);
  await ready(page);
  const answer = await look(page);
  await context.close();
  return answer;
}

async function firstPicture(browser, start) {
  const context = await browser.newContext({ viewport: size }), page = await context.newPage();
  const begin_ms = performance.timeOrigin + performance.now(), server = await start();
  await page.goto(server.url);
  await ready(page);
  // By the page's own clock: what drives the browser from here has its news late while it draws
  const end_ms = (await page.evaluate(() => performance.timeOrigin)) + (await state(page)).readyAt_ms;
  await context.close();
  await server.stop();
  return (end_ms - begin_ms) / 1000;
}

/** Clicks at places of the window; how long each question of the page took, in milliseconds. */
async function questions(page, clicks) {
  await atRest(page);
  for (let n = 0; n < clicks; ++n) {
    await page.mouse.click(300 + ((n * 97) % 560), 200 + ((n * 61) % 420));
    await until(page, "the answer", ({ resting }) => resting);
  }
  const entries = await page.evaluate(() => performance.getEntriesByType("resource").map(({ name, duration }) => [name, duration]));
  const durationsOf = (path) => entries.filter(([name]) => name.includes(`/${path}?`)).map(([, duration]) => duration);
  return { at: durationsOf("at"), hemisphere: durationsOf("hemisphere") };
}

/** Mebibytes of what a process has of its own, and its share of the rest. */
function memoryOf(pid) {
  try {
    return Number(readFileSync(`/proc/${pid}/smaps_rollup`, "utf8").match(/^Pss:\s+(\d+)/m)?.[1] ?? 0) / 1024;
  } catch {
    return 0;  // It has ended
  }
}

const processesNamed = (name) =>
  execFileSync("ps", ["-eo", "pid=,comm="], { encoding: "utf8" }).split("\n").map((line) => line.trim().split(/\s+/))
    .filter(([, command]) => command?.startsWith(name)).map(([pid]) => pid);
const memoryOfAll = (name) => processesNamed(name).reduce((sum, pid) => sum + memoryOf(pid), 0);

/** A zigzag over the grid; every third place is seen from afar. */
async function fly(page, grid, places, look) {
  const across = Math.ceil(Math.sqrt(places)), edge_m = grid.cell_edge_m;
  const bearing = (grid.bearing_deg * Math.PI) / 180, width = (grid.i_end - grid.i_begin) * edge_m, depth = (grid.j_end - grid.j_begin) * edge_m;
  for (let n = 0; n < places; ++n) {
    const row = Math.floor(n / across), column = row % 2 === 0 ? n % across : across - 1 - (n % across);
    const u = ((column + 0.5) / across) * width, v = ((row + 0.5) / across) * depth;
    const x = grid.corner_m[0] + u * Math.cos(bearing) + v * Math.sin(bearing), y = grid.corner_m[1] - u * Math.sin(bearing) + v * Math.cos(bearing);
    await page.evaluate((hash) => { location.hash = hash; }, `camera=${look.origin[0] + x},${look.origin[1] + y},${look.origin[2]},${n % 3 === 2 ? 6000 : 500},${(n * 37) % 360},55`);
    await page.waitForTimeout(100);
    await atRest(page);
    look.record(n);
  }
}

async function flight(browser, start, places) {
  const server = await start(), { grid, origin_m } = await (await fetch(`${server.url}view.json`)).json();
  const thirds = [0, 1, 2].map(() => ({ browser: 0, server: 0 }));
  await withPage(browser, server.url, (page) => fly(page, grid, places, {
    origin: origin_m,
    record(n) {
      const third = thirds[Math.floor((3 * n) / places)];
      third.browser = Math.max(third.browser, memoryOfAll("chrom"));
      third.server = Math.max(third.server, memoryOfAll("farlod-view"));
    },
  }));
  await server.stop();
  const text = thirds.map(({ browser: b, server: s }) => `${b.toFixed(0)} and ${s.toFixed(0)} MiB`).join(", ");
  console.log(`\nA flight over ${places} places: in its thirds, the browser and the server took at the most ${text}.`);
}

if (missing() || packages.length === 0) {
  console.error(missing() ?? "benchmark/page.mjs: name packages");
  process.exit(2);
}
const browser = await openBrowser();
console.log("| package | first picture, s | click, ms | fisheye, ms |\n|---|---|---|---|");
for (const packageFolder of packages) {
  const start = starterOf({ program, packageFolder }), pictures = [];
  for (let n = 0; n < Number(options.turns); ++n) pictures.push(await firstPicture(browser, start));
  const server = await start(), { at, hemisphere } = await withPage(browser, server.url, (page) => questions(page, Number(options.clicks)));
  await server.stop();
  const both = (durations) => durations.length === 0 ? "–" : `${median(durations).toFixed(1)} (at the most ${greatest(durations).toFixed(0)})`;
  console.log(`| ${basename(packageFolder)} | ${median(pictures).toFixed(2)} | ${both(at)} | ${both(hemisphere)} |`);
  if (Number(options.flight) > 0) await flight(browser, start, Number(options.flight));
}
await browser.close();
