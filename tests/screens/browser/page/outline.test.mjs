import assert from "node:assert/strict";
import { test } from "node:test";
import { kept, led, listed } from "../../../../tftool/screens/browser/page/outline.js";

// 0 ─ 1 ─ 2, 0 ─ 3; 4 and 5 hang from each other.
const forest = { parents: [-1, 0, 1, 0, 5, 4], children: [[1, 3], [2], [], [], [5], [4]], order: [0, 1, 3, 2], roots: [0], looped: [4, 5] };

test("frames are listed from top to bottom, and a loop but once", () => {
  assert.deepEqual(listed(forest).map(({ index }) => index), [0, 1, 2, 3, 4, 5]);
  assert.deepEqual(listed(forest).map(({ level }) => level), [1, 2, 3, 2, 1, 2]);
});

test("a chain of many thousand frames is listed", () => {
  const many = 50_000;
  const children = Array.from({ length: many }, (_, index) => (index + 1 < many ? [index + 1] : []));
  assert.equal(listed({ ...forest, children, looped: [] }).at(-1).level, many);
});

test("a filter keeps what matches and what is above it", () => {
  assert.deepEqual([...kept(forest, (index) => index === 2)].sort(), [0, 1, 2]);
  assert.deepEqual([...kept(forest, (index) => index === 4)].sort(), [4, 5]);
  assert.equal(kept(forest, () => false).size, 0);
});

test("keys lead through the list as through any tree", () => {
  const list = { visible: [0, 1, 2, 3], parents: forest.parents, opened: (index) => (forest.children[index].length ? true : null) };
  assert.deepEqual(led("ArrowDown", 0, list), { go: 1 });
  assert.deepEqual(led("ArrowUp", 0, list), { go: 0 });
  assert.deepEqual(led("End", 0, list), { go: 3 });
  assert.deepEqual(led("ArrowLeft", 1, list), { open: false });
  assert.deepEqual(led("ArrowLeft", 2, list), { go: 1 });
  assert.deepEqual(led("ArrowRight", 1, { ...list, opened: () => false }), { open: true });
  assert.deepEqual(led("ArrowRight", 1, list), { go: 2 });
  assert.deepEqual(led("ArrowRight", 3, list), {});
  assert.equal(led("x", 0, list), null);
});
