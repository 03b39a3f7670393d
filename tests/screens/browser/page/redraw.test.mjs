import assert from "node:assert/strict";
import { test } from "node:test";
import { Redraw } from "../../../../tftool/screens/browser/page/redraw.js";

test("everything is drawn first, and nothing again until something changes", () => {
  const redraw = new Redraw(150);

  assert.deepEqual(redraw.take(0, 0), { picture: true, lists: true });
  assert.deepEqual(redraw.take(1000, 0), { picture: false, lists: false });
});

test("data waits for the update interval, a person does not", () => {
  const redraw = new Redraw(150);
  redraw.take(0, 60_000);
  redraw.data();
  assert.equal(redraw.take(1000, 60_000).picture, false);
  redraw.picture();
  assert.equal(redraw.take(1016, 60_000).picture, true);
  redraw.data();
  assert.equal(redraw.take(61_016, 60_000).picture, true);
});

test("where nothing moves a picture has time, unless something does meanwhile", () => {
  const redraw = new Redraw(150);
  redraw.take(0, 0);
  redraw.data(false);
  assert.equal(redraw.take(100, 0).picture, false);
  assert.equal(redraw.take(400, 0).picture, true);
  redraw.data(false);
  redraw.data(true);
  redraw.data(false);
  assert.equal(redraw.take(416, 0).picture, true);
});

test("lists follow the picture, but not more often than they may", () => {
  const redraw = new Redraw(150);
  redraw.take(0, 0);
  redraw.data();
  assert.deepEqual(redraw.take(16, 0), { picture: true, lists: false });
  assert.deepEqual(redraw.take(100, 0), { picture: false, lists: false });
  assert.deepEqual(redraw.take(150, 0), { picture: false, lists: true });
});

test("a choice shows in the lists at once", () => {
  const redraw = new Redraw(150);
  redraw.take(0, 0);
  redraw.everything();

  assert.deepEqual(redraw.take(16, 0), { picture: true, lists: true });
});

test("the first picture with data in it does not wait for the interval", () => {
  const redraw = new Redraw(150);
  redraw.take(0, 60_000);
  redraw.nothingShown();
  redraw.data();

  assert.equal(redraw.take(16, 60_000).picture, true);
});
