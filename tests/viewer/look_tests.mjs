// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
//
// What is seen when the page opens.
import { readFileSync, writeFileSync } from "node:fs";
import { atRest, decoded, differing, opened, pixels, ready, seen, share, state } from "./browser.mjs";
import { expect, expectEqual } from "./checks.mjs";
import { startMock } from "./mock_server.mjs";
import { sizeOfGrove } from "./mock_town.mjs";

/** The city, without the cards at its sides. */
const city = { x: 260, y: 120, width: 480, height: 460 };

/** Of a pixel, its distance to the nearest colour of the ramp, dimmed as the shading does. */
function distanceToRamp(colours, red, green, blue) {
  let least = Infinity;
  for (let dim = 0.7; dim <= 1.001; dim += 0.05)
    for (const [r, g, b] of colours) least = Math.min(least, Math.abs(red - r * dim) + Math.abs(green - g * dim) + Math.abs(blue - b * dim));
  return least;
}

/** The city in the middle of the window is drawn in colours of the ramp, and in several of them. */
export async function expectColoursOfRamp(page, colours, nodata_colour) {
  const picture = await pixels(page, city), few = colours.filter((_, n) => n % 8 === 0), surround = [228, 232, 235];
  const isSurround = (r, g, b) => Math.abs(r - surround[0]) + Math.abs(g - surround[1]) + Math.abs(b - surround[2]) < 6;
  const near = (r, g, b) => !isSurround(r, g, b) && distanceToRamp([...few, nodata_colour], r, g, b) < 24;
  const drawn = 1 - share(picture, isSurround), coloured = share(picture, near) / drawn;
  expect(drawn > 0.4, `the city fills ${(100 * drawn).toFixed(1)} % of the middle of the window`);
  expect(coloured > 0.9, `${(100 * coloured).toFixed(1)} % of the city's pixels have colours of the ramp`);
  const kinds = new Set();
  share(picture, (r, g, b) => kinds.add((r >> 5) * 64 + (g >> 5) * 8 + (b >> 5)));
  expect(kinds.size >= 6, `the city has ${kinds.size} colours`);
}

export const lookTests = {
  async "opens without errors, and asks no other host"({ url, context }) {
    const page = await context.newPage(), wrong = [];
    page.on("console", (message) => { if (message.type() === "error") wrong.push(message.text()); });
    page.on("pageerror", (error) => wrong.push(error.message));
    page.on("request", (request) => { if (!request.url().startsWith(url) && !request.url().startsWith("data:")) wrong.push(request.url()); });
    await opened(context, url, page);
    expectEqual(wrong, [], "errors and foreign addresses");
  },

  async "says when the first complete frame was drawn"({ url, context }) {
    const page = await context.newPage();
    await page.goto(url);
    await ready(page);
    const { readyAt_ms, visibleTiles } = await state(page), now_ms = await page.evaluate(() => performance.now());
    expect(visibleTiles > 0 && readyAt_ms > 0 && readyAt_ms <= now_ms, `ready at ${readyAt_ms} ms of ${now_ms} ms with ${visibleTiles} tiles`);
    expect((await atRest(page)).loaded, "tiles are still missing at rest");
  },

  async "is coloured by the ramp"({ url, context }) {
    const { colours, nodata_colour, origin_m } = await (await fetch(`${url}view.json`)).json();
    // So near that few pixels are of two facets
    const page = await opened(context, `${url}#camera=${origin_m.join(",")},400,0,30`);
    await expectColoursOfRamp(page, colours, nodata_colour);
  },

  async "looks as the picture that was looked at"({ url, context, isMock, writesPictures }) {
    // The town of farlod-view depends on the machine's arithmetic; the mock's does not
    if (!isMock) return;
    const file = new URL("pictures/boxes.png", import.meta.url), { origin_m } = await (await fetch(`${url}view.json`)).json();
    const page = await opened(context, `${url}#camera=${origin_m.join(",")},700,30,50`);
    if (writesPictures) writeFileSync(file, await page.screenshot({ clip: city }));
    const differ = differing(await pixels(page, city), await decoded(page, readFileSync(file)));
    expect(differ < 0.01, `${(100 * differ).toFixed(2)} % of the pixels differ from tests/viewer/pictures/boxes.png`);
  },

  async "tells the package, and has a legend and a scale"({ url, context }) {
    const page = await context.newPage();
    await page.goto(url);
    await ready(page);
    const view = await page.evaluate(async () => (await fetch("view.json")).json());
    expectEqual(await page.textContent("h1"), view.name.replace(/\.farlod$/, ""), "the heading");
    await page.click("summary");
    const facts = await page.textContent("#package-facts");
    expect(facts.includes(view.crs) && facts.includes(view.counts.buildings.toLocaleString("en-GB")), `the facts are ${facts}`);
    const [left, right] = await page.evaluate(() => {
      const ramp = document.getElementById("ramp"), context = ramp.getContext("2d");
      return [0, ramp.width - 1].map((x) => [...context.getImageData(x, 0, 1, 1).data].slice(0, 3));
    });
    expectEqual([left, right], [view.colours[0], view.colours[255]], "the ends of the legend");
    expect(/^\d+ k?m$/.test(await page.textContent("#scale-text")), "the scale bar has no length");
  },

  async "is dark where the system is, until it is switched"({ url, browser }) {
    const context = await browser.newContext({ viewport: { width: 1000, height: 700 }, colorScheme: "dark" });
    const page = await opened(context, url);
    const corner = { x: 500, y: 5, width: 60, height: 40 }, isDark = (r, g, b) => r + g + b < 120;
    expect(share(await pixels(page, corner), isDark) === 1, "the surround are not dark");
    await page.click("#theme");
    await atRest(page);
    expect(share(await pixels(page, corner), isDark) === 0, "the surround stay dark");
    expectEqual(await page.getAttribute("html", "data-theme"), "light", "the theme");
    await context.close();
  },

  async "draws crowns of trees, and hides them by T and by a link"({ url, context }) {
    const isGreen = (r, g, b) => g > r + 12 && g > b + 25 && r + g + b < 330, green = async (page) => share(await pixels(page, city), isGreen);
    const page = await opened(context, url), { drawnCrowns } = await state(page), withCrowns = await green(page);
    expectEqual(drawnCrowns, sizeOfGrove, "columns of crowns");
    await page.focus("#city");
    await page.keyboard.press("t");
    expectEqual([(await atRest(page)).drawnCrowns, await page.isChecked("#layer-trees")], [0, false], "what T leaves of the crowns");
    const without = await green(page);
    expect(withCrowns > without + 0.001, `crowns make ${(100 * (withCrowns - without)).toFixed(2)} % of the picture green`);
    // A link of a time when no crowns were drawn shows what it showed
    const old = await opened(context, `${url}#layers=ground,roofs,facades`);
    expectEqual((await state(old)).drawnCrowns, 0, "columns of crowns of an old link");
    await old.click("#layer-trees");
    expectEqual((await atRest(old)).drawnCrowns, sizeOfGrove, "columns of crowns after a click");
  },

  async "has no layer of trees where there are none"({ context }) {
    const server = await startMock({ hasTrees: false }), page = await opened(context, server.url);
    expect(await page.isHidden("#layer-trees"), "a box switches nothing");
    await page.focus("#city");
    await page.keyboard.press("t");
    await atRest(page);
    expect(!page.url().includes("trees") && server.counts["crowns"] === undefined, "trees are in the link, or were asked for");
    await server.stop();
  },

  async "shows and hides layers"({ url, context }) {
    const page = await opened(context, url);
    const whole = await pixels(page, city), change = async () => differing(whole, await pixels(page, city));
    for (const layer of ["ground", "roofs", "facades", "grid", "trees"]) {
      await page.click(`#layer-${layer}`);
      const changed = await seen(change, (now) => now > 0.002);
      expect(changed > 0.002, `the layer ${layer} changes ${(100 * changed).toFixed(2)} % of the picture`);
      await page.click(`#layer-${layer}`);
      const left = await seen(change, (now) => now < 0.001);
      expect(left < 0.001, `the layer ${layer} does not come back as it was: ${(100 * left).toFixed(2)} % differ`);
    }
  },
};
