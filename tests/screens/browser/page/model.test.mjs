import assert from "node:assert/strict";
import { test } from "node:test";
import { Choices } from "../../../../tftool/screens/browser/page/choices.js";
import { chain, describe, trail, trailing } from "../../../../tftool/screens/browser/page/frames.js";
import { Model } from "../../../../tftool/screens/browser/page/model.js";
import { decode, Poses } from "../../../../tftool/screens/browser/page/wire.js";

const FIELDS = 11;

/** A packet as the server makes it: header, then 11 numbers a frame. */
function packet(rows, { at = Number.NaN, now = 5, sequence = 1 } = {}) {
  const buffer = new ArrayBuffer(48 + rows.length * FIELDS * 8);
  const head = new DataView(buffer);
  head.setUint32(0, 0x54465031);
  head.setUint32(4, sequence, true);
  head.setUint32(8, 1, true);
  head.setUint32(12, rows.length, true);
  [now, at, 1, now].forEach((value, place) => head.setFloat64(16 + 8 * place, value, true));
  rows.flat().forEach((value, place) => head.setFloat64(48 + 8 * place, value, true));
  return buffer;
}

const row = (x, y, newest = 5) => [x, y, 0, 0, 0, 0, 1, newest, 1, 10, 40];
const ROOT = new Array(FIELDS).fill(Number.NaN);

/** world with arm (moving), hand on it (static); another root with egg and hen in a loop beside. */
function model(rows = [ROOT, row(2, 0), row(1, 1), ROOT, row(0, 0), row(0, 0)], options = {}) {
  const made = new Model();
  made.setNames({
    epoch: 1, revision: 1, rate: 1, total: 6,
    names: ["world", "arm", "hand", "lone", "egg", "hen"],
    parents: [-1, 0, 1, -1, 5, 4],
    statics: [false, false, true, false, false, false],
    authorities: ["", "a", "b", "", "c", "c"],
  });
  made.setPoses(new Poses(decode(packet(rows, options))), 0);
  return made;
}

test("a packet is decoded, and anything else is not one", () => {
  const found = decode(packet([row(1, 2)], { at: 3, sequence: 9 }));
  assert.deepEqual([found.sequence, found.count, found.at, found.now], [9, 1, 3, 5]);
  assert.equal(decode(packet([row(1, 2)])).at, null);
  assert.equal(decode(new ArrayBuffer(3)), null);
  assert.equal(decode(packet([row(1, 2)]).slice(0, 60)), null);
});

test("poses are those in the fixed frame; what another tree or a loop holds has none", () => {
  const made = model();
  made.solve("arm");
  assert.deepEqual(made.absolute.map((pose) => pose?.slice(0, 2) ?? null), [[-2, 0], [0, 0], [1, 1], null, null, null]);
  assert.deepEqual(made.looped, [4, 5]);
  assert.equal(made.biggestRoot(), "world");
});

test("what is static or moved by a joint is carried by the frame above it", () => {
  const made = model();
  const carriers = (...joints) => made.names.map((name) => made.names[made.carrier(name, new Set(joints))]);
  assert.deepEqual(carriers(), ["world", "arm", "arm", "lone", "egg", "hen"]);
  assert.deepEqual(carriers("arm", "egg", "hen"), ["world", "world", "world", "lone", "egg", "hen"]);
  assert.equal(made.carrier("nobody", new Set()), -1);
});

test("a frame without a pose says why", () => {
  const made = model();
  const said = (fixed) => {
    made.solve(fixed);
    return describe(made, new Choices({ fixed }), false).map(({ trouble }) => trouble);
  };
  const [, , , lone, egg] = said("world");
  assert.equal(lone, "No transform from [lone] to [world]");
  assert.match(egg, /its chain is a loop$/);
  assert.match(said("map")[0], /frame \[map\] does not exist$/);
});

test("a hidden, a filtered and a faded frame are listed and not shown", () => {
  const made = model();
  const shown = (choices) => {
    made.solve("world");
    return describe(made, choices, false).filter((frame) => frame.shown).map(({ name }) => name);
  };
  assert.deepEqual(shown(new Choices({ fixed: "world" })), ["world", "arm", "hand"]);
  assert.deepEqual(shown(new Choices({ fixed: "world", hidden: ["arm"], not: "^w" })), ["hand"]);
  made.setPoses(new Poses(decode(packet([ROOT, row(2, 0), row(1, 1), ROOT, row(0, 0), row(0, 0)], { now: 25 }))), 20_000);
  assert.deepEqual(shown(new Choices({ fixed: "world", timeout: 15 })), ["world"]);
});

test("a moving frame tells its rate, one that stopped its age, a static one nothing", () => {
  const made = model([ROOT, row(2, 0, 1), row(1, 1), ROOT, row(0, 0, 5), row(0, 0)]);
  made.solve("world");
  const told = describe(made, new Choices({ fixed: "world" }), false).map((frame) => frame.told);

  assert.deepEqual(told.slice(0, 5), ["", "4.0 s", "", "", "10 Hz"]);
});

test("trails are drawn for the frames chosen, or for all that can move", () => {
  const made = model();
  made.setPoses(new Poses(decode(packet([ROOT, row(3, 0), row(1, 1), ROOT, row(0, 0), row(0, 0)], { now: 6 }))), 1000);
  made.solve("world");
  const points = (given) => {
    const choices = new Choices({ fixed: "world", ...given });
    const drawn = describe(made, choices, false).filter((frame) => frame.shown);
    return trailing(made, drawn, choices).map((frame) => trail(made, frame, choices, 6).points.map((pose) => pose[0]));
  };
  assert.deepEqual(points({}), []);
  assert.deepEqual(points({ trailed: ["arm"] }), [[2, 3]]);
  assert.deepEqual(points({ trails: true }), [[2, 3], [3, 4]]);
});

test("the chain of a pair is drawn where all of it is known", () => {
  const made = model();
  made.solve("world");
  assert.equal(chain(made, { found: true, chain: ["hand", "arm", "world"] }).length, 3);
  assert.deepEqual(chain(made, { found: true, chain: ["hand", "lone"] }), []);
  assert.deepEqual(chain(made, { found: false, chain: [] }), []);
  assert.deepEqual(chain(made, null), []);
});
