// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
//
// What the page says when something is wrong. Damaged and exported packages are the mock's.
import { atRest, chooseMiddle, opened, ready, state, until } from "./browser.mjs";
import { expect, expectEqual } from "./checks.mjs";
import { startMock } from "./mock_server.mjs";

const banner = async (page) => {
  await page.waitForSelector("#banner:not([hidden])");
  return page.textContent("#banner-text");
};

export const failureTests = {
  async "a stopped server is told, and tried again"({ start, context }) {
    const server = await start(), page = await opened(context, server.url);
    await server.stop();
    await chooseMiddle(page);
    expect((await banner(page)).startsWith("The server does not answer; start farlod-view again."), "the banner says something else");
    await Promise.all([page.waitForEvent("requestfailed"), page.click("#retry")]);
    await banner(page);
    const again = await start(Number(new URL(server.url).port));
    await page.click("#retry");
    await page.waitForSelector("#banner", { state: "hidden" });
    await until(page, "the answer", ({ answer }) => answer !== null);
    await again.stop();
  },

  async "a server that stops while tiles come is told"({ start, context }) {
    const server = await start(), page = await context.newPage();
    await page.route("**/*.glb", (route) => route.abort());
    await page.goto(server.url);
    expect((await banner(page)).startsWith("The server does not answer"), "the banner says something else");
    await page.unroute("**/*.glb");
    await page.click("#retry");
    await ready(page);
    await server.stop();
  },

  async "a damaged package is told in the server's words"({ context }) {
    const server = await startMock({ damaged: true }), page = await context.newPage();
    await page.goto(server.url);
    expectEqual(await banner(page), "The package boxes.farlod is damaged: index.bin has a wrong checksum.", "the banner");
    await server.stop();
  },

  async "exported files show the values of facets"({ context }) {
    const server = await startMock({ canAnswer: false }), page = await opened(context, server.url);
    await chooseMiddle(page);
    const { picked } = await until(page, "the place", (now) => now.picked !== null);
    expectEqual(await page.textContent("#value"), picked.svf.toFixed(3), "the value");
    expect(await page.isHidden("#sky") && (await page.isHidden("#ask-cell")) && (await page.isHidden("#banner")), "something is offered that nobody can answer");
    await page.click("#layer-grid");
    await atRest(page);
    expectEqual(["at", "hemisphere", "cell"].filter((path) => server.counts[path]), [], "what was asked for");
    await server.stop();
  },

  async "a browser without WebGL is told"({ url, context }) {
    const page = await context.newPage();
    await page.addInitScript(() => {
      const original = HTMLCanvasElement.prototype.getContext;
      HTMLCanvasElement.prototype.getContext = function (kind, ...rest) { return kind.startsWith("webgl") ? null : original.call(this, kind, ...rest); };
    });
    await page.goto(url);
    expect((await banner(page)).includes("WebGL"), "the banner says something else");
    expect(await page.isHidden("#retry"), "there is nothing to try again");
  },

  async "a place without an answer is told"({ url, context }) {
    const page = await context.newPage();
    await page.route("**/at?*", (route) => route.fulfill({ json: { svf: null, text: null, low: null, high: null, x_m: 0, y_m: 0, z_m: 0, cell: null, seconds: 0.001 } }));
    await page.route("**/hemisphere?*", (route) => route.fulfill({ status: 204 }));
    await opened(context, url, page);
    await chooseMiddle(page);
    await until(page, "the answer", ({ answer }) => answer === "no data");
    await page.waitForFunction(() => document.getElementById("fisheye").getAttribute("aria-label").includes("no data"));
    expectEqual(await page.textContent("#value"), "no data", "the value");
    expect((await page.textContent("#value-note")).includes("no answer"), "the reason is not told");
    expectEqual(await page.getAttribute("#fisheye", "aria-label"), "Fisheye: no data", "the fisheye");
    expect((await state(page)).skyIsDrawn === false, "a sky is drawn");
  },

  async "a refusal is told where the value would be"({ url, context }) {
    const page = await context.newPage();
    await page.route("**/at?*", (route) => route.fulfill({ status: 500, json: { error: "The tile of the cell 3, 4 is damaged." } }));
    await opened(context, url, page);
    await chooseMiddle(page);
    await page.waitForFunction(() => document.getElementById("value-note").textContent.length > 0);
    expectEqual(await page.textContent("#value-note"), "The tile of the cell 3, 4 is damaged.", "the note");
    expectEqual(await page.textContent("#value"), "–", "the value");
  },
};
