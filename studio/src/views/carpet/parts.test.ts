import { describe, expect, it } from "vitest";
import { cornersText, cropHandles, cropText, movedCrop, pointsOf } from "./parts";
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
