import assert from "node:assert/strict";
import { test } from "node:test";
import { Tracks } from "../../../../tftool/screens/browser/page/tracks.js";

/** What is packed: every column says its own numbers. */
const packed = { fresh: (column, count) => Float64Array.from(column.numbers).subarray(0, count) };
const shape = (stamp) => ({
  kind: "points", frame: "laser", root: "map", pose: [0, 0, 0, 0, 0, 0, 1], count: 2,
  places: [{ numbers: [stamp, 1] }, { numbers: [2, 3] }, { numbers: [4, 5] }],
});
const message = (stamp) => ({ stamp, shapes: [shape(stamp)] });
const track = (...stamps) => ({ topic: "/scan", type: "t", count: 9, faults: [], messages: stamps.map(message) });

test("a moment shows the last message up to then, and the present the last of all", () => {
  const tracks = new Tracks();
  tracks.take([track(3, 1, 2)], packed, true);

  assert.deepEqual([0.5, 1, 2.9, 99, null].map((at) => tracks.at("/scan", at)?.stamp), [undefined, 1, 2, 3, 3]);
  assert.equal(tracks.at("/other", 1), null);
  assert.deepEqual([...(tracks.at("/scan", 1)?.shapes[0].places() ?? [])], [1, 2, 4, 1, 3, 5]);
});

test("what goes on is added to, up to a limit; what is whole replaces", () => {
  const tracks = new Tracks();
  for (let stamp = 0; stamp < 300; stamp++) tracks.take([track(stamp)], packed, false);
  assert.equal(tracks.topics.get("/scan")?.messages.length, 200);
  assert.equal(tracks.at("/scan", 100), tracks.topics.get("/scan")?.messages[0] ?? null);

  tracks.take([track(7)], packed, true);
  assert.equal(tracks.topics.get("/scan")?.messages.length, 1);
});

test("a topic that goes on is kept up to so many places, and its last message always", () => {
  const tracks = new Tracks();
  const large = (stamp) => ({ ...track(stamp), messages: [{ stamp, shapes: [{ ...shape(stamp), count: 250_000 }] }] });
  for (let stamp = 0; stamp < 9; stamp++) tracks.take([large(stamp)], packed, false);
  assert.deepEqual(tracks.topics.get("/scan")?.messages.map((one) => one.stamp), [7, 8]);
});

test("where time begins anew, what came last is shown; another session begins without any", () => {
  const tracks = new Tracks();
  for (const stamp of [5, 6, 6, 2]) tracks.take([track(stamp)], packed, false);
  tracks.take([{ ...track(1), topic: "/recorded" }], packed, true);

  assert.deepEqual(tracks.topics.get("/scan")?.messages.map((one) => one.stamp), [2]);
  tracks.forget();
  assert.deepEqual([...tracks.topics.keys()], ["/recorded"]);
});

test("a shape may have a colour at each place, from 0 to 1", () => {
  const tracks = new Tracks();
  const colors = [[255, 0], [0, 51], [0, 0], [255, 255]].map((numbers) => ({ numbers }));
  tracks.take([{ ...track(), messages: [{ stamp: 1, shapes: [shape(1), { ...shape(1), colors }] }] }], packed, true);

  const [plain, coloured] = tracks.at("/scan", 1)?.shapes ?? [];
  assert.equal(plain.colors(), null);
  assert.deepEqual([...(coloured.colors() ?? [])].map((share) => Math.round(share * 10)), [10, 0, 0, 10, 0, 2, 0, 10]);
});
