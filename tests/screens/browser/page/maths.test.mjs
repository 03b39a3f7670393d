import assert from "node:assert/strict";
import { test } from "node:test";
import { compose, IDENTITY, invert, known, normalized, rotate, rpy } from "../../../../tftool/screens/browser/page/maths.js";
import { number } from "../../../../tftool/screens/browser/page/format.js";

const HALF = Math.SQRT1_2;
const QUARTER_TURN = [1, 2, 3, 0, 0, HALF, HALF]; // 90 degrees about z
const TILTED = normalized([-1, 0.5, 2, 0.1, -0.3, 0.2, 0.9]);

function near(found, wanted) {
  wanted.forEach((value, at) => assert.ok(Math.abs(found[at] - value) < 1e-12, `${found} is not ${wanted}`));
}

test("a quarter turn takes x to y", () => near(rotate(QUARTER_TURN, 1, 0, 0), [0, 1, 0]));

test("an inverse undoes, on either side", () => {
  near(compose(TILTED, invert(TILTED)), IDENTITY);
  near(compose(invert(TILTED), TILTED), IDENTITY);
});

test("chains associate", () => {
  near(compose(compose(QUARTER_TURN, TILTED), QUARTER_TURN), compose(QUARTER_TURN, compose(TILTED, QUARTER_TURN)));
});

test("a transform moves points as it composes", () => {
  near(compose(QUARTER_TURN, [1, 0, 0, 0, 0, 0, 1]), [1, 3, 3, 0, 0, HALF, HALF]);
});

test("angles are those of fixed axes, and straight up all of the turn is called roll", () => {
  near(rpy(QUARTER_TURN), [0, 0, Math.PI / 2]);
  near(rpy([0, 0, 0, 0, HALF, 0, HALF]), [0, Math.PI / 2, 0]);
});

test("what is NaN, infinite or beyond all measure is not known", () => {
  assert.ok(known(TILTED));
  assert.ok(!known(null));
  assert.ok(!known([Number.NaN, 0, 0, 0, 0, 0, 1]));
  assert.ok(!known([Infinity, 0, 0, 0, 0, 0, 1]));
});

test("numbers have no minus before zero, and a dash where they are not known", () => {
  assert.equal(number(-0.00001, 2), "0.00");
  assert.equal(number(-1.005, 1), "-1.0");
  assert.equal(number(null, 2), "–");
  assert.equal(number(12_345_678, 2), "1.235e+7");
});
