// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
//
// Bundles the page into a folder: node build.mjs FOLDER. scripts/viewer calls it; same sources and lock file, same bytes.
import { copyFileSync, existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build, transform } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url)), folder = process.argv[2];
if (!folder) throw new Error("usage: node build.mjs FOLDER");

const script = {
  absWorkingDir: here, entryPoints: ["src/main.ts"], bundle: true, minify: true, format: "esm", target: "es2022", charset: "utf8",
  legalComments: "none", metafile: true, write: false, logLevel: "warning",
};

/** The packages that have a part in the bundle, in the order of their names. */
function packagesOf(metafile) {
  const used = Object.values(metafile.outputs).flatMap((output) => Object.entries(output.inputs)).filter(([, { bytesInOutput }]) => bytesInOutput > 0);
  const names = used.flatMap(([path]) => path.match(/node_modules\/((?:@[^/]+\/)?[^/]+)/)?.[1] ?? []);
  return [...new Set(names)].sort().map((name) => {
    const root = join(here, "node_modules", name), { version, license } = JSON.parse(readFileSync(join(root, "package.json"), "utf8"));
    const text = readdirSync(root).filter((file) => /^licen[cs]e/i.test(file)).sort()[0];
    if (!text) throw new Error(`${name} has no licence file`);
    return { name, version, license, text: readFileSync(join(root, text), "utf8").trim() };
  });
}

function licencesOf(packages) {
  const begin = "The page of farlod-view is under the licence Apache-2.0 (The Far-LoD authors). viewer.js contains parts of:\n";
  const list = packages.map(({ name, version, license }) => `  ${name} ${version} (${license})`).join("\n");
  const texts = packages.map(({ name, text }) => `\n\n==== ${name} ====\n\n${text.replace(/\r/g, "")}`).join("");
  return `${begin}\n${list}${texts}\n`;
}

const { outputFiles, metafile } = await build(script), packages = packagesOf(metafile);
const banner = `// The Far-LoD authors, Apache-2.0; with ${packages.map((p) => `${p.name} ${p.version} (${p.license})`).join(", ")}: licences.txt\n`;
const style = await transform(readFileSync(join(here, "style.css"), "utf8"), { loader: "css", minify: true, charset: "utf8" });
mkdirSync(folder, { recursive: true });
writeFileSync(join(folder, "viewer.js"), banner + outputFiles[0].text);
writeFileSync(join(folder, "viewer.css"), style.code);
writeFileSync(join(folder, "licences.txt"), licencesOf(packages));
copyFileSync(join(here, "index.html"), join(folder, "index.html"));
// farlod-view --export NAME.html puts them between tags
for (const [file, end] of [["viewer.js", /<\/script|<!--/i], ["viewer.css", /<\/style/i], ["licences.txt", /<\/script|<!--/i]])
  if (end.test(readFileSync(join(folder, file), "utf8"))) throw new Error(`${file} would end the element of a page that holds it`);
if (existsSync(join(folder, "viewer.js.map"))) throw new Error("a source map in the bundle");
