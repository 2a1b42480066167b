import { expect, it } from "vitest";
import { spacingOf, strideFor, thinned } from "./crowd";

const matrices = new Float32Array(16 * 9);
for (let k = 0; k < 9; k++) matrices.set([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, k, 0, 0, 1], 16 * k);

it("neighbours nearer than some pixels are drawn as one, an odd number of them", () => {
  expect(spacingOf(matrices, 9)).toBe(1);
  expect(strideFor(1, 0.1)).toBe(1);
  expect([0.25, 0.5, 0.9, 2.5].map((pixel) => strideFor(1, pixel))).toEqual([1, 3, 5, 11]);
});

it("each stands in the middle of its neighbours and is as wide; those out of the picture are left out", () => {
  const into = new Float32Array(16 * 9);
  expect(thinned(matrices, 9, 3, false, into, (x) => x < 5)).toBe(2);
  expect([into[12], into[28], into[0], into[16], into[5]]).toEqual([1, 4, 3, 3, 1]);
  expect(thinned(matrices, 9, 3, true, into, (x) => x < 5)).toBe(2);
  expect([into[12], into[28]]).toEqual([4, 1]);
});

it("copies in several rows, or one over the other, are no row across", () => {
  const rows = matrices.slice();
  for (let k = 0; k < 9; k++) rows[16 * k + 12] = k % 3;
  expect(spacingOf(rows, 9)).toBe(Number.POSITIVE_INFINITY);
  for (let k = 0; k < 9; k++) rows[16 * k + 12] = 2;
  expect(spacingOf(rows, 9)).toBe(Number.POSITIVE_INFINITY);
});
