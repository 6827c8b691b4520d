// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
//
// The page of farlod-view in a real browser. One line a test; the exit code is 1 when one fails, 77 where nothing could run.
//
//   node tests/viewer/page_test.mjs                                        with a mock of the server, and a town of boxes
//   node tests/viewer/page_test.mjs --program farlod-view --package x.farlod
//   node tests/viewer/page_test.mjs … --only WORD                          tests whose name has it
//   node tests/viewer/page_test.mjs --write-pictures                       writes the pictures anew: look at them before committing
import { parseArgs } from "node:util";
import { missing, openBrowser } from "./browser.mjs";
import { failureTests } from "./failure_tests.mjs";
import { lookTests } from "./look_tests.mjs";
import { onePageTests } from "./one_page_tests.mjs";
import { placeTests } from "./place_tests.mjs";
import { resultTests } from "./result_tests.mjs";
import { starterOf } from "./servers.mjs";
import { useTests } from "./use_tests.mjs";

const skipped = 77;
const { values } = parseArgs({ options: { program: { type: "string" }, package: { type: "string" }, only: { type: "string", default: "" }, "write-pictures": { type: "boolean", default: false } } });
if (missing()) {
  console.log(`skipped: ${missing()}`);
  process.exit(skipped);
}

const start = starterOf({ program: values.program, packageFolder: values.package });
// The mock answers at once, and what is expected of its results is known; farlod-view has its answers and its exports tried
const groups = values.program ? [placeTests, failureTests, onePageTests(values.program, values.package)]
  : [lookTests, placeTests, useTests, failureTests, resultTests];
const tests = Object.entries(Object.assign({}, ...groups)).filter(([name]) => name.includes(values.only));
const browser = await openBrowser(), server = await start();
let failed = 0;
for (const [name, test] of tests) {
  const begin = Date.now(), context = await browser.newContext({ viewport: { width: 1000, height: 700 } });
  try {
    await test({ url: server.url, start, context, browser, isMock: !values.program, writesPictures: values["write-pictures"] });
    console.log(`passed ${name} (${((Date.now() - begin) / 1000).toFixed(1)} s)`);
  } catch (error) {
    ++failed;
    console.log(`FAILED ${name}: ${error.message}`);
  }
  await context.close();
}
await browser.close();
await server.stop();
console.log(`${tests.length} tests of the page, ${failed} failed`);
process.exit(failed > 0 || tests.length === 0 ? 1 : 0);
