import { describe, expect, it } from "vitest";
import { asKind, type Border, bordersOf, draggedWidth, kindOf, movedBorder, reachesOf } from "./borders";
import type { Grid } from "./geometry";

const GRID: Grid = { rows: 60, columns: 40, aspect: 1 };
const BORDERS: readonly Border[] = [
  { yarn: "ivory", width: 2 },
  { teeth: ["ivory", "dark red"], width: 4 },
  { tile: "pictures/gul.png", width: 6, corner: "pictures/corner.png" },
];

describe("borders", () => {
  it("are the entries of the recipe", () => {
    expect(bordersOf({ border: BORDERS })).toEqual(BORDERS);
    for (const recipe of [null, {}, { border: "ivory" }]) expect(bordersOf(recipe)).toEqual([]);
    expect(BORDERS.map(kindOf)).toEqual(["stripe", "teeth", "tile"]);
  });

  it("change their kind and keep their width", () => {
    const yarns = ["camel", "gold"];
    expect(asKind({ yarn: "ivory", width: 2 }, "teeth", yarns, [])).toEqual({ width: 2, teeth: ["ivory", "gold"] });
    expect(asKind({ teeth: ["rose", "gold"], width: 2 }, "stripe", yarns, [])).toEqual({ width: 2, yarn: "rose" });
    expect(asKind({ yarn: "ivory", width: 2 }, "tile", yarns, ["a.png"])).toEqual({
      width: 2,
      tile: "a.png",
      adjust: true,
    });
  });

  it("change places", () => {
    const [one, two, three] = BORDERS;
    expect(movedBorder(BORDERS, 2, 0)).toEqual([three, one, two]);
    expect(movedBorder(BORDERS, 0, 1)).toEqual([two, one, three]);
  });

  it("lie one inside the other, up to one whose width the tile decides", () => {
    expect(reachesOf(BORDERS).map(({ begin }) => begin)).toEqual([0, 2, 6]);
    expect(reachesOf([{ yarn: "ivory", width: 2 }, { tile: "a.png" }, { yarn: "ivory", width: 1 }])).toHaveLength(1);
    expect(reachesOf([{ yarn: "ivory", width: "3cm" }])).toEqual([]);
  });

  it("are dragged by their inner edge, and leave some of the field", () => {
    expect(draggedWidth(BORDERS, 1, 9.4, GRID)).toBe(7);
    expect(draggedWidth(BORDERS, 1, -3, GRID)).toBe(1);
    // 40 columns: 19 knots of borders at most on a side, of which the others have 8.
    expect(draggedWidth(BORDERS, 1, 39, GRID)).toBe(11);
  });
});
