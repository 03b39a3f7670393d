import assert from "node:assert/strict";
import { test } from "node:test";
import { Timeline } from "../../../../tftool/screens/browser/page/timeline.js";

const REACH = { oldest: 10, newest: 20, now: 21 };

/** A timeline whose buffer holds 10 s to 20 s, at 0 ms, and what it requested. */
function timeline(at = null) {
  const requested = [];
  const bounds = [];
  const hooks = { ask: (moment) => requested.push(moment), moved() {}, reached: (reach) => bounds.push(reach) };
  const line = new Timeline(hooks, at);
  line.setReach(REACH);
  return { line, requested, bounds };
}

test("bounds are handed on at once, with every span the buffer holds", () => {
  const { line, bounds } = timeline();
  line.setReach({ oldest: 11, newest: 22, now: 23 });

  assert.deepEqual(bounds, [REACH, { oldest: 11, newest: 22, now: 23 }]);
});

test("a scrub rests on the moment, and never beyond what the buffer holds", () => {
  const { line, requested } = timeline();
  for (const moment of [12.5, 3, 99]) line.scrub(moment);

  assert.deepEqual(requested, [12.5, 10, 20]);
  assert.equal(line.playing, false);
});

test("a step from the present starts at the newest moment", () => {
  const { line, requested } = timeline();
  line.rate = 2;
  line.step(-0.5);

  assert.deepEqual(requested, [19]);
});

test("play goes on at its speed once the poses requested have come", () => {
  const { line, requested } = timeline();
  line.tick(1000);
  line.scrub(12);
  line.speed = 2;
  line.toggle();
  line.tick(1100);
  assert.deepEqual(requested, [12], "nothing is requested while poses are awaited");

  assert.ok(line.accepts(12));
  line.tick(1200);
  assert.deepEqual(requested, [12, 12.2]);
});

test("what plays in a loop begins anew at its end, and rests there otherwise", () => {
  for (const [loops, after] of [[true, 10], [false, 20]]) {
    const { line } = timeline(19.95);
    Object.assign(line, { ends: true, playing: true, loops });
    line.tick(100);
    assert.equal(line.at, after);
    assert.equal(line.playing, loops);
  }
});

test("play that reaches the newest moment is live again", () => {
  const { line, requested } = timeline();
  line.scrub(19.95);
  line.toggle();
  line.accepts(19.95);
  line.tick(100);

  assert.equal(line.at, null);
  assert.deepEqual(requested, [19.95, null]);
});

test("a page that was hidden does not leap when it plays on", () => {
  const { line } = timeline();
  line.scrub(12);
  line.toggle();
  line.accepts(12);
  line.tick(60_000);

  assert.equal(line.at, 12.25);
});

test("a moment the buffer has forgotten is played on from the oldest it holds", () => {
  const { line, requested } = timeline();
  line.scrub(10);
  line.toggle();
  line.accepts(10);
  line.setReach({ oldest: 15, newest: 25, now: 25 });
  assert.ok(line.forgotten);
  line.tick(100);

  assert.equal(requested.at(-1), 15.1);
});

test("poses of the present are late once the past is looked at, and the reverse", () => {
  const { line } = timeline();
  assert.ok(line.accepts(null));
  line.scrub(12);
  assert.ok(!line.accepts(null));
  assert.ok(line.awaiting);
  line.goLive();
  assert.ok(!line.accepts(12));
});

test("a pause of the present rests on its newest moment", () => {
  const { line } = timeline();
  line.toggle();

  assert.equal(line.at, 20);
  assert.equal(line.playing, false);
});

test("when the connection ends, play no longer waits", () => {
  const { line } = timeline();
  line.scrub(12);
  line.lost();

  assert.equal(line.awaiting, false);
});

test("a zoom keeps its moment in place, and a window stays within the buffer", () => {
  const { line } = timeline(15);
  line.zoom(14, 0.5);
  assert.deepEqual(line.span, { oldest: 12, newest: 17 });
  line.pan(99);
  assert.deepEqual(line.span, { oldest: 15, newest: 20 });
  line.zoom(17, Infinity);
  assert.deepEqual(line.span, { oldest: 10, newest: 20 });
});

test("a window goes along with the moment shown, once that has been inside", () => {
  const { line } = timeline();
  line.zoom(20, 0.2);
  line.setReach({ oldest: 10, newest: 30, now: 30 });
  assert.deepEqual(line.span, { oldest: 28, newest: 30 });

  line.pan(-10);
  line.setReach({ oldest: 10, newest: 31, now: 31 });
  assert.deepEqual(line.span, { oldest: 18, newest: 20 });
});
