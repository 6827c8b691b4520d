// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
//
// Results beside the package: with the mock, whose results are known; farlod-view is given the results of the town by its runner.
import { atRest, linkWith, opened, pixels, seen, share, state, until } from "./browser.mjs";
import { expect, expectEqual } from "./checks.mjs";
import { grid, localOfGrid, wallOfGround } from "./mock_town.mjs";

const colourOf = async (url, value) => (await (await fetch(`${url}view.json`)).json()).colours[Math.round(255 * value)];
const near = ([r0, g0, b0]) => (r, g, b) => Math.abs(r - r0) + Math.abs(g - g0) + Math.abs(b - b0) < 12;
/** Left and right of the window's middle, beside the cards. */
const [west, east] = [{ x: 290, y: 150, width: 190, height: 400 }, { x: 520, y: 150, width: 190, height: 400 }];

/** Straight above the origin of the town, with the ground alone, or with other layers. */
async function above(context, url, fields, layers = "ground") {
  const { origin_m } = await (await fetch(`${url}view.json`)).json();
  return opened(context, `${url}#camera=${origin_m.join(",")},500,0,0&layers=${layers}&${fields}`);
}

async function expectGround(page, clip, colour, what) {
  const part = await covered(page, clip, colour);
  expect(part > 0.5, `${what} cover ${(100 * part).toFixed(1)} % of the ground`);
}

const covered = async (page, clip, colour) => share(await pixels(page, clip), near(colour));
const ticksOf = (page) => page.$$eval("#ticks span", (spans) => spans.map((span) => span.textContent));

async function clickAt(page, place) {
  await page.mouse.click(...place);
  await until(page, "the answer", ({ picked, resting }) => picked !== null && resting);
}

/** What results say of the first roof that a click finds, north-west of the origin. */
async function roofIn(page) {
  for (let n = 0; n < 12; ++n) {
    await page.mouse.click(330 + 23 * (n % 4), 250 + 31 * Math.floor(n / 4));
    const { picked } = await atRest(page);
    if (picked?.kind === "roof") return factsOf(page);
  }
  return [];
}

const factsOf = (page) => page.$$eval("#result-facts dt, #result-facts dd", (parts) => parts.map((part) => part.textContent));

export const resultTests = {
  async "a raster lies on the ground, in its colours"({ url, context }) {
    const page = await above(context, url, "ground=0&dots=");
    await expectGround(page, west, await colourOf(url, 0.25), "the western values");
    await expectGround(page, east, await colourOf(url, 0.75), "the eastern values");
    expectEqual(await page.textContent("#ramp-title"), "summer.tif: svf", "the title of the legend");
    await page.selectOption("#ground-values", "2");
    await atRest(page);
    await expectGround(page, west, [190, 190, 190], "pixels without data");
    expect(await page.isVisible("#nodata"), "the legend does not name what has no data");
    await page.selectOption("#ground-values", "-1");
    await atRest(page);
    expect(!(await page.isVisible("#nodata")), "the legend names no data where all that is seen has some");
    expect(share(await pixels(page, west), near([190, 190, 190])) < 0.1, "the computed values did not come back");
  },

  async "a raster does not run down the walls of a surface model"({ url, context }) {
    const { origin_m } = await (await fetch(`${url}view.json`)).json(), [x, y] = localOfGrid(75, wallOfGround[0][1]);
    const camera = [origin_m[0] + x, origin_m[1] + y, origin_m[2] + 10, 60, grid.bearing_deg, 85].join(",");
    const page = await opened(context, `${url}#camera=${camera}&layers=ground&ground=0&dots=`);
    const isGrey = (r, g, b) => Math.max(r, g, b) - Math.min(r, g, b) < 6 && r > 100 && r <= 192;
    const grey = share(await pixels(page, { x: 440, y: 320, width: 120, height: 60 }), isGrey);
    expect(grey > 0.95, `${(100 * grey).toFixed(1)} % of the wall have the colour of no data`);
    await clickAt(page, [500, 350]);
    expectEqual((await factsOf(page)).at(1), "no data", "what is told of the wall");
  },

  async "two rasters are compared by their difference"({ url, context }) {
    const page = await above(context, url, "ground=0&dots=");
    await page.selectOption("#compared", "1");
    await page.selectOption("#comparison", "difference");
    await atRest(page);
    // All differences are .25, for which a scale to .5 is the least of 1, 2 and 5
    expectEqual(await ticksOf(page), ["−.5", "−.25", "0", ".25", ".5"], "the ticks");
    await expectGround(page, west, [103, 169, 207], "differences of −.25");
    await expectGround(page, east, [239, 138, 98], "differences of .25");
    await clickAt(page, [330, 350]);
    expectEqual(await factsOf(page), ["summer.tif: svf", "0.2500", "winter.tif: svf", "0.5000", "Difference", "-0.2500"], "what is told");
  },

  async "two rasters are compared side by side"({ url, context }) {
    const page = await above(context, url, "ground=0&dots=&compared=1&comparison=divider&divider=0.5");
    await expectGround(page, west, await colourOf(url, 0.25), "the first values, left of the divider,");
    await expectGround(page, east, await colourOf(url, 0.5), "the second values, right of it,");
    await page.focus("#divider");
    for (let n = 0; n < 4; ++n) await page.keyboard.press("Shift+ArrowRight");
    await atRest(page);
    await expectGround(page, east, await colourOf(url, 0.75), "the first values, after the divider was moved by keys,");
    const box = await page.locator("#divider").boundingBox(), x = box.x + box.width / 2;
    await page.mouse.move(x, 300);
    await page.mouse.down();
    await page.mouse.move(250, 300, { steps: 4 });
    await page.mouse.up();
    await atRest(page);
    await expectGround(page, west, await colourOf(url, 0.5), "the second values, after the divider was dragged,");
  },

  async "both sides of a divider have the colours of one legend"({ url, context }) {
    const page = await above(context, url, "ground=0&dots=&compared=5&comparison=divider&divider=0.5");
    expectEqual(await ticksOf(page), ["0", "2", "4", "6", "8", "10"], "the ticks");
    await expectGround(page, west, await colourOf(url, 0.025), "0.25 of 10, left of the divider,");
    await expectGround(page, east, await colourOf(url, 0.75), "7.5 of 10, right of it,");
  },

  async "a table colours the surfaces of buildings"({ url, context }) {
    const page = await above(context, url, "buildings=6&dots=", "roofs");
    expect((await covered(page, west, await colourOf(url, 0.875))) > 0.3, "the roofs have other colours than their values");
    expectEqual(await page.textContent("#ramp-title"), "before.surfaces.csv: svf_mean", "the title of the legend");
    await page.selectOption("#building-values", "9");
    await atRest(page);
    expect((await covered(page, west, await colourOf(url, 0.375))) > 0.1, "the roofs did not change");
    expect((await covered(page, west, [190, 190, 190])) > 0.1, "roofs that the table lacks have a colour");
    await page.selectOption("#building-values", "-1");
    await atRest(page);
    expect((await covered(page, west, await colourOf(url, 0.375))) < 0.1, "the computed values did not come back");
  },

  async "tables are compared, and told at a click"({ url, context }) {
    const page = await above(context, url, "buildings=6&buildings-compared=7&comparison=divider&divider=0.5&dots=", "roofs");
    expect((await covered(page, west, await colourOf(url, 0.875))) > 0.3, "the first table is not left of the divider");
    expect((await covered(page, east, await colourOf(url, 0.875))) < 0.05, "the first table is right of the divider, too");
    await page.selectOption("#comparison", "difference");
    await atRest(page);
    expectEqual(await page.textContent("#ramp-title"), "before.surfaces.csv: svf_mean less after.surfaces.csv: svf_mean", "the title");
    expect((await covered(page, west, [178, 24, 43])) > 0.3, "roofs that differ by .5 are not at the end of the scale");
    const roof = await seen(() => roofIn(page), (facts) => facts.length > 0);
    expectEqual(roof, ["before.surfaces.csv: svf_mean", "0.8750", "after.surfaces.csv: svf_mean", "0.3750", "Difference", "0.5000"], "what is told");
    const again = await opened(context, await linkWith(page, "buildings-compared=7&comparison=difference"));
    expectEqual(await Promise.all(["#building-values", "#buildings-compared", "#comparison"].map((id) => again.inputValue(id))), ["6", "7", "difference"], "the lists");
  },

  async "other quantities have the legend, and what they do not colour is paper"({ url, context }) {
    const page = await above(context, url, "ground=computed&buildings=8&dots=", "ground,roofs");
    expectEqual(await ticksOf(page), ["0", "2", "4", "6", "8", "10"], "the ticks");
    expect((await covered(page, west, await colourOf(url, 0.5))) > 0.2, "5 of 10 is not in the middle of the colours");
    expect((await covered(page, west, [222, 222, 217])) > 0.2, "the ground keeps colours that the legend does not have");
    await page.selectOption("#ground-values", "5");
    await atRest(page);
    expect((await covered(page, west, await colourOf(url, 0.25))) > 0.2, "hours on the ground are paper beside hours on roofs");
  },

  async "irradiation has its unit in the legend and beside its values"({ url, context }) {
    const page = await above(context, url, "ground=computed&buildings=10&dots=", "roofs");
    expectEqual(await page.textContent("#ramp-title"), "year.surfaces.csv: irradiation_mean, kWh/m²", "the title of the legend");
    expectEqual(await ticksOf(page), ["0", "200", "400", "600", "800", "1000", "1200"], "the ticks");
    expect((await covered(page, west, await colourOf(url, 0.5))) > 0.2, "625 of 1,250 is not in the middle of the colours");
    const roof = await seen(() => roofIn(page), (facts) => facts.length > 0);
    expectEqual(roof, ["year.surfaces.csv: irradiation_mean", "625 kWh/m²"], "what is told");
  },

  async "points and problems are marked, and told when they are clicked at"({ url, context }) {
    const page = await above(context, url, "ground=computed&dots=3,4"), size = page.viewportSize();
    expectEqual(await page.isChecked("#result-3"), true, "the box of the points");
    const perMetre = size.height / (2 * Math.tan((20 * Math.PI) / 180) * 500), middle = [size.width / 2, size.height / 2];
    await clickAt(page, [middle[0], middle[1] - 40 * perMetre]);
    await page.waitForSelector("#result-facts dt");
    expectEqual(await factsOf(page), ["posts.csv: svf, north post", "0.1250"], "the point");
    await clickAt(page, [middle[0] - 60 * perMetre, middle[1]]);
    await page.waitForFunction(() => document.querySelector("#result-facts")?.textContent.includes("107"));
    expectEqual((await factsOf(page))[1], "107 zero_area, left out: b-3-3-1. All points lie on a line.", "the problem");
    const mark = { x: middle[0] - 60 * perMetre - 6, y: middle[1] - 6, width: 12, height: 12 };
    await page.keyboard.press("Escape");
    await atRest(page);
    const isMark = near([217, 28, 97]);
    expect(share(await pixels(page, mark), isMark) > 0.2, "the mark of the problem is not seen");
    await page.uncheck("#result-4");
    await atRest(page);
    expect(share(await pixels(page, mark), isMark) === 0, "the mark is still seen");
  },

  async "a link holds what is shown and compared"({ url, context }) {
    const page = await above(context, url, "ground=0&dots=4&compared=1&comparison=divider&divider=0.3");
    const again = await opened(context, await linkWith(page, "compared=1"));
    const chosen = await Promise.all(["#ground-values", "#compared", "#comparison"].map((id) => again.inputValue(id)));
    expectEqual(chosen, ["0", "1", "divider"], "the lists");
    expectEqual([await again.isChecked("#result-3"), await again.isChecked("#result-4")], [false, true], "the boxes");
    expectEqual(await again.getAttribute("#divider", "aria-valuenow"), "30", "the divider");
    expect((await state(again)).loaded, "tiles are missing");
  },
};
