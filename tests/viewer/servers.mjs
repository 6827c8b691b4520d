// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
//
// The servers that tests start and stop: farlod-view with a package, or the mock.
import { spawn } from "node:child_process";
import { startMock } from "./mock_server.mjs";

/** farlod-view, once it has printed its address. */
function startProgram(program, packageFolder, results, port) {
  const child = spawn(program, [packageFolder, ...results, "--port", String(port)], { stdio: ["ignore", "pipe", "pipe"] });
  const ended = new Promise((resolve) => child.on("exit", resolve));
  return new Promise((resolve, reject) => {
    let said = "";
    const listen = (bytes) => {
      said += bytes;
      const url = said.match(/http:\/\/127\.0\.0\.1:\d+\/?/)?.[0];
      if (url) resolve({ url: url.endsWith("/") ? url : `${url}/`, stop: () => { child.kill("SIGTERM"); return ended; } });
    };
    child.stdout.on("data", listen);
    child.stderr.on("data", listen);
    child.on("error", reject);
    ended.then((status) => reject(new Error(`${program} ended with ${status}: ${said}`)));
  });
}

/** What starts a server on a port, 0 for any: by the arguments of the runner. */
export function starterOf({ program, packageFolder, results = [] }) {
  return program ? (port = 0) => startProgram(program, packageFolder, results, port) : (port = 0) => startMock({ port });
}
