// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
//
// Debian's Chromium by playwright-core: a browser for the tests, and what they ask of its pages.
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";

const executablePath = process.env.FARLOD_CHROMIUM ?? "/usr/bin/chromium";
// Without a GPU; and no request to the web, which would only be refused
const flags = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run",
               "--disable-background-networking", "--disable-component-update", "--disable-sync"];

/** How long a test waits for what must come, on a machine that does other things: it is never told by this that the page is slow. */
export const longest_ms = 600000;

/** What is missing to run a browser, or null. */
export function missing() {
  if (!existsSync(executablePath)) return `${executablePath} was not found; run: apt-get install chromium`;
  const packages = new URL("../../viewer/node_modules/playwright-core", import.meta.url);
  return existsSync(packages) ? null : "viewer/node_modules was not found; run: scripts/viewer";
}

/** A browser with a profile of its own, which `close` deletes. */
export async function openBrowser() {
  const { chromium } = createRequire(new URL("../../viewer/package.json", import.meta.url))("playwright-core");
  const browser = await chromium.launch({ executablePath, headless: true, args: flags });
  const newContext = async (options) => {
    const context = await browser.newContext(options);
    context.setDefaultTimeout(longest_ms);
    return context;
  };
  return { newContext, close: () => browser.close() };
}

/** A folder below the system's own for what a test writes. */
export function scratch() {
  const folder = mkdtempSync(join(tmpdir(), "farlod-page-"));
  return { folder, remove: () => rmSync(folder, { recursive: true }) };
}

export const ready = (page) => page.waitForSelector("html[data-ready=true]");
export const state = (page) => page.evaluate(() => window.farlod.state());

/** Waits until a condition on the page's state holds; fails with what it is instead. */
export async function until(page, what, condition, timeout_ms = longest_ms) {
  const end = Date.now() + timeout_ms;
  for (;;) {
    const now = await state(page);
    if (condition(now)) return now;
    if (Date.now() > end) throw new Error(`${what} did not come; the page is at ${JSON.stringify(now)}`);
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

/** Until the camera stands still, all tiles are drawn and all answers are there; and the browser has shown what was drawn. */
export async function atRest(page) {
  const now = await until(page, "rest", ({ resting }) => resting);
  await page.evaluate(() => new Promise((shown) => requestAnimationFrame(() => requestAnimationFrame(shown))));
  return now;
}

/** A page of an address, or the one that is given, once it is at rest. */
export async function opened(context, address, page = null) {
  page ??= await context.newPage();
  await page.goto(address);
  await ready(page);
  await atRest(page);
  return page;
}

/** Chooses the place in the middle of the window. */
export async function chooseMiddle(page) {
  await page.focus("#city");
  await page.keyboard.press("Enter");
}

/** The address of a page, which it writes some time after the last change, once it has a text. */
export async function linkWith(page, text) {
  await page.waitForFunction((wanted) => decodeURIComponent(location.hash).includes(wanted), text);
  return page.url();
}

/** Looks again until a condition holds of what is seen, or for so long; what was seen last. */
export async function seen(look, condition, timeout_ms = longest_ms) {
  const end = Date.now() + timeout_ms;
  for (;;) {
    const now = await look();
    if (condition(now) || Date.now() > end) return now;
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
}

/** The pixels of a screenshot, in rows of red, green, blue, alpha. */
export const pixels = async (page, clip) => decoded(page, await page.screenshot({ clip }));

/** The pixels of a PNG; the browser itself decodes them. */
export async function decoded(page, bytes) {
  const png = bytes.toString("base64");
  const { width, height, text } = await page.evaluate(async (base64) => {
    const image = new Image();
    image.src = `data:image/png;base64,${base64}`;
    await image.decode();
    const canvas = new OffscreenCanvas(image.width, image.height), context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const bytes = context.getImageData(0, 0, image.width, image.height).data;
    let binary = "";
    for (let n = 0; n < bytes.length; n += 32768) binary += String.fromCharCode(...bytes.subarray(n, n + 32768));
    return { width: image.width, height: image.height, text: btoa(binary) };
  }, png);
  return { width, height, data: Buffer.from(text, "base64") };
}

/** The share of pixels that are nearer than `distance` to a condition's colour. */
export function share(picture, holds) {
  let count = 0;
  for (let n = 0; n < picture.data.length; n += 4) count += holds(picture.data[n], picture.data[n + 1], picture.data[n + 2]) ? 1 : 0;
  return count / (picture.width * picture.height);
}

export function differing(a, b) {
  let count = 0;
  for (let n = 0; n < a.data.length; n += 4) count += Math.abs(a.data[n] - b.data[n]) + Math.abs(a.data[n + 1] - b.data[n + 1]) > 24 ? 1 : 0;
  return count / (a.width * a.height);
}
