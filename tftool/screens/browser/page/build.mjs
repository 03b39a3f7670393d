// Builds ../bundle/ from the scripts in this folder: `npm install --no-package-lock && npm run build`.
// The versions in package.json are exact, so the same sources give the same bytes.
import { build } from "esbuild";
import { createHash } from "node:crypto";
import { copyFile, mkdir, readdir, readFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const out = join(here, "..", "bundle");

// What the bundle was made from; a test compares it with the sources as they are.
const hash = createHash("sha256");
const sources = [...(await readdir(here)), ...(await readdir(join(here, "displays"))).map((name) => `displays/${name}`)]
  .filter((name) => /\.(m?js|json)$/.test(name))
  .sort();
for (const name of sources) {
  hash.update(name).update("\0").update(await readFile(join(here, name))).update("\0");
}

await mkdir(out, { recursive: true });
await build({
  entryPoints: { page: join(here, "main.js"), unpack: join(here, "unpack.js") },
  outdir: out,
  bundle: true,
  minify: true,
  charset: "utf8",
  target: ["chrome100", "firefox100", "safari15.4"],
  legalComments: "inline",
  banner: { js: `/* tftool view; three.js: see three-LICENSE.txt; sources ${hash.digest("hex")} */` },
});
await copyFile(join(here, "node_modules", "three", "LICENSE"), join(out, "three-LICENSE.txt"));
