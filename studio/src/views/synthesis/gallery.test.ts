import { describe, expect, it } from "vitest";
import type { ShownFourBar, SynthesisAnswer } from "../../api/messages";
import { fitted } from "./camera";
import { indexAt, linkPaths, pinsAt, reach } from "./drawing";
import { accepted, NO_FILTER, ordered } from "./filter";
import { generatedRow, requiredRow, samplesOf, valueAt } from "./function-scene";
import { errorText, meritText } from "./gallery";

function fourBar(number: number, more: Partial<ShownFourBar> = {}): ShownFourBar {
  const pins = { a0: [0, 0], b0: [4, 0], a: [1, 0], b: [3, 3] };
  const motion = { a: [1, 0, 0, 1, -1, 0, 0, -1], b: [3, 3, 3, 4, 3, 3, 3, 2], p: [], closed: true };
  const made = {
    number,
    pins,
    motion,
    curve: [],
    crank_turns: true,
    certified: false,
    transmission: 0.5,
    size: 0.2,
    error_max: number,
  };
  return { ...made, ...more } as unknown as ShownFourBar;
}

describe("numbers of the gallery", () => {
  it("are no powers of ten", () => {
    for (const size of [1, 1e-3, 1e-5, 1e-8, 3e-12]) {
      expect(meritText(size)).not.toMatch(/e/i);
      expect(errorText(fourBar(1, { error_max: size }))).not.toMatch(/\de/i);
      expect(errorText(fourBar(1, { error_max: size, function: {} as never }))).not.toMatch(/\de/i);
    }
    expect([meritText(0.4567), meritText(1.28e-6)]).toEqual(["0.457", "< 0.001"]);
    expect(errorText(fourBar(1, { error_max: 2e-8 }))).toBe("< 0.001 mm");
    expect(errorText(fourBar(1, { error_max: 1.5e-4 }))).toBe("0.15 mm");
  });
});

describe("a four-bar in motion", () => {
  it("goes round where its motion is closed, there and back where it is not", () => {
    const one = fourBar(1);
    expect(indexAt(one.motion, 0.25)).toBe(1);
    expect(indexAt({ ...one.motion, closed: false }, 0.5)).toBe(3);
    expect(indexAt({ ...one.motion, closed: false }, 0.75)).toBeCloseTo(1.5, 12);
    expect(pinsAt(one, 0.125).a).toEqual({ x: 0.5, y: 0.5 });
    expect(pinsAt(one, 0.9999).a.x).toBeCloseTo(1, 2);
  });
  it("is drawn by three links within its reach", () => {
    const one = fourBar(1);
    const camera = fitted(reach(one), { width: 100, height: 100 }, 5);
    const paths = linkPaths(camera, pinsAt(one, 0));
    expect(paths.crank).toMatch(/^M[\d.]+ [\d.]+L[\d.]+ [\d.]+$/);
    expect(paths.coupler).not.toContain("Z");
  });
});

describe("the gallery", () => {
  const all = [
    fourBar(1),
    fourBar(2, { size: 0.1, error_max: 0.5 }),
    fourBar(3, { crank_turns: false, transmission: 1 }),
  ];
  it("filters by typed limits", () => {
    const shown = (more: object) =>
      all.filter((one) => accepted(one, { ...NO_FILTER, ...more })).map((one) => one.number);
    expect(shown({})).toEqual([1, 2, 3]);
    expect(shown({ size: "150mm" })).toEqual([2]);
    expect(shown({ transmission: "40deg" })).toEqual([3]);
    expect(shown({ turns: true })).toEqual([1, 2]);
    expect(shown({ certified: true })).toEqual([]);
  });
  it("orders by error, angle and size", () => {
    expect(ordered(all, "error").map((one) => one.number)).toEqual([2, 1, 3]);
    expect(ordered(all, "transmission").map((one) => one.number)).toEqual([3, 1, 2]);
    expect(ordered(all, "size")[0]?.number).toBe(2);
  });
});

describe("a function", () => {
  const answer = {
    required: [
      [0, 1, 2],
      [0, 0.1, 0.4],
    ],
  } as unknown as SynthesisAnswer;
  it("is drawn in degrees, or in the numbers of its samples", () => {
    expect(requiredRow(answer, [])[5]).toBeCloseTo((0.4 * 180) / Math.PI, 9);
    const points = [
      { x: 0, y: 10 },
      { x: 2, y: 50 },
    ];
    expect(requiredRow(answer, points)).toEqual([0, 10, 1, 20, 2, 50]);
    const one = fourBar(1, { function: { x: [0, 2], generated: [0, 0.2] } as never });
    expect(generatedRow(answer, one, points)).toEqual([0, 10, 2, 30]);
  });
  it("becomes samples that can be dragged", () => {
    expect(samplesOf(answer, 3).map((one) => one.x)).toEqual([0, 1, 2]);
    expect(
      valueAt(
        [
          { x: 2, y: 4 },
          { x: 0, y: 0 },
        ],
        0.5,
      ),
    ).toBe(1);
  });
});
