import { describe, expect, it } from "vitest";
import { anchored, placedLines, withAnchor, withLines, withoutLine } from "./edit-lines";

const TABLE = { on: "carpet", grid: "80x120", lines: ["fill 1,1 ivory", "mirror both"] };
const RECIPE = { edits: ["set 1,1 camel", TABLE, "replace ivory by camel"] };

const linesOf = (recipe: object | null) => placedLines(recipe).map(({ line }) => line);

describe("edits", () => {
  it("are lines, and lines of tables", () => {
    expect(linesOf(RECIPE)).toEqual(["set 1,1 camel", "fill 1,1 ivory", "mirror both", "replace ivory by camel"]);
    for (const recipe of [null, {}, { edits: "set 1,1 camel" }]) expect(linesOf(recipe)).toEqual([]);
  });

  it("get lines behind the last one, in a table of their grid where tables are", () => {
    expect(withLines({}, ["mirror both"], "80x120")).toEqual(["mirror both"]);
    expect(withLines({ edits: [TABLE] }, ["repeat 1,1 2,2"], "80x120")).toEqual([
      { ...TABLE, lines: [...TABLE.lines, "repeat 1,1 2,2"] },
    ]);
    const other = { on: "carpet", grid: "40x60", lines: ["repeat 1,1 2,2"] };
    expect(withLines({ edits: [TABLE] }, ["repeat 1,1 2,2"], "40x60")).toEqual([TABLE, other]);
    const motif = { ...TABLE, on: "motif 1" };
    expect(withLines({ edits: [motif] }, ["mirror both"], "80x120")).toEqual([
      motif,
      { on: "carpet", grid: "80x120", lines: ["mirror both"] },
    ]);
  });

  it("state the grid on which they were made, in their order", () => {
    expect(anchored({ edits: ["set 1,1 camel", "mirror both"] }, "80x120")).toEqual([
      { on: "carpet", grid: "80x120", lines: ["set 1,1 camel", "mirror both"] },
    ]);
    expect(linesOf({ edits: anchored(RECIPE, "40x60") })).toEqual(linesOf(RECIPE));
    expect(anchored(RECIPE, "40x60")?.[1]).toEqual(TABLE);
    expect(anchored({ edits: [TABLE] }, "40x60")).toEqual([TABLE]);
    expect(anchored({}, "40x60")).toBeNull();
  });

  it("are on something else one by one, in their order and on the grid that they state", () => {
    linesOf(RECIPE).forEach((_, number) => {
      const moved = { edits: withAnchor(RECIPE, number, "knots", "40x60") };
      expect(linesOf(moved)).toEqual(linesOf(RECIPE));
      expect(placedLines(moved).map(({ on }) => on === "knots")).toEqual(linesOf(RECIPE).map((_, at) => at === number));
    });
    expect(withAnchor(RECIPE, 0, "knots", "40x60")[0]).toEqual({
      on: "knots",
      grid: "40x60",
      lines: ["set 1,1 camel"],
    });
    const split = [
      { ...TABLE, on: "knots", lines: ["fill 1,1 ivory"] },
      { ...TABLE, lines: ["mirror both"] },
    ];
    expect(withAnchor({ edits: [TABLE] }, 0, "knots", "40x60")).toEqual(split);
    expect(withAnchor({ edits: split }, 0, "carpet", "40x60")).toEqual([TABLE]);
    const sized = { on: "carpet", size: "2x3m", lines: ["mirror both"] };
    expect(withAnchor({ edits: [sized] }, 0, "knots", "40x60")).toEqual([{ ...sized, on: "knots" }]);
  });

  it("lose a line by its number, and a table with its last line", () => {
    linesOf(RECIPE).forEach((_, number) => {
      const left = withoutLine(RECIPE, number);
      expect(linesOf({ edits: left })).toEqual(linesOf(RECIPE).filter((_, at) => at !== number));
    });
    expect(withoutLine({ edits: [{ ...TABLE, lines: ["mirror both"] }] }, 0)).toBeNull();
  });
});
