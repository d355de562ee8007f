// SPDX-License-Identifier: BSD-3-Clause
// Bundle the page into one script and one style sheet: `node build.mjs [FOLDER]`.
// The same sources give the same bytes in any folder; bundle.sha256 says which sources gave which bytes.

import { createHash } from "node:crypto";
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join, relative, resolve } from "node:path";
import { fileURLToPath } from "node:url";

import { build } from "esbuild";

const web = dirname(fileURLToPath(import.meta.url));
const out = resolve(process.argv[2] ?? join(web, "../src/forcetorque/viewer/assets"));

const options = {
  absWorkingDir: web,
  entryPoints: ["src/main.ts"],
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2022",
  charset: "ascii",
  legalComments: "none", // the page holds them whole
  metafile: true,
  write: false,
  outdir: "out",
};
const { metafile, outputFiles } = await build(options);

const packages = [
  ...new Set(
    Object.keys(metafile.inputs).flatMap((path) => /^node_modules\/((?:@[^/]+\/)?[^/]+)/.exec(path)?.[1] ?? []),
  ),
].sort();
const licences = packages.map(licence).join("\n");
mkdirSync(out, { recursive: true });
const written = {
  "THIRD_PARTY_LICENSES.txt": `The viewer's page contains these packages.\n\n${licences}`,
  "viewer.css": text(".css"),
  "viewer.js": text(".js"),
};
for (const [name, content] of Object.entries(written)) writeFileSync(join(out, name), content);
const sources = ["build.mjs", "package-lock.json", "package.json", "tsconfig.json", ...list(join(web, "src"))];
const lines = [
  ...Object.entries(written).map(([name, content]) => `${sha256(content)}  ${name}`),
  ...sources.map((path) => `${sha256(readFileSync(join(web, path)))}  web/${path}`),
];
writeFileSync(join(out, "bundle.sha256"), `${lines.join("\n")}\n`);
for (const [name, content] of Object.entries(written)) console.log(`${name} ${Buffer.byteLength(content)} bytes`);

function text(ending) {
  const file = outputFiles.find(({ path }) => path.endsWith(ending));
  if (!file) throw new Error(`esbuild gave no file that ends in ${ending}`);
  return file.text;
}

function licence(name) {
  const folder = join(web, "node_modules", name);
  const { version, license } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
  const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
  if (!file) throw new Error(`${name}: expected a licence file in its package`);
  const text = readFileSync(join(folder, file), "utf8").replaceAll("\r\n", "\n").trim();
  return `${name} ${version} (${license})\n\n${text}\n`;
}

function list(folder) {
  return readdirSync(folder, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => relative(web, join(entry.parentPath, entry.name)).replaceAll("\\", "/"))
    .sort();
}

function sha256(content) {
  return createHash("sha256").update(content).digest("hex");
}
