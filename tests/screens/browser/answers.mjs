// Reads a standalone page and prints what it answers: node answers.mjs PAGE QUESTIONS.
import { readFile } from "node:fs/promises";
import { inflateSync } from "node:zlib";
import { Lookups } from "../../../tftool/screens/browser/page/lookups.js";
import { open, Packed } from "../../../tftool/screens/browser/page/packed.js";

const [page, asked] = process.argv.slice(2);
const text = await readFile(page, "utf8");
const [, packed] = text.match(/type="application\/octet-stream">([^<]*)</);
const block = new Uint8Array(inflateSync(Buffer.from(packed, "base64")));
const { header, bytes } = open(block.buffer);
const lookups = new Lookups(new Packed(header, bytes));
const answers = JSON.parse(await readFile(asked, "utf8")).map(({ at, pairs }) => {
  const { names, poses } = lookups.picture(at);
  const { now, oldest, newest } = poses;
  return {
    names,
    reach: [now, oldest, newest],
    numbers: Array.from(poses.numbers, (value) => (Number.isNaN(value) ? null : value)),
    pairs: pairs.map(([target, source]) => lookups.pair(target, source, at)),
  };
});
const series = lookups.series({ target: "map", source: "laser", from: -0.25, to: 3.3, count: 301 });
const trails = lookups.trails({ fixed: "map", frames: ["laser", "base", "nobody"], from: -0.25, to: 3.3, count: 301 });
console.log(JSON.stringify({ answers, moments: lookups.moments(), series, trails }));
