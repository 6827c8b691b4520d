// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
//
// Links, keys, touch, and what screen readers are told.
import { atRest, chooseMiddle, linkWith, opened, state, until } from "./browser.mjs";
import { expect, expectEqual, expectNear } from "./checks.mjs";

/** Relative luminance after WCAG 2. */
function luminance(css) {
  const [r, g, b] = css.match(/[\d.]+/g).slice(0, 3).map((c) => Number(c) / 255).map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}
const contrast = (a, b) => (Math.max(luminance(a), luminance(b)) + 0.05) / (Math.min(luminance(a), luminance(b)) + 0.05);

export const useTests = {
  async "a link restores the view"({ url, context }) {
    const page = await opened(context, url);
    await page.click("#theme");
    await page.click("#layer-roofs");
    await page.keyboard.press("Escape");
    await page.focus("#city");
    for (const key of ["+", "+", "Shift+ArrowLeft", "ArrowUp"]) await page.keyboard.press(key);
    await atRest(page);
    await page.keyboard.press("Enter");
    const before = await until(page, "the answer", ({ answer, skyIsDrawn }) => answer !== null && skyIsDrawn);
    await page.selectOption("#projection", "equal-area");
    const again = await opened(context, await linkWith(page, "projection=equal-area"));
    const after = await until(again, "the place of the link", ({ answer, picked }) => picked !== null && answer !== null);
    for (const name of ["distance_m", "bearing_deg", "tilt_deg"]) expectNear(after.camera[name], before.camera[name], 0.01, name);
    for (const axis of ["x", "y", "z"]) expectNear(after.camera.target_local[axis], before.camera.target_local[axis], 0.01, `the target's ${axis}`);
    expectEqual([after.picked.building, after.picked.surface, after.picked.kind], [before.picked.building, before.picked.surface, before.picked.kind], "the place");
    before.picked.projected_m.forEach((p, n) => expectNear(after.picked.projected_m[n], p, 0.02, `coordinate ${n} of the place`));
    expectEqual(await again.getAttribute("html", "data-theme"), "dark", "the theme");
    expectEqual([await again.isChecked("#layer-roofs"), await again.isChecked("#layer-ground")], [false, true], "the layers");
    expectEqual(await again.inputValue("#projection"), "equal-area", "the projection");
  },

  async "a wrong link opens the whole city"({ url, context }) {
    const page = await opened(context, `${url}#camera=1,2,x&place=1&theme=pink&layers=ground,moon`);
    const home = await opened(context, url);
    expectNear((await state(page)).camera.distance_m, (await state(home)).camera.distance_m, 0.01, "the distance");
  },

  async "keys move the view"({ url, context }) {
    const page = await opened(context, url), press = async (key) => { await page.keyboard.press(key); return (await atRest(page)).camera; };
    await page.focus("#city");
    const home = (await state(page)).camera, near = await press("+");
    expect(near.distance_m < 0.9 * home.distance_m, "+ does not come nearer");
    expect((await press("-")).distance_m > 1.1 * near.distance_m, "- does not go away");
    expect((await press("ArrowRight")).target_local.x > home.target_local.x + 1, "the right arrow does not move to the right");
    expect((await press("ArrowUp")).target_local.y > home.target_local.y + 1, "the upper arrow does not move on");
    const turned = await press("Shift+ArrowRight");
    expect(Math.abs(turned.bearing_deg - home.bearing_deg) > 5, "Shift with an arrow does not turn");
    expect((await press("Shift+ArrowUp")).tilt_deg !== turned.tilt_deg, "Shift with an arrow does not tilt");
    expectNear((await press("n")).bearing_deg, home.bearing_deg, 0.1, "the bearing after N");
    const back = await press("h");
    expectNear(back.distance_m, home.distance_m, 0.1, "the distance after H");
    expectNear(back.target_local.x, home.target_local.x, 0.1, "the place after H");
    await press("Enter");
    expect((await state(page)).picked !== null, "Enter chooses nothing");
    await press("Escape");
    expect((await state(page)).picked === null && (await page.isHidden("#panel")), "Esc does not close");
  },

  async "Tab reaches every control"({ url, context }) {
    const page = await opened(context, url), reached = new Set();
    await chooseMiddle(page);
    await until(page, "the place", ({ picked, answer }) => picked !== null && answer !== null);
    for (let n = 0; n < 40; ++n) {
      reached.add(await page.evaluate(() => document.activeElement?.id || document.activeElement?.tagName));
      await page.keyboard.press("Tab");
    }
    const wanted = ["city", "marker", "SUMMARY", "layer-ground", "layer-roofs", "layer-facades", "layer-grid", "layer-trees", "zoom-in", "zoom-out", "north", "home", "theme", "close-panel", "projection", "ask-cell"];
    expectEqual(wanted.filter((id) => !reached.has(id)), [], "controls that Tab does not reach");
  },

  async "the marker moves by keys"({ url, context }) {
    const page = await opened(context, url);
    await chooseMiddle(page);
    const before = await until(page, "the place", ({ picked, answer }) => picked !== null && answer !== null);
    await page.focus("#marker");
    await page.keyboard.press("Shift+ArrowRight");
    const after = await until(page, "the moved place", ({ picked }) => picked.projected_m[0] !== before.picked.projected_m[0]);
    expect(after.picked.projected_m[0] > before.picked.projected_m[0], "the marker moved to the left");
    expectNear(after.camera.target_local.x, before.camera.target_local.x, 1e-3, "the camera's target");
  },

  async "every control has a name, and texts are legible"({ url, context }) {
    const page = await opened(context, url);
    await chooseMiddle(page);
    await page.click("#ask-cell");
    await page.waitForSelector("#cell h2");
    const client = await context.newCDPSession(page), { nodes } = await client.send("Accessibility.getFullAXTree");
    const roles = ["button", "checkbox", "combobox", "application", "image", "img", "complementary", "navigation", "table", "DisclosureTriangle"];
    const nameless = nodes.filter((node) => !node.ignored && roles.includes(node.role?.value) && !node.name?.value).map((node) => node.role.value);
    expectEqual(nameless, [], "roles without a name");
    expect(nodes.filter((node) => node.role?.value === "button").length >= 7, "the tree of accessibility is not complete");
    const { lang, title, twice, dangling } = await page.evaluate(() => {
      const ids = [...document.querySelectorAll("[id]")].map((e) => e.id);
      const refs = [...document.querySelectorAll("[aria-describedby],[for]")].map((e) => e.getAttribute("aria-describedby") ?? e.getAttribute("for"));
      return { lang: document.documentElement.lang, title: document.title, twice: ids.filter((id, n) => ids.indexOf(id) !== n), dangling: refs.filter((id) => !ids.includes(id)) };
    });
    expectEqual([lang, twice, dangling], ["en", [], []], "language, ids that stand twice, references to nothing");
    expect(title.includes("Far-LoD"), "the page has no title");
    expect((await page.textContent("#status")).length > 0, "the line for screen readers is empty");
    for (const theme of ["light", "dark"]) {
      if ((await page.getAttribute("html", "data-theme")) !== theme) await page.click("#theme");
      const [ink, muted, paper] = await page.evaluate(() => ["#value", ".note", "#panel"].map((s, n) => getComputedStyle(document.querySelector(s))[n < 2 ? "color" : "backgroundColor"]));
      for (const colour of [ink, muted]) expect(contrast(colour, paper) >= 4.5, `in the ${theme} theme, ${colour} on ${paper} has a contrast of ${contrast(colour, paper).toFixed(2)}`);
    }
  },

  async "works by touch on a small screen"({ url, browser }) {
    const context = await browser.newContext({ viewport: { width: 390, height: 760 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 });
    const page = await opened(context, url), home = (await state(page)).camera;
    await page.touchscreen.tap(195, 400);
    await until(page, "the answer", ({ answer }) => answer !== null);
    expect(await page.isVisible("#panel"), "no panel");
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    expect(wide <= 0, `the page is ${wide} pixels too wide`);
    await page.click("#close-panel");
    const client = await context.newCDPSession(page), touch = (type, touchPoints) => client.send("Input.dispatchTouchEvent", { type, touchPoints });
    await touch("touchStart", [{ x: 150, y: 400, id: 0 }, { x: 240, y: 400, id: 1 }]);
    for (let n = 1; n <= 8; ++n) await touch("touchMove", [{ x: 150 - 10 * n, y: 400, id: 0 }, { x: 240 + 10 * n, y: 400, id: 1 }]);
    await touch("touchEnd", []);
    expect((await atRest(page)).camera.distance_m < 0.8 * home.distance_m, "two fingers do not zoom");
    await context.close();
  },
};
