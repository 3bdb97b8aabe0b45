// SPDX-License-Identifier: GPL-2.0-or-later
// Bundles src/ and three.js into the package's asset: `npm ci && npm run build [-- FOLDER]`. The same sources give the same bytes.
import { build } from "esbuild";
import { createHash } from "node:crypto";
import { copyFileSync, mkdirSync, readFileSync, readdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const target = process.argv[2] ?? join(here, "../py/timber_houses/data/player");
const three = join(here, "node_modules/three");

/** SHA-256 of the names and contents of all inputs of the bundle; tests/unit/test_player_asset.py computes the same. */
function sourceHash() {
  const names = ["build.mjs", "package-lock.json", "package.json", ...readdirSync(join(here, "src")).map((name) => `src/${name}`)].sort();
  const hash = createHash("sha256");
  for (const name of names) hash.update(`${name}\n`).update(readFileSync(join(here, name)));
  return hash.digest("hex");
}

const version = JSON.parse(readFileSync(join(three, "package.json"))).version;
const banner = `/*! yade-timber player, GPL-2.0-or-later; built from player/, see its README; do not edit.
sources sha256 ${sourceHash()}
Contains parts of three.js ${version}:
${readFileSync(join(three, "LICENSE"), "utf8").trim()}
*/`;
mkdirSync(target, { recursive: true });
await build({
  entryPoints: [join(here, "src/main.js")],
  absWorkingDir: here,
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2022",
  charset: "utf8",
  legalComments: "none",
  banner: { js: banner },
  outfile: join(target, "player.js"),
});
copyFileSync(join(three, "LICENSE"), join(target, "LICENSE.three.js.txt"));
