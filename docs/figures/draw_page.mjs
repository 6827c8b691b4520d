// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
//
// Draws the pictures of farlod-view: docs/figures/demo_view.png and demo_compare.png. scripts/figures calls it.
//
//   node docs/figures/draw_page.mjs FARLOD_VIEW PACKAGE EAST,NORTH RASTER RASTER
import { fileURLToPath } from "node:url";
import { atRest, openBrowser, ready, until } from "../../tests/viewer/browser.mjs";
import { starterOf } from "../../tests/viewer/servers.mjs";

const [program, packageFolder, place, ...rasters] = process.argv.slice(2), size = { width: 1200, height: 720 };
const file = (name) => fileURLToPath(new URL(name, import.meta.url));

/** The page at a view, after something was done in it. */
async function draw(browser, url, fields, name, act) {
  const page = await (await browser.newContext({ viewport: size })).newPage();
  await page.goto(`${url}#${fields}`);
  await ready(page);
  await atRest(page);
  await act(page);
  await atRest(page);
  await page.screenshot({ path: file(name) });
}

const browser = await openBrowser(), server = await starterOf({ program, packageFolder, results: rasters })();
const camera = `camera=${place},0,420,20,55&theme=light`;
await draw(browser, server.url, camera, "demo_view.png", async (page) => {
  await page.mouse.click(size.width / 2, size.height / 2);
  await until(page, "the answer", ({ answer, skyIsDrawn }) => answer !== null && skyIsDrawn);
});
await draw(browser, server.url, `${camera}&ground=0&dots=&compared=1&comparison=difference`, "demo_compare.png", async () => undefined);
await browser.close();
await server.stop();
