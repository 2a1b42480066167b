import { describe, expect, it } from "vitest";
import type { RowRun } from "../../api/messages";
import { namesOf } from "./model";
import { cellsOf, countText, isRightward, positionOf } from "./weaver";
import { isLight } from "./yarns";

const RUN: RowRun = { first: 1, cells: 4, knots: 4, yarn: 0, mark: 0, second: 0 };

describe("the weaver's position", () => {
  it("is remembered as a text", () => {
    expect(positionOf("12 3 left")).toEqual({ row: 12, run: 3, direction: "left" });
    expect(positionOf(null)).toEqual({ row: 1, run: 0, direction: "alternate" });
    expect(positionOf("-4 x up")).toEqual({ row: 1, run: 0, direction: "alternate" });
  });

  it("is read to and fro", () => {
    expect([1, 2, 3].map((row) => isRightward(row, "alternate"))).toEqual([true, false, true]);
    expect(isRightward(2, "right")).toBe(true);
    expect(isRightward(1, "left")).toBe(false);
  });

  it("counts cells in the direction of reading", () => {
    expect(cellsOf({ ...RUN, first: 3 }, { columns: 10 }, true)).toEqual({ first: 3, last: 6 });
    expect(cellsOf({ ...RUN, first: 3 }, { columns: 10 }, false)).toEqual({ first: 5, last: 8 });
  });

  it("counts knots as they are called", () => {
    expect(countText(RUN)).toBe("4");
    expect(countText({ ...RUN, knots: 2, mark: 1 })).toBe("2½");
    expect(countText({ ...RUN, knots: 2, mark: 2 })).toBe("2j");
  });
});

describe("yarns of a recipe", () => {
  it("are a list or a text", () => {
    expect(namesOf(["ivory", "rose"])).toEqual(["ivory", "rose"]);
    expect(namesOf('ivory; "No. 7, blue", rose')).toEqual(["ivory", "No. 7, blue", "rose"]);
    expect(namesOf(undefined)).toEqual([]);
  });

  it("have letters that stand out", () => {
    expect(isLight("#f5efe0")).toBe(true);
    expect(isLight("#1f2440")).toBe(false);
  });
});
