import { describe, expect, it } from "vitest";
import type { Grid, Knot } from "./geometry";
import { mirrored, type Placing, pieceOf, placeAbout, placingEdit, shownPiece, turned } from "./placing";

const GRID: Grid = { rows: 20, columns: 30, aspect: 1 };
const at = (line: number, column: number): Knot => ({ line, column });
const KNOTS = Uint8Array.from({ length: 600 }, (_, number) => number % 7);
const COLOURS = ["#000000", "#000001", "#000002", "#000003", "#000004", "#000005", "#000006"];

const FROM = [at(18, 3), at(17, 5)] as const;
const HELD: Placing = {
  kind: "copy",
  piece: pieceOf(KNOTS, GRID, FROM, COLOURS),
  from: FROM,
  mirrored: false,
  turned: 0,
};

/** The yarns of a piece, row by row: the blue of its pixels. */
function yarns(placing: Placing): number[][] {
  const { columns, rows, pixels } = shownPiece(placing);
  return Array.from({ length: rows }, (_, row) =>
    Array.from({ length: columns }, (_, column) => pixels[4 * (row * columns + column) + 2] ?? -1),
  );
}

describe("a part that is held", () => {
  it("shows its knots", () => {
    expect(yarns(HELD)).toEqual([
      [2, 3, 4],
      [4, 5, 6],
    ]);
  });

  it("is turned clockwise, four times to itself", () => {
    // As the doctest of `transformed` in ilmek.carpet.recipe.copies.
    expect(yarns(turned(mirrored(HELD)))).toEqual([
      [6, 4],
      [5, 3],
      [4, 2],
    ]);
    expect(yarns(turned(turned(turned(turned(HELD)))))).toEqual(yarns(HELD));
  });

  it("is reflected as it is seen, however it is turned", () => {
    let placing = HELD;
    for (let quarter = 0; quarter < 4; quarter += 1) {
      expect(yarns(mirrored(placing))).toEqual(yarns(placing).map((row) => [...row].reverse()));
      expect(yarns(mirrored(mirrored(placing)))).toEqual(yarns(placing));
      placing = turned(placing);
    }
  });

  it("is an edit of its corners and its lower left knot", () => {
    expect(placingEdit(HELD, at(0, 0), "ivory", GRID)).toBe("copy 2,4 3,6 to 19,1");
    expect(placingEdit(turned(HELD), at(0, 9), "ivory", GRID)).toBe("copy 2,4 3,6 to 18,10 turned 90deg");
    const move = { ...mirrored(turned(HELD)), kind: "move" as const };
    expect(placingEdit(move, at(0, 9), "ivory", GRID)).toBe(
      "move 2,4 3,6 to 18,10 turned 270deg mirrored across ivory",
    );
  });

  it("keeps its lower left knot on the carpet", () => {
    const { piece } = HELD;
    expect(placeAbout(at(10, 10), piece, GRID)).toEqual(at(9, 9));
    expect(placeAbout(at(0, 0), piece, GRID)).toEqual(at(-1, 0));
    expect(placeAbout(at(19, 29), piece, GRID)).toEqual(at(18, 28));
  });
});
