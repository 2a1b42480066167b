import { describe, expect, it } from "vitest";
import type { Grid, Knot } from "./geometry";
import { MOTIFS } from "./motifs";
import {
  mirrored,
  type Placing,
  pieceOf,
  pieceOfMotif,
  placeAbout,
  placingEdits,
  shownPiece,
  tileEntry,
  turned,
} from "./placing";
import type { Brush } from "./strokes";

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

const PEN: Brush = { yarn: "ivory", width: 1, symmetry: "none" };

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
    expect(placingEdits(HELD, at(0, 0), PEN, GRID)).toEqual(["copy 2,4 3,6 to 19,1"]);
    expect(placingEdits(turned(HELD), at(0, 9), PEN, GRID)).toEqual(["copy 2,4 3,6 to 18,10 turned 90deg"]);
    const move = { ...mirrored(turned(HELD)), kind: "move" as const };
    expect(placingEdits(move, at(0, 9), PEN, GRID)).toEqual([
      "move 2,4 3,6 to 18,10 turned 270deg mirrored across ivory",
    ]);
  });

  it("keeps its lower left knot on the carpet", () => {
    expect(placeAbout(at(10, 10), HELD, GRID)).toEqual(at(9, 9));
    expect(placeAbout(at(0, 0), HELD, GRID)).toEqual(at(-1, 0));
    expect(placeAbout(at(19, 29), HELD, GRID)).toEqual(at(18, 28));
    const tile: Placing = { ...HELD, kind: "tile" };
    expect(placeAbout(at(0, 0), tile, GRID)).toEqual(at(0, 0));
    expect(placeAbout(at(19, 29), tile, GRID)).toEqual(at(18, 27));
  });
});

describe("a motif", () => {
  const cells = ["#.", "##"];
  const held: Placing = { kind: "motif", piece: pieceOfMotif(cells, 1, "#102030"), mirrored: false, turned: 0 };

  it("is set in the yarn in hand, where it is drawn", () => {
    expect(placingEdits(held, at(4, 6), PEN, GRID)).toEqual(["set 16,7 15,7 15,8 ivory"]);
    expect(placingEdits(mirrored(held), at(4, 6), PEN, GRID)).toEqual(["set 16,8 15,7 15,8 ivory"]);
    expect(placingEdits(turned(held), at(4, 6), PEN, GRID)).toEqual(["set 16,7 16,8 15,7 ivory"]);
    expect([...held.piece.pixels.subarray(0, 8)]).toEqual([16, 32, 48, 255, 0, 0, 0, 0]);
  });

  it("is cut at the edges, and drawn with its images", () => {
    expect(placingEdits(held, at(-1, 29), PEN, GRID)).toEqual(["set 20,30 ivory"]);
    const edits = placingEdits(held, at(4, 6), { ...PEN, symmetry: "both" }, GRID);
    expect(edits).toEqual([
      "set 16,7 15,7 15,8 ivory",
      "set 16,24 15,24 15,23 ivory",
      "set 5,7 6,7 6,8 ivory",
      "set 5,24 6,24 6,23 ivory",
    ]);
  });

  it("has cells of any size", () => {
    const piece = pieceOfMotif(cells, 3, "#000000");
    expect([piece.columns, piece.rows]).toEqual([6, 6]);
    expect(placingEdits({ ...held, piece }, at(4, 6), PEN, GRID)[0]?.match(/,/g)).toHaveLength(27);
  });

  it("of the shelf has even rows of cells", () => {
    for (const [name, rows] of Object.entries(MOTIFS)) {
      expect(new Set(rows.map((row) => row.length)).size, name).toBe(1);
      expect(rows.join(""), name).toMatch(/^[.#]+$/);
      expect(rows.join("").replaceAll(".", "").length, name).toBeGreaterThan(60);
    }
  });
});

describe("a tile", () => {
  it("is an entry of the recipe at its lower left knot", () => {
    const { piece } = HELD;
    const tile: Placing = { kind: "tile", piece, picture: "pictures/gul.png", mirrored: false, turned: 0 };
    expect(tileEntry(tile, at(4, 6), GRID)).toEqual({ picture: "pictures/gul.png", position: [15, 7] });
    expect(tileEntry({ ...tile, transparent: "#ffffff" }, at(4, 6), GRID)).toEqual({
      picture: "pictures/gul.png",
      position: [15, 7],
      transparent: "#ffffff",
    });
  });
});
