import { describe, expect, it } from "vitest";
import type { Grid, Knot } from "./geometry";
import { borderEdit, fillEdit, lineEdit, lineKnots, mirrorEdit, repeatEdit, strokeEdits, strokeKnots } from "./strokes";

const GRID: Grid = { rows: 50, columns: 40, aspect: 1 };
const at = (line: number, column: number): Knot => ({ line, column });

describe("a line", () => {
  it("is that of the recipe", () => {
    // The example of `line_knots` in ilmek.carpet.recipe.edits.
    const line = lineKnots(at(0, 0), at(2, 4));
    expect(line.map((knot) => knot.line)).toEqual([0, 0, 1, 1, 2]);
    expect(line.map((knot) => knot.column)).toEqual([0, 1, 2, 3, 4]);
  });

  it("is the same from either end", () => {
    for (const [from, to] of [
      [at(3, 30), at(20, 2)],
      [at(0, 7), at(9, 7)],
      [at(5, 5), at(5, 5)],
    ] as const) {
      expect(lineKnots(to, from).reverse()).toEqual(lineKnots(from, to));
    }
  });
});

describe("a stroke", () => {
  it("has each knot once and no gaps", () => {
    const knots = strokeKnots([at(0, 0), at(0, 5), at(5, 5), at(0, 5)]);
    expect(knots).toHaveLength(11);
  });

  it("is a line where it is straight", () => {
    expect(strokeEdits([at(49, 0), at(49, 3), at(49, 9)], "madder red", GRID)).toEqual(["line 1,1 1,10 madder red"]);
  });

  it("is single knots where it is not", () => {
    expect(strokeEdits([at(49, 0), at(49, 1), at(48, 1)], "ivory", GRID)).toEqual(["set 1,1 1,2 2,2 ivory"]);
    expect(strokeEdits([at(0, 39)], "ivory", GRID)).toEqual(["set 50,40 ivory"]);
    expect(strokeEdits([], "ivory", GRID)).toEqual([]);
  });

  it("is cut before a text gets too long", () => {
    const points = Array.from({ length: 400 }, (_, number) => at(number % 2 ? 0 : 49, Math.floor(number / 10)));
    const edits = strokeEdits(points, "ivory", GRID);
    expect(edits.length).toBeGreaterThan(1);
    expect(Math.max(...edits.map((edit) => edit.length))).toBeLessThan(1000);
    const count = edits.join(" ").match(/\d+,\d+/g)?.length;
    expect(count).toBe(strokeKnots(points).length);
  });
});

describe("edits of areas", () => {
  it("act on the carpet or on a part", () => {
    const part = [at(49, 0), at(40, 9)] as const;
    expect(mirrorEdit("both", null, GRID)).toBe("mirror both");
    expect(mirrorEdit("across", part, GRID)).toBe("mirror across in 1,1 10,10");
    expect(borderEdit(3, "ivory", part, GRID)).toBe("border 3 ivory in 1,1 10,10");
    expect(repeatEdit(part, null, GRID)).toBe("repeat 1,1 10,10");
    expect(fillEdit(at(0, 0), "ivory", GRID)).toBe("fill 50,1 ivory");
    expect(lineEdit(at(0, 0), at(49, 39), "ivory", GRID)).toBe("line 50,1 1,40 ivory");
  });
});
