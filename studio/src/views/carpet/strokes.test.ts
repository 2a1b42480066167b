import { describe, expect, it } from "vitest";
import type { Grid, Knot } from "./geometry";
import { type Brush, borderEdit, fillEdits, lineKnots, mirrorEdit, repeatEdit, strokeEdits } from "./strokes";
import { brushSpans, imagesOf, SYMMETRIES } from "./symmetry";

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

const PEN: Brush = { yarn: "ivory", width: 1, symmetry: "none" };

/** The knots that edits give a yarn, as the recipe reads them, in order of lines and columns. */
function drawn(edits: readonly string[]): string[] {
  const knots = new Set<string>();
  for (const edit of edits) {
    const points = [...edit.matchAll(/(\d+),(\d+)/g)].map((pair) =>
      at(GRID.rows - Number(pair[1]), Number(pair[2]) - 1),
    );
    const width = Number(/^stroke (\d+)/.exec(edit)?.[1] ?? 1);
    const paths = edit.startsWith("set") ? points.map((point) => [point]) : [points];
    for (const path of paths)
      path.forEach((point, number) => {
        for (const knot of lineKnots(path[number - 1] ?? point, point))
          for (const { line, column, length } of brushSpans(knot, width, GRID))
            for (let more = 0; more < length; more += 1) knots.add(`${line},${column + more}`);
      });
  }
  return [...knots].sort();
}

describe("a stroke", () => {
  it("is a line where it is straight", () => {
    expect(strokeEdits([at(49, 0), at(49, 3), at(49, 9)], PEN, GRID)).toEqual(["line 1,1 1,10 ivory"]);
  });

  it("is single knots where it is not", () => {
    expect(strokeEdits([at(49, 0), at(49, 1), at(48, 1)], PEN, GRID)).toEqual(["set 1,1 1,2 2,2 ivory"]);
    expect(strokeEdits([at(0, 39)], PEN, GRID)).toEqual(["set 50,40 ivory"]);
    expect(strokeEdits([], PEN, GRID)).toEqual([]);
  });

  it("is cut before a text gets too long, and has each knot", () => {
    const points = Array.from({ length: 400 }, (_, number) => at(number % 2 ? 0 : 49, Math.floor(number / 10)));
    const expected = new Set(
      points.flatMap((point, number) =>
        lineKnots(points[number - 1] ?? point, point).map((knot) => `${knot.line},${knot.column}`),
      ),
    );
    const edits = strokeEdits(points, PEN, GRID);
    expect(edits.length).toBeGreaterThan(1);
    expect(Math.max(...edits.map((edit) => edit.length))).toBeLessThan(1000);
    expect(drawn(edits)).toEqual([...expected].sort());
    const wide = strokeEdits(points, { ...PEN, width: 3 }, GRID);
    expect(wide.length).toBeGreaterThan(1);
    expect(Math.max(...wide.map((edit) => edit.length))).toBeLessThan(1000);
    const covered = new Set(drawn(wide));
    expect([...expected].filter((knot) => !covered.has(knot))).toEqual([]);
  });

  it("of a brush names the knots where its direction changes", () => {
    const points = [at(40, 4), at(40, 9), at(35, 14), at(35, 14)];
    expect(strokeEdits(points, { ...PEN, width: 5 }, GRID)).toEqual(["stroke 5 10,5 10,10 15,15 ivory"]);
    expect(strokeEdits([at(40, 4)], { ...PEN, width: 3 }, GRID)).toEqual(["stroke 3 10,5 ivory"]);
  });

  it("is drawn with all its images, knot by knot", () => {
    for (const symmetry of SYMMETRIES)
      for (const width of [1, 3, 9])
        for (const points of [[at(3, 2), at(9, 17), at(12, 18), at(1, 30)], [at(0, 0), at(7, 19)], [at(20, 5)]]) {
          const own = drawn(strokeEdits(points, { ...PEN, width }, GRID)).map((text) => text.split(",").map(Number));
          const knots = own.map(([line, column]) => at(line ?? 0, column ?? 0));
          const expected = imagesOf(knots, symmetry, GRID)
            .flat()
            .map(({ line, column }) => `${line},${column}`);
          expect(drawn(strokeEdits(points, { ...PEN, width, symmetry }, GRID))).toEqual([...new Set(expected)].sort());
        }
  });

  it("fills the images too, each once", () => {
    const hand: Brush = { ...PEN, symmetry: "both" };
    expect(fillEdits(at(0, 0), hand, GRID)).toEqual([
      "fill 50,1 ivory",
      "fill 50,40 ivory",
      "fill 1,1 ivory",
      "fill 1,40 ivory",
    ]);
    const odd = { ...GRID, rows: 9, columns: 9 };
    expect(fillEdits(at(4, 4), hand, odd)).toEqual(["fill 5,5 ivory"]);
  });
});

describe("a brush", () => {
  it("is the disc of the recipe", () => {
    // As the doctest of `brush_spans` in ilmek.carpet.recipe.copies.
    expect(brushSpans(at(20, 20), 5, GRID).map(({ length }) => length)).toEqual([3, 5, 5, 5, 3]);
    expect(brushSpans(at(0, 0), 5, GRID).reduce((sum, { length }) => sum + length, 0)).toBe(8);
  });
});

describe("edits of areas", () => {
  it("act on the carpet or on a part", () => {
    const part = [at(49, 0), at(40, 9)] as const;
    expect(mirrorEdit("both", null, GRID)).toBe("mirror both");
    expect(mirrorEdit("across", part, GRID)).toBe("mirror across in 1,1 10,10");
    expect(borderEdit(3, "ivory", part, GRID)).toBe("border 3 ivory in 1,1 10,10");
    expect(repeatEdit(part, null, GRID)).toBe("repeat 1,1 10,10");
  });
});
