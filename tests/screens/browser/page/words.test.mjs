import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { colorOf, lateness } from "../../../../tftool/screens/browser/page/frames.js";
import { halves } from "../../../../tftool/screens/browser/page/format.js";
import { freshness } from "../../../../tftool/screens/browser/page/freshness.js";
import { KEYS, meant } from "../../../../tftool/screens/browser/page/keys.js";
import { offered } from "../../../../tftool/screens/browser/page/match.js";
import { Model } from "../../../../tftool/screens/browser/page/model.js";
import { THEMES } from "../../../../tftool/screens/browser/page/themes.js";

test("names are offered best first", () => {
  const names = ["base_link", "laser_link", "link", "linkage", "lost_in_ink"];
  assert.deepEqual(offered(names, ""), names);
  assert.deepEqual(offered(names, " LINK "), ["link", "linkage", "base_link", "laser_link", "lost_in_ink"]);
  assert.deepEqual(offered(names, "lslk"), ["laser_link"]);
  assert.deepEqual(offered(names, "nothing"), []);
});

test("a key belongs to what has the focus, where that needs it", () => {
  assert.equal(meant({ key: "T" }, "other"), "top");
  assert.equal(meant({ key: "t" }, "button"), "top");
  assert.equal(meant({ key: "t" }, "text"), undefined);
  assert.equal(meant({ key: " " }, "button"), undefined);
  assert.equal(meant({ key: " " }, "other"), "play");
  assert.equal(meant({ key: "t", ctrlKey: true }, "other"), undefined);
  assert.equal(new Set(KEYS.map(([key]) => key)).size, KEYS.length);
});

test("every control that a key stands for is on the page", () => {
  const page = readFileSync(new URL("../../../../tftool/screens/browser/page/index.html", import.meta.url), "utf8");
  for (const [, id] of KEYS) assert.ok(page.includes(`id="${id}"`), id);
});

test("a link is late after some periods and dead after many", () => {
  assert.deepEqual([0.5, 1.5, 6].map((age) => lateness(age, 50)), ["", "late", "dead"]);
  // One that comes every ten seconds is not late after eight.
  assert.deepEqual([8, 40, 120].map((age) => lateness(age, 0.1)), ["", "late", "dead"]);
});

test("what is shown is live, stale or gone", () => {
  const model = new Model();
  const poses = { at: null, count: 2, now: 10, newest: 9, rateOf: () => 50, samplesOf: () => 9 };
  Object.assign(model, { names: ["world", "arm"], parents: [-1, 0], statics: [false, false], poses });
  model.heardAt = 10_000;
  model.fresh = { newest: 9, when: 9_000, now: 9 };
  assert.equal(freshness("open", model, false), "live");
  model.heardAt = 20_000;
  assert.equal(freshness("open", model, false), "stale");
  assert.equal(freshness("open", model, true), "past");
  assert.equal(freshness("ended", model, true), "gone");
  assert.equal(freshness("wait", model, false), "wait");
  // A world whose time stands still is not late.
  model.fresh.now = 10;
  assert.equal(freshness("open", model, false), "live");
  // Nor is one in which nothing moves.
  model.fresh.now = 9;
  model.statics = [false, true];
  assert.equal(freshness("open", model, false), "live");
});

test("a page that is opened late says how old its news is", () => {
  const model = new Model();
  const came = (now, newest, when) => model.setPoses({ at: null, revision: -2, now, newest }, when);
  came(50, 10, 1_000);
  came(57, 10, 8_000);
  assert.equal(model.unheard(), 7);
  assert.equal(model.quiet(), 47);
  // What came since is as old as it is long ago, whatever clock it was stamped with.
  came(58, 11, 9_000);
  came(64, 11, 15_000);
  assert.equal(model.quiet(), 6);
});

test("of a long name the end is always to be seen", () => {
  assert.deepEqual(halves("base_link"), ["base_link"]);
  assert.deepEqual(halves("front_left_ultrasonic_optical_frame_3"), ["front_left_ultrasonic_opt", "ical_frame_3"]);
  // From right to left, or of characters that join, a name stays one.
  assert.equal(halves("שלום".repeat(9)).length, 1);
});

test("the first frames have colours of their own", () => {
  assert.equal(new Set(Array.from({ length: 30 }, (_, place) => colorOf(place, "dark"))).size, 30);
});

const light = (hex) => {
  const [r, g, b] = [1, 3, 5].map((at) => Number.parseInt(hex.slice(at, at + 2), 16) / 255)
    .map((value) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
};

test("names in the picture stand out from what is behind them", () => {
  for (const { background, text, accent } of Object.values(THEMES)) {
    for (const color of [text, accent]) {
      const [low, high] = [light(color), light(background)].sort((one, other) => one - other);
      assert.ok((high + 0.05) / (low + 0.05) >= 4.5, `${color} on ${background}`);
    }
  }
});
