import { describe, expect, it } from "vitest";
import { cornersText, cropHandles, cropOfRatio, cropText, movedCrop, pointsOf, shiftedCrop } from "./parts";
import { degreesOf, shareOf } from "./settings";

describe("parts of a picture", () => {
  it("are read in pixels and per cent", () => {
    expect(pointsOf("10%,5% 90%,95%", 2, 200, 100)).toEqual([
      { x: 20, y: 5 },
      { x: 180, y: 95 },
    ]);
    expect(pointsOf("1,2 3,4 5,6 7,8", 4, 9, 9)?.[3]).toEqual({ x: 7, y: 8 });
    expect(pointsOf("auto", 4, 9, 9)).toBeNull();
  });

  it("are written as they are read", () => {
    const text = cropText({ x: 180, y: 95 }, { x: 20, y: 5 }, 200, 100);
    expect(text).toBe("10%,5% 90%,95%");
    expect(cropText({ x: -4, y: 0 }, { x: 200, y: 120 }, 200, 100)).toBe("");
    expect(cornersText([{ x: 1.4, y: 2.6 }])).toBe("1,3");
  });

  it("move with the corner that is dragged", () => {
    const crop = [
      { x: 10, y: 10 },
      { x: 90, y: 80 },
    ];
    expect(movedCrop(crop, 1, { x: 70, y: 20 })).toEqual([
      { x: 10, y: 20 },
      { x: 70, y: 80 },
    ]);
    expect(cropHandles(crop)[3]).toEqual({ x: 10, y: 80 });
    // A corner does not leave the picture.
    expect(movedCrop(crop, 2, { x: 500, y: 90 }, null, { width: 100, height: 100 })[1]).toEqual({ x: 100, y: 90 });
  });

  it("keep a proportion with the opposite corner at rest", () => {
    const sides = { width: 100, height: 90 };
    const crop = [
      { x: 10, y: 10 },
      { x: 50, y: 70 },
    ];
    for (const [at, rest] of [
      [0, { x: 50, y: 70 }],
      [1, { x: 10, y: 70 }],
      [2, { x: 10, y: 10 }],
      [3, { x: 50, y: 10 }],
    ] as const) {
      for (const to of [
        { x: 33, y: 20 },
        { x: 99, y: 99 },
        { x: -20, y: 40 },
      ]) {
        const [first, last] = movedCrop(crop, at, to, 2 / 3, sides);
        if (first === undefined || last === undefined) throw new Error("two corners");
        expect((last.x - first.x) / (last.y - first.y)).toBeCloseTo(2 / 3);
        expect(cropHandles([first, last]).some(({ x, y }) => x === rest.x && y === rest.y)).toBe(true);
        for (const { x, y } of [first, last]) {
          expect(x).toBeGreaterThanOrEqual(-1e-9);
          expect(x).toBeLessThanOrEqual(100 + 1e-9);
          expect(y).toBeGreaterThanOrEqual(-1e-9);
          expect(y).toBeLessThanOrEqual(90 + 1e-9);
        }
      }
    }
  });

  it("move as they are, up to the edges of the picture", () => {
    const crop = [
      { x: 10, y: 10 },
      { x: 60, y: 40 },
    ];
    expect(shiftedCrop(crop, { x: 5, y: -4 }, { width: 100, height: 50 })).toEqual([
      { x: 15, y: 6 },
      { x: 65, y: 36 },
    ]);
    expect(shiftedCrop(crop, { x: 500, y: -400 }, { width: 100, height: 50 })).toEqual([
      { x: 50, y: 0 },
      { x: 100, y: 30 },
    ]);
  });

  it("get a proportion about their middle", () => {
    const wide = cropOfRatio(
      [
        { x: 0, y: 0 },
        { x: 90, y: 40 },
      ],
      0.5,
    );
    expect(wide).toEqual([
      { x: 35, y: 0 },
      { x: 55, y: 40 },
    ]);
  });
});

describe("values of a recipe", () => {
  it("are numbers or texts with units", () => {
    expect(shareOf("10%")).toBeCloseTo(0.1);
    expect(shareOf(0.25)).toBe(0.25);
    expect(shareOf(undefined)).toBe(0);
    expect(degreesOf("90deg")).toBe(90);
    expect(degreesOf(Math.PI)).toBeCloseTo(180);
  });
});
