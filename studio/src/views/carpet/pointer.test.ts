import { describe, expect, it } from "vitest";
import { chartPoint, type Grid, type Knot } from "./geometry";
import { areaEdits, editsOf, type Hand, pinched } from "./pointer";

const GRID: Grid = { rows: 100, columns: 80, aspect: 1 };
const SIZE = { width: 400, height: 300 };
const HAND: Hand = {
  tool: "pencil",
  yarn: "ivory",
  width: 1,
  symmetry: "none",
  mirror: "both",
  borderWidth: 4,
  tile: null,
};
const at = (line: number, column: number): Knot => ({ line, column });

describe("two fingers", () => {
  it("keep the chart between them", () => {
    const view = { x: 40, y: 50, scale: 8 };
    const before = chartPoint(view, GRID, SIZE, 150, 100);
    const moved = pinched(
      view,
      GRID,
      SIZE,
      [
        { x: 100, y: 100 },
        { x: 200, y: 100 },
      ],
      [
        { x: 120, y: 140 },
        { x: 320, y: 140 },
      ],
    );
    const after = chartPoint(moved, GRID, SIZE, 220, 140);
    expect(moved.scale).toBeCloseTo(16);
    expect(after.x).toBeCloseTo(before.x);
    expect(after.y).toBeCloseTo(before.y);
  });
});

describe("a stroke of a tool", () => {
  const points = [at(99, 0), at(99, 4)];
  it.each([
    ["pencil", ["line 1,1 1,5 ivory"]],
    ["line", ["line 1,1 1,5 ivory"]],
    ["fill", ["fill 1,5 ivory"]],
    ["mirror", ["mirror both in 1,1 1,5"]],
    ["border", ["border 4 ivory in 1,1 1,5"]],
    ["repeat", []],
    ["pan", []],
  ] as const)("%s", (tool, edits) => {
    expect(editsOf({ ...HAND, tool }, points, GRID)).toEqual(edits);
  });

  it("repeats a tile once it is chosen", () => {
    const hand: Hand = { ...HAND, tool: "repeat", tile: [at(99, 0), at(95, 4)] };
    expect(editsOf(hand, [at(80, 0), at(70, 9)], GRID)).toEqual(["repeat 1,1 5,5 in 20,1 30,10"]);
    expect(areaEdits(hand, null, GRID)).toEqual(["repeat 1,1 5,5"]);
  });

  it("is nothing where a part is a single knot", () => {
    expect(editsOf({ ...HAND, tool: "mirror" }, [at(1, 1)], GRID)).toEqual([]);
  });
});
