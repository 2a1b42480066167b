import { describe, expect, it } from "vitest";
import type { Grid } from "./geometry";
import { countOf, foundSpecks, speckEdits, speckPath } from "./specks";

const GRID: Grid = { rows: 4, columns: 5, aspect: 1 };

/** Specks as the server packs them: knots of 4 bytes, then a byte each. */
function packed(places: readonly number[], around: readonly number[]) {
  const buffer = new ArrayBuffer(5 * places.length);
  const view = new DataView(buffer);
  places.forEach((place, at) => {
    view.setUint32(4 * at, place, true);
    view.setUint8(4 * places.length + at, around[at] ?? 0);
  });
  const parts = (lengths: readonly number[]) => {
    let from = 0;
    return lengths.map((length) => {
      from += length;
      return new Uint8Array(buffer, from - length, length);
    });
  };
  const about = { sizes: [2, 1], knots: places.length, yarns: ["ivory", "madder red"] };
  return foundSpecks({ about, parts });
}

describe("specks", () => {
  const three = packed([0, 19, 7, 300], [1, 0, 1, 1]);

  it("are read as they are packed", () => {
    expect([...three.places]).toEqual([0, 19, 7, 300]);
    expect([...three.around]).toEqual([1, 0, 1, 1]);
    expect(countOf(three)).toBe(3);
  });

  it("get the yarn around them, an edit for each yarn", () => {
    const two = packed([0, 19, 7], [1, 0, 1]);
    expect(speckEdits(two, GRID)).toEqual(["set 4,1 3,3 madder red", "set 1,5 ivory"]);
  });

  it("are marked where they are seen", () => {
    const size = { width: 100, height: 100 };
    const path = speckPath(three, GRID, { x: 2.5, y: 2, scale: 10 }, size);
    // Knot 0 has its upper left corner 25 px left of the middle and 20 px above it; 300 lies far below.
    expect(path.match(/M/g)).toHaveLength(3);
    expect(path).toContain("M25.0 30.0h10v10h-10Z");
  });
});
