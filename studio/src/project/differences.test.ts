import { describe, expect, it } from "vitest";
import { differences, isSame } from "./differences";

describe("differences", () => {
  it("names the innermost values, entries of lists from 1", () => {
    const mine = { size: "60x90cm", border: [{ width: 3 }, { width: 4 }], same: { a: [1] } };
    const theirs = { border: [{ width: 3 }, { width: 5 }], same: { a: [1] }, colours: 8 };
    expect(differences(mine, theirs)).toEqual([
      { path: "size", mine: "60x90cm", theirs: "" },
      { path: "border.2.width", mine: "4", theirs: "5" },
      { path: "colours", mine: "", theirs: "8" },
    ]);
  });

  it("are none between equal data, whatever the order of keys", () => {
    expect(isSame({ a: 1, b: [true, { c: null }] }, { b: [true, { c: null }], a: 1 })).toBe(true);
    expect([isSame([], {}), isSame({ a: 1 }, { a: "1" }), isSame({ a: undefined }, {})]).toEqual([false, false, false]);
  });
});
