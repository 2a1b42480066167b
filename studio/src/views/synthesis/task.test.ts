import { describe, expect, it } from "vitest";
import { fitted, gridLines, niceStep, snapped, toPlane, toScreen, zoomed } from "./camera";
import { dragged, handleAt, handlesOf, nearest, nearTurn, nudged, poseAt, type Scene, withCorner } from "./handles";
import { nextPoint } from "./points-table";
import {
  pointsOf,
  readBounds,
  readList,
  readRegion,
  rectangle,
  withPoints,
  withSetting,
  writeBounds,
  writeList,
  writeRegion,
} from "./task";

const mm = ["mm", "mm"];

describe("lists of a task", () => {
  it("reads units, zeros and spaces", () => {
    expect(readList("(20mm, 1 cm) (0,-5mm);(0.1m,2e1mm)", mm)).toEqual([
      [0.02, 0.01],
      [0, -0.005],
      [0.1, 0.02],
    ]);
  });
  it("refuses what is no list", () => {
    for (const text of ["(1mm)", "(1mm,2kg)", "1mm,2mm", "(1mm,2mm) x", "(1mm,2mm,3mm)"]) {
      expect(readList(text, mm)).toBeNull();
    }
  });
  it("writes what it reads", () => {
    const rows = [
      [0.0205, -0.01],
      [0, 0.123456],
    ];
    expect(readList(writeList(rows, mm), mm)?.flat()).toEqual(rows.flat().map((value) => expect.closeTo(value, 12)));
    expect(writeList([[0.02, 0.005, Math.PI / 6]], ["mm", "mm", "deg"])).toBe("(20mm,5mm,30deg)");
  });
  it("keeps all other settings when points change", () => {
    const data = { machine: "path-four-bar", settings: { points: "(1mm,2mm)", closed: "yes" } };
    const next = withPoints(data, [{ x: 0.001, y: 0.003 }]);
    expect(next.settings).toEqual({ points: "(1mm,3mm)", closed: "yes" });
    expect(pointsOf(next)).toEqual([{ x: 0.001, y: 0.003 }]);
    expect(withSetting(next, "closed", undefined).settings).toEqual({ points: "(1mm,3mm)" });
  });
  it("sorts the samples of a function and takes the defaults of a machine", () => {
    const data = { machine: "function-four-bar", settings: {} };
    const points = [
      { x: 2, y: 1 },
      { x: 1, y: 0 },
    ];
    expect(withPoints(data, points).settings).toEqual({ samples: "(1,0) (2,1)" });
    expect(pointsOf({ machine: "motion-four-bar" })).toHaveLength(3);
    expect(pointsOf({ machine: "beat-up" })).toBeNull();
  });
});

describe("regions and bounds", () => {
  it("reads two corners as a rectangle and writes it so", () => {
    const region = readRegion("(30mm,-60mm) (60mm,-30mm)");
    expect(region).toHaveLength(4);
    expect(writeRegion(region ?? [])).toBe("(30mm,-60mm) (60mm,-30mm)");
    expect(readRegion("(0,0) (1mm,0) (0,1mm)")).toHaveLength(3);
    expect(readRegion("(0,0)")).toBeNull();
  });
  it("keeps a rectangle upright when a corner is dragged", () => {
    const region = withCorner(rectangle({ x: 0, y: 0 }, { x: 2, y: 1 }), 2, { x: 5, y: 4 });
    expect(region).toEqual(rectangle({ x: 0, y: 0 }, { x: 5, y: 4 }));
  });
  it("moves one corner of a polygon alone", () => {
    const triangle = [
      { x: 0, y: 0 },
      { x: 1, y: 0 },
      { x: 0, y: 1 },
    ];
    expect(withCorner(triangle, 1, { x: 3, y: 3 })).toEqual([triangle[0], { x: 3, y: 3 }, triangle[2]]);
  });
  it("reads open bounds", () => {
    expect(readBounds("-20mm..60mm", "mm")).toEqual([-0.02, 0.06]);
    expect(readBounds("..0mm", "mm")).toEqual([Number.NEGATIVE_INFINITY, 0]);
    expect(readBounds("5mm", "mm")).toEqual([0.005, 0.005]);
    expect(readBounds("1mm..2mm..3mm", "mm")).toBeNull();
    expect(writeBounds([-0.02, Number.POSITIVE_INFINITY], "mm")).toBe("-20mm..");
  });
});

describe("the camera", () => {
  const size = { width: 400, height: 300 };
  it("shows all points, and goes to the screen and back", () => {
    const points = [
      { x: -0.05, y: 0 },
      { x: 0.05, y: 0.02 },
    ];
    const camera = fitted(points, size, 40);
    for (const point of points) {
      const at = toScreen(camera, point);
      expect(at.x).toBeGreaterThanOrEqual(39.9);
      expect(at.x).toBeLessThanOrEqual(360.1);
      expect(toPlane(camera, at).x).toBeCloseTo(point.x, 12);
    }
    const about = { x: 10, y: 20 };
    expect(toPlane(zoomed(camera, 2, about), about).y).toBeCloseTo(toPlane(camera, about).y, 12);
  });
  it("rounds to steps that people read", () => {
    expect([0.7, 3, 45].map(niceStep)).toEqual([0.5, 2, 20]);
    expect(snapped(0.12345, 0.0005)).toBe(0.1235);
    expect(gridLines(-0.1, 0.1, 5)).toEqual([-0.1, -0.05, 0, 0.05, 0.1]);
  });
});

describe("handles", () => {
  const scene: Scene = {
    points: [
      { x: 0, y: 0, angle: 0 },
      { x: 0.05, y: 0, angle: Math.PI / 2 },
    ],
    regions: { keepOut: rectangle({ x: 0, y: -0.05 }, { x: 0.02, y: -0.03 }) },
  };
  const camera = fitted([...scene.points, { x: 0, y: -0.05 }], { width: 600, height: 400 });
  it("finds the nearest one", () => {
    expect(handlesOf(scene)).toHaveLength(8);
    for (const handle of handlesOf(scene)) {
      expect(nearest(scene, camera, handleAt(scene, camera, handle) ?? { x: 0, y: 0 }, 5)).toEqual(handle);
    }
    expect(nearest(scene, camera, { x: 1, y: 1 }, 5)).toBeNull();
  });
  it("drags a point to a round place and a direction to a whole degree", () => {
    const moved = dragged(scene, camera, { kind: "point", index: 0 }, toScreen(camera, { x: 0.0101, y: 0.0099 }));
    expect(moved.points[0]?.x).toBe(0.01);
    const at = toScreen(camera, { x: 0, y: 0 });
    const turned = dragged(scene, camera, { kind: "angle", index: 0 }, { x: at.x + 30, y: at.y - 30 });
    expect(turned.points[0]?.angle).toBeCloseTo(Math.PI / 4, 12);
  });
  it("turns over half a turn without a jump", () => {
    expect(nearTurn(-3, 3)).toBeCloseTo(-3 + 2 * Math.PI, 12);
  });
  it("moves by arrow keys, farther with Shift, and not by others", () => {
    const by = (key: string, shift = false) =>
      nudged(scene, camera, { kind: "point", index: 0 }, key, shift)?.points[0]?.x ?? null;
    expect(by("Enter")).toBeNull();
    expect(by("ArrowRight", true)).toBeCloseTo(10 * (by("ArrowRight") ?? 0), 12);
    const turned = nudged(scene, camera, { kind: "angle", index: 0 }, "ArrowUp", false);
    expect(turned?.points[0]?.angle).toBeCloseTo(Math.PI / 180, 12);
  });
  it("a pose that is clicked has the direction of the way to it, without a jump", () => {
    expect(poseAt([], { x: 1, y: 2 })).toEqual({ x: 1, y: 2, angle: 0 });
    expect(poseAt([{ x: 0, y: 0, angle: 0 }], { x: 1, y: 1 }).angle).toBeCloseTo(Math.PI / 4, 12);
    expect(poseAt([{ x: 0, y: 0, angle: 3 }], { x: -1, y: -0.01 }).angle).toBeCloseTo((181 * Math.PI) / 180, 12);
  });
  it("adds poses that are turned", () => {
    const first = nextPoint("motion-four-bar", []);
    const second = nextPoint("motion-four-bar", [first]);
    const third = nextPoint("motion-four-bar", [first, second]);
    expect(new Set([first.angle, second.angle, third.angle]).size).toBe(3);
  });
  it("adds a point beyond the last one", () => {
    expect(
      nextPoint("path-four-bar", [
        { x: 0, y: 0 },
        { x: 1, y: 1 },
      ]),
    ).toEqual({ x: 2, y: 2 });
    expect(nextPoint("motion-four-bar", [])).toEqual({ x: 0, y: 0, angle: 0 });
  });
});
