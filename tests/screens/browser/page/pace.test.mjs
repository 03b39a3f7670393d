import assert from "node:assert/strict";
import { test } from "node:test";
import { Pace } from "../../../../tftool/screens/browser/page/pace.js";

/** Draw pictures one after the other, each taking so many milliseconds; the last one's scale. */
function drawn(pace, count, took, from = 0) {
  for (let at = 0; at < count; at++) {
    pace.tick(from + at * took);
    pace.draw(from + at * took);
  }
  return pace.scale;
}

test("pictures that come fast enough are as fine as the window", () => {
  assert.equal(drawn(new Pace(), 200, 25), 1);
});

test("slow pictures grow coarser by steps, down to half", () => {
  const pace = new Pace();
  const scales = [];
  for (let at = 0; at < 60; at++) scales.push(drawn(pace, 1, 0, 50 * at));

  assert.deepEqual([...new Set(scales)], [1, 0.7, 0.5]);
  assert.ok(scales.indexOf(0.7) >= 8, "a few slow pictures change nothing");
});

test("what comes to rest is drawn once more, in full", () => {
  const pace = new Pace();
  drawn(pace, 60, 50);

  assert.equal(pace.tick(60 * 50), false);
  assert.equal(pace.tick(60 * 50 + 300), true);
  assert.equal(pace.draw(60 * 50 + 300), 1);
  assert.equal(pace.tick(60 * 50 + 700), false);
});

test("what moves on after a rest is as coarse as before", () => {
  const pace = new Pace();
  drawn(pace, 60, 50);
  pace.draw(4000);

  assert.equal(drawn(pace, 2, 50, 4050), 0.5);
});

test("pictures grow finer again where there is time, and less often where that was in vain", () => {
  const pace = new Pace();
  drawn(pace, 60, 50);
  const needed = [];
  let now = 3000;
  for (let round = 0; round < 3; round++) {
    let count = 0;
    for (; pace.scale === 0.5; count++) drawn(pace, 1, 0, (now += 16));
    for (; pace.scale !== 0.5; ) drawn(pace, 1, 0, (now += 50));
    needed.push(count);
  }

  assert.ok(needed[0] < needed[1] && needed[1] < needed[2], String(needed));
});

test("the time a page was not seen says nothing", () => {
  const pace = new Pace();
  drawn(pace, 30, 20);

  assert.equal(drawn(pace, 30, 5000, 1000), 1);
  assert.equal(drawn(pace, 30, 20, 200_000), 1);
});
