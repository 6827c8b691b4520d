// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
//
// Clicks on the city: values, fisheyes, cells.
import { differing, pixels, ready, atRest, seen, share, state, until } from "./browser.mjs";
import { expect, expectEqual, expectNear } from "./checks.mjs";

/** Places of the window to click at, from its middle outwards. */
const places = [];
for (let ring = 0; ring < 9; ++ring) for (let n = 0; n < 8; ++n)
  places.push([400 + 14 * ring * Math.cos((n * Math.PI) / 4), 360 + 12 * ring * Math.sin((n * Math.PI) / 4)]);

/** Where to look for a place, in metres from the origin: a square or a large roof may fill one view. */
const otherPlaces = [[0, 0], [260, -200], [-300, 120], [150, 400], [-200, -420]];

/** A click at some place of the kind, where nothing is simplified and there is an answer; null where the view has none. */
async function clickOn(page, kind, asked) {
  for (const [x, y] of places) {
    asked.length = 0;
    await page.mouse.click(x, y);
    const { picked } = await state(page);
    if (picked?.kind !== kind || picked.isSimplified) continue;
    const now = await until(page, "the answer", ({ answer, resting }) => answer !== null && resting);
    if (now.answer !== "no data") return now;
  }
  return null;
}

/** The page with a place of this kind chosen, and the questions that it asked for it. */
async function choose(context, url, kind) {
  const page = await context.newPage(), asked = [], { origin_m: [east, north, height] } = await (await fetch(`${url}view.json`)).json();
  page.on("request", (request) => { if (/\/(at|hemisphere|cell)\?/.test(request.url())) asked.push(request.url()); });
  await page.goto(`${url}#camera=${east},${north},${height},160,0,40`);
  await ready(page);
  for (const [dx, dy] of otherPlaces) {
    await page.evaluate((hash) => { location.hash = hash; }, `camera=${east + dx},${north + dy},${height},160,0,40`);
    await atRest(page);
    const now = await clickOn(page, kind, asked);
    if (now) return { page, now, asked };
  }
  throw new Error(`found no place of the kind ${kind}`);
}

/** The last question of a kind: earlier ones may be of places that were clicked at before. */
const lastOf = (asked, path) => new URL(asked.filter((address) => address.includes(`/${path}?`)).pop());

const answerTo = async (address) => (await fetch(address)).json();

async function expectAnswerShown(page, asked) {
  const answer = await answerTo(lastOf(asked, "at"));
  expectEqual(await page.textContent("#value"), answer.text, "the value shown");
  const bounds = await page.textContent("#bounds");
  const digits = answer.text.split(".")[1].length, unit = 10 ** -digits;
  const [least, most] = bounds.startsWith("between ") ? bounds.slice("between ".length).split(" and ").map(Number) : [NaN, NaN];
  const isCertain = answer.low.toFixed(digits) === answer.high.toFixed(digits), slack = 1e-9;
  expectEqual(bounds === "certain to the last digit", isCertain, "the bounds shown");
  const holds = least <= answer.low + slack && answer.low < least + unit + slack && most >= answer.high - slack && answer.high > most - unit - slack;
  expectEqual(holds, !isCertain, "the bounds shown hold the answer's");
  return answer;
}

/** In the page: how many questions are under way, from their start until their answer is read. */
function countQuestions() {
  const questions = { open: 0, most: 0 }, original = window.fetch;
  window.questions = questions;
  window.fetch = async (address, options) => {
    if (!/^(at|hemisphere)\?/.test(String(address))) return original(address, options);
    questions.most = Math.max(questions.most, ++questions.open);
    const response = await original(address, options), bytes = await response.arrayBuffer();
    // So slow that the pointer moves on meanwhile
    await new Promise((resolve) => setTimeout(resolve, 150));
    --questions.open;
    return new Response(response.status === 204 ? null : bytes, { status: response.status });
  };
}

export const placeTests = {
  async "a click on the ground gives the value of `at`"({ url, context }) {
    const { page, now, asked } = await choose(context, url, "ground");
    const query = lastOf(asked, "at").searchParams;
    expectEqual([...query.keys()], ["x", "y"], "what is asked for the ground");
    expectNear(Number(query.get("x")), now.picked.projected_m[0], 1e-3, "x");
    expectNear(Number(query.get("y")), now.picked.projected_m[1], 1e-3, "y");
    await expectAnswerShown(page, asked);
    expectEqual(await page.textContent("#place-title"), "Ground", "the title");
  },

  async "a click on a façade asks in front of it, along its normal"({ url, context }) {
    const { page, now, asked } = await choose(context, url, "wall");
    const query = lastOf(asked, "at").searchParams, [x, y, z] = now.picked.projected_m, read = (name) => Number(query.get(name));
    const away = [read("x") - x, read("y") - y, read("z") - z], { convergence_deg } = (await answerTo(`${url}view.json`)).grid;
    expectNear(Math.hypot(...away), 0.01, 2e-4, "the distance to the façade");
    const azimuth_deg = (Math.atan2(away[0], away[1]) * 180) / Math.PI + convergence_deg;
    // Coordinates are asked for in tenths of a millimetre
    expectNear(((azimuth_deg - read("azimuth") + 540) % 360) - 180, 0, 2, "the azimuth");
    expectNear(read("tilt"), 90, 0.5, "the tilt");
    await expectAnswerShown(page, asked);
    expectEqual(await page.textContent("#place-title"), now.picked.building, "the title");
    const facts = await page.textContent("#place-facts");
    expect(facts.includes("façade") && facts.includes(z.toFixed(2)), `the facts are ${facts}`);
  },

  async "a click on a roof gives the value of `at`"({ url, context }) {
    const { page, asked } = await choose(context, url, "roof");
    expect(Number(lastOf(asked, "at").searchParams.get("tilt")) < 80, "the roof is upright");
    await expectAnswerShown(page, asked);
  },

  async "the fisheye is drawn as the hemisphere has it"({ url, context }) {
    const { page, asked } = await choose(context, url, "ground");
    const bytes = new Uint8Array(await (await fetch(lastOf(asked, "hemisphere"))).arrayBuffer());
    const colours = [[205, 229, 248], [66, 66, 76], [230, 159, 0], [0, 140, 100]];
    // Half-way to the horizon of an orthographic disk of 282 pixels: sin z = .5; east is on the left
    const found = await page.evaluate(() => {
      const canvas = document.getElementById("fisheye"), context = canvas.getContext("2d"), scale = canvas.width / 316;
      return Array.from({ length: 72 }, (_, n) => {
        const a = (n * 5 + 2.6) * Math.PI / 180;
        return [...context.getImageData(Math.floor((158 - 0.95 * 141 * Math.sin(a)) * scale), Math.floor((158 - 0.95 * 141 * Math.cos(a)) * scale), 1, 1).data].slice(0, 3);
      });
    });
    const elevation = Math.floor((Math.acos(0.95) * 180) / Math.PI * 4);
    const wrong = found.filter((colour, n) => {
      const part = bytes[Math.floor((n * 5 + 2.6) * 4) * 360 + elevation];
      return colours[part].some((c, k) => Math.abs(c - colour[k]) > 3);
    });
    // Rings and the horizon's line cover some places
    expect(wrong.length <= 14, `${wrong.length} of 72 directions have another colour`);
    // The label of 30° stands to the right of a place in the north-east, dark in a white halo, whatever lies below it
    const tones = await page.evaluate(() => {
      const canvas = document.getElementById("fisheye"), scale = canvas.width / 316, r = 141 * Math.cos(Math.PI / 6) * Math.SQRT1_2;
      const { data } = canvas.getContext("2d").getImageData((158 - r + 2) * scale, (158 - r - 10) * scale, 22 * scale, 14 * scale);
      const of = (isTone) => data.filter((_, n) => n % 4 === 0 && isTone(data[n], data[n + 1], data[n + 2])).length / (data.length / 4);
      return { halo: of((...c) => Math.min(...c) > 250), ink: of((...c) => Math.max(...c) < 60) };
    });
    expect(tones.halo > 0.1 && tones.ink > 0.02, `of the label, ${JSON.stringify(tones)} are halo and ink`);
    const label = await page.getAttribute("#fisheye", "aria-label"), shares = [...label.matchAll(/([\d.]+) %/g)].map((m) => Number(m[1]));
    expectNear(shares.reduce((sum, s) => sum + s, 0), 100, 0.3, `the sum of the shares (${label})`);
    const before = await page.evaluate(() => document.getElementById("fisheye").toDataURL());
    await page.selectOption("#projection", "equidistant");
    expect((await page.evaluate(() => document.getElementById("fisheye").toDataURL())) !== before, "the projection changes nothing");
  },

  async "a drag moves the place, with one question at a time"({ url, context }) {
    await context.addInitScript(countQuestions);
    const { page, now, asked } = await choose(context, url, "ground");
    await page.evaluate(() => { window.questions.most = 0; });
    const box = await page.locator("#marker").boundingBox(), x = box.x + box.width / 2, y = box.y + box.height / 2;
    await page.mouse.move(x, y);
    await page.mouse.down();
    // Westwards: in the east, the town of farlod-view may end
    for (let n = 1; n <= 30; ++n) await page.mouse.move(x - 3 * n, y + n);
    await page.mouse.up();
    const from = now.picked.projected_m, distance = ({ projected_m: to }) => Math.hypot(to[0] - from[0], to[1] - from[1]);
    const moved = await until(page, "the answer at another place", ({ picked, answer, skyIsDrawn, resting }) =>
      distance(picked) > 5 && answer !== null && skyIsDrawn && resting);
    for (const axis of ["x", "y"]) expectNear(moved.camera.target_local[axis], now.camera.target_local[axis], 1e-3, `the camera's target, ${axis}`);
    expectEqual(await page.evaluate(() => window.questions.most), 1, "questions under way at once");
    const last = lastOf(asked, "at");
    expectEqual(await page.textContent("#value"), (await answerTo(last)).text, "the value shown");
    expectNear(Number(last.searchParams.get("x")), moved.picked.projected_m[0], 0.02, "x of the last question");
  },

  async "the grid shows a cell, its neighbourhood and its far map"({ url, context }) {
    const { page, now } = await choose(context, url, "ground"), clip = { x: 260, y: 120, width: 260, height: 460 };
    const before = await pixels(page, clip);
    await page.click("#ask-cell");
    await page.waitForSelector("#cell h2");
    await atRest(page);
    const { cell } = await state(page), facts = await answerTo(`${url}cell?i=${cell[0]}&j=${cell[1]}`), at = await answerTo(`${url}at?x=${now.picked.projected_m[0]}&y=${now.picked.projected_m[1]}`);
    expectEqual(cell, at.cell, "the cell of the place");
    expectEqual(await page.textContent("#cell h2"), `Cell ${cell[0]}, ${cell[1]}`, "the heading");
    const { i_begin, i_end, j_begin, j_end } = facts.neighborhood;
    expectEqual(await page.locator(".near-table td").count(), (i_end - i_begin) * (j_end - j_begin), "cells of the neighbourhood");
    expectEqual(await page.locator(".near-table td.middle").textContent(), facts.near_cells.find((near) => `${near.cell}` === `${cell}`).triangles.toLocaleString("en-GB"), "triangles of the cell");
    expect(differing(before, await pixels(page, clip)) > 0.01, "no lines were drawn");
    if (!facts.far) return;
    expect((await page.textContent("#cell")).includes(`${facts.explicit_edges.toLocaleString("en-GB")} explicit edges`), "the explicit edges are not told");
    const panorama = page.locator(".panorama");
    await panorama.scrollIntoViewIfNeeded();
    const picture = await pixels(page, await panorama.boundingBox()), is = (c) => (r, g, b) => Math.abs(r - c[0]) + Math.abs(g - c[1]) + Math.abs(b - c[2]) < 8;
    const sky = share(picture, is([205, 229, 248])), city = Math.max(...[[230, 159, 0], [250, 222, 160], [0, 84, 147], [102, 62, 0]].map((c) => share(picture, is(c))));
    expect(sky > 0.1 && city > 0.002, `${(100 * sky).toFixed(1)} % of the panorama are sky, and ${(100 * city).toFixed(1)} % far city`);
  },

  async "the pointer lights up the cell below it"({ url, context }) {
    const page = await context.newPage();
    await page.goto(url);
    await ready(page);
    await page.click("#layer-grid");
    await atRest(page);
    const clip = { x: 260, y: 120, width: 480, height: 460 }, isPink = (r, g, b) => r > 170 && g < 90 && b > 60 && b < 140;
    await page.mouse.move(5, 690);
    await atRest(page);
    const without = share(await pixels(page, clip), isPink);
    await page.mouse.move(420, 380);
    const lit = await seen(async () => share(await pixels(page, clip), isPink), (now) => now > without + 0.0005);
    expect(lit > without + 0.0005, `pink is ${(100 * without).toFixed(3)} % before and ${(100 * lit).toFixed(3)} % after`);
  },
};
