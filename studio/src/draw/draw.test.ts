import { describe, expect, it } from "vitest";
import { greatestOf, isAngle, keyed, keyStep, quiet, valueAt, within } from "./cursor";
import { anchorsOf } from "./drawing";
import type { ShownAnimation } from "./figures";
import { dashesOf, markerOf } from "./looks";
import { between, frameAt, phaseAt, rangeOf, reachOf, shapeAt, shareAt } from "./motion";
import { mixed } from "./strokes";
import { roomy, roundStep, spanOf, ticks } from "./ticks";
import { mapOf, viewKeyed, WHOLE, zoomed } from "./viewport";

const DEGREE = Math.PI / 180;

describe("ticks", () => {
  it("are round numbers within the span", () => {
    expect(ticks({ low: 0, high: 10 }, "mm", 5)).toEqual([0, 2, 4, 6, 8, 10]);
    expect(ticks({ low: -0.3, high: 0.32 }, "", 6)).toEqual([-0.2, 0, 0.2]);
    expect(roundStep(0.21)).toBeCloseTo(0.25, 12);
    expect(roundStep(51)).toBe(100);
  });
  it("of angles are those of a protractor", () => {
    expect(ticks({ low: 0, high: 360 }, "deg", 9)).toEqual([0, 45, 90, 135, 180, 225, 270, 315, 360]);
    expect(ticks({ low: 0, high: 360 }, "deg", 4)).toEqual([0, 90, 180, 270, 360]);
  });
  it("span of nothing, and of one value, is not empty", () => {
    expect(spanOf([[]])).toEqual({ low: 0, high: 1 });
    expect(spanOf([[2, null, 2]])).toEqual({ low: 1.8, high: 2.2 });
    expect(spanOf([[null, 3, -1]])).toEqual({ low: -1, high: 3 });
  });
  it("room reaches a tick where it is near", () => {
    expect(roomy({ low: 0, high: 9.7 }, "mm", 5)).toEqual({ low: 0, high: 10 });
    expect(roomy({ low: 0.4, high: 8.1 }, "mm", 5).high).toBeCloseTo(8.408, 9);
  });
});

describe("the shared cursor", () => {
  it("takes an angle a turn off, and nothing else out of range", () => {
    expect(within(370 * DEGREE, 0, 2 * Math.PI, true)).toBeCloseTo(10 * DEGREE, 12);
    expect(within(-10 * DEGREE, 0, 2 * Math.PI, true)).toBeCloseTo(350 * DEGREE, 12);
    expect(within(2 * Math.PI, 0, 2 * Math.PI, true)).toBe(2 * Math.PI);
    expect(within(1.2, 0, 1, false)).toBeNull();
    expect(within(90 * DEGREE, 0, 30 * DEGREE, true)).toBeNull();
    expect(isAngle("deg") && !isAngle("s")).toBe(true);
  });
  it("moves by keys: whole degrees, or round steps of the unit", () => {
    expect(keyStep(0, 2 * Math.PI, "deg")).toBeCloseTo(DEGREE, 12);
    expect(keyStep(0, 0.12, "mm")).toBeCloseTo(0.001, 12);
    const press = (key: string, more = {}) => new KeyboardEvent("keydown", { key, ...more });
    expect(keyed(press("ArrowRight"), 0, 0, 2 * Math.PI, "deg")).toBeCloseTo(DEGREE, 12);
    expect(keyed(press("ArrowRight", { shiftKey: true }), 0, 0, 2 * Math.PI, "deg")).toBeCloseTo(10 * DEGREE, 12);
    expect(keyed(press("End"), 1, 0, 5, "s")).toBe(5);
    expect(keyed(press("ArrowLeft"), 0, 0, 5, "s")).toBe(0);
    expect(keyed(press("Escape"), 1, 0, 5, "s")).toBeNull();
    expect(keyed(press("a"), 1, 0, 5, "s")).toBeUndefined();
    expect(keyed(press("ArrowLeft", { altKey: true }), 1, 0, 5, "s")).toBeUndefined();
  });
  it("reads curves between their samples, not in gaps", () => {
    expect(valueAt([0, 1, 2], [0, 10, 30], 1.5)).toBe(20);
    expect(valueAt([2, 1, 0], [30, 10, 0], 1.5)).toBe(20);
    expect(valueAt([0, 1, 2], [0, null, 30], 1.5)).toBeNull();
    expect(valueAt([0, 1], [0, 1], 1.5)).toBeNull();
  });
  it("shows rounding noise beside the greatest of the figure as 0", () => {
    const greatest = greatestOf([
      [1, null, -20],
      [1e-18, 0],
    ]);
    expect([quiet(1.48e-20, greatest), quiet(1e-3, greatest), quiet(2, 0)]).toEqual([0, 1e-3, 2]);
    expect(valueAt([], [], 1)).toBeNull();
  });
});

const CRANK: ShownAnimation = {
  still: {
    name: "",
    title: "",
    note: "",
    strokes: [],
    dots: [{ at: [0, 0], label: "A", role: "pivot", along: [1, 0] }],
    unit: "mm",
  },
  drive: { label: "crank angle", unit: "deg" },
  at: [0, 90 * DEGREE, 180 * DEGREE, 270 * DEGREE],
  tracks: [
    [0, 0, 0, 0, 0, 0, 0, 0],
    [1, 0, 0, 1, -1, 0, 0, -1],
  ],
  shapes: [{ tracks: [0, 1], shape: [], role: "link", label: "crank", closed: false, look: 0 }],
  points: [],
  readings: [{ label: "height", unit: "m", values: [0, 1, 0, -1] }],
  closes: true,
  start: 0,
  period: null,
};

describe("motion", () => {
  it("goes on from the last frame to the first where it closes", () => {
    expect(rangeOf(CRANK).high).toBeCloseTo(2 * Math.PI, 12);
    expect(frameAt(CRANK, 315 * DEGREE)).toBeCloseTo(3.5, 12);
    expect(between([0, 1, 0, -1], 3.5, 4, 1, 0)).toBe(-0.5);
    expect(frameAt({ ...CRANK, closes: false }, 270 * DEGREE)).toBeCloseTo(3, 12);
  });
  it("places points, and turns rigid shapes with their direction", () => {
    const map = { scale: 100, x0: 0, y0: 0 };
    const [bar] = CRANK.shapes;
    if (bar === undefined) throw new Error("no bar");
    expect([...shapeAt(CRANK, bar, 1, map)].map(Math.round)).toEqual([0, 0, 0, -100]);
    const square = { ...bar, shape: [0, 0, 0.5, 0, 0.5, 0.5] };
    expect([...shapeAt(CRANK, square, 1, map)].map((one) => Math.round(one) + 0)).toEqual([0, 0, 0, -50, -50, -50]);
  });
  it("reaches what it passes through", () => {
    expect(reachOf(CRANK)).toEqual({ left: -1, right: 1, low: -1, high: 1 });
  });
  it("phase and share are each other's inverse", () => {
    for (const one of [CRANK, { ...CRANK, closes: false }]) {
      for (const share of [0, 0.2, 0.7]) expect(shareAt(one, phaseAt(one, share))).toBeCloseTo(share, 12);
    }
  });
});

describe("a drawing", () => {
  it("is to scale, in the middle of its stage", () => {
    const map = mapOf({ left: 0, right: 2, low: 0, high: 1 }, WHOLE, 460, 474);
    expect(map.scale).toBe(200);
    expect([map.x0 + 1 * map.scale, map.y0 - 0.5 * map.scale]).toEqual([230, 230]);
  });
  it("keeps the point under the pointer as it zooms, and shows all again", () => {
    const view = zoomed(WHOLE, 2, 0.25, 0);
    expect(view).toEqual({ zoom: 2, x: -0.25, y: 0 });
    expect(zoomed(view, 0.1)).toEqual(WHOLE);
    expect(viewKeyed("0", view)).toEqual(WHOLE);
    expect(viewKeyed("ArrowLeft", WHOLE)).toEqual({ zoom: 1, x: 0.1, y: 0 });
    expect(viewKeyed("x", WHOLE)).toBeUndefined();
  });
  it("has names at the middle of lines first", () => {
    expect(anchorsOf(Float64Array.of(0, 0, 10, 0, 10, 10))[0]).toEqual([10, 0]);
  });
  it("mixes colours, short or long", () => {
    expect(mixed("#000000", "#fff", 0.5)).toBe("rgb(128 128 128)");
  });
});

describe("looks", () => {
  it("of one colour differ in dashes and marker", () => {
    expect(dashesOf(0)).toEqual([]);
    expect(dashesOf(8)).not.toEqual([]);
    expect(dashesOf(0, true)).not.toEqual([]);
    expect(markerOf(0)).not.toEqual(markerOf(8));
  });
});
