// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
//
// The file of `farlod-view PACKAGE --export town.html`, opened from the disk.
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { atRest, chooseMiddle, opened, ready, scratch, state, until } from "./browser.mjs";
import { expect, expectEqual } from "./checks.mjs";
import { expectColoursOfRamp } from "./look_tests.mjs";

/** Opens the file, and collects what goes wrong and what else is asked for. */
async function openFile(context, address, hash) {
  const page = await context.newPage(), wrong = [];
  page.on("console", (message) => { if (message.type() === "error") wrong.push(message.text()); });
  page.on("pageerror", (error) => wrong.push(error.message));
  page.on("request", (request) => { if (request.url().split("#")[0] !== address && !/^(data|blob):/.test(request.url())) wrong.push(request.url()); });
  return { page: await opened(context, address + hash, page), wrong };
}

export const onePageTests = (program, packageFolder) => ({
  async "one page shows the city from the disk, and asks no host"({ url, context }) {
    // A name with letters that an address has to escape
    const { folder, remove } = scratch(), file = join(folder, "a town #1 – ü.html");
    execFileSync(program, [packageFolder, "--export", file, "--quiet"]);
    const { origin_m, colours, nodata_colour, counts } = await (await fetch(`${url}view.json`)).json();
    // Whatever the page asks for, nobody answers
    await context.setOffline(true);
    const { page, wrong } = await openFile(context, pathToFileURL(file).href, `#camera=${origin_m.join(",")},400,0,30`);
    const { visibleTiles, drawnCrowns } = await state(page);
    expect(visibleTiles > 0, "no tile is drawn");
    expect(counts.crowns > 0 && drawnCrowns > counts.crowns, `${drawnCrowns} columns of ${counts.crowns} crowns are drawn`);
    // Crowns have no colours of the ramp
    await page.click("#layer-trees");
    await atRest(page);
    await expectColoursOfRamp(page, colours, nodata_colour);
    await chooseMiddle(page);
    const { picked } = await until(page, "the place", (now) => now.picked !== null);
    expectEqual(await page.textContent("#value"), picked.svf === null ? "no data" : picked.svf.toFixed(3), "the value of the facet");
    expect(await page.isHidden("#sky") && (await page.isHidden("#banner")), "something is offered that nobody can answer");
    // The address holds the view, on the disk, too
    await page.waitForFunction(() => location.hash.includes("place="));
    await page.reload();
    await ready(page);
    await until(page, "the place of the link", (now) => now.picked !== null && now.picked.building === picked.building);
    expectEqual(wrong, [], "errors, and what was asked for besides the file");
    remove();
  },
});
