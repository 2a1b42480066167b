import { describe, expect, it } from "vitest";
import {
  fitted,
  fromScreen,
  gridStep,
  hull,
  isInside,
  segmentDistance,
  snap,
  toLocal,
  toScreen,
  toWorld,
  vec,
  zoomed,
} from "./geometry";

const size = { width: 800, height: 600 };

describe("geometry of the drawing", () => {
  it("maps between a body's frame and the world", () => {
    const pose = { x: 1, y: 2, angle: Math.PI / 2 };
    const world = toWorld(pose, vec(3, 0));
    expect(world.x).toBeCloseTo(1);
    expect(world.y).toBeCloseTo(5);
    expect(toLocal(pose, world).x).toBeCloseTo(3);
  });

  it("snaps to points before directions before the grid", () => {
    const points = [{ name: "A", at: vec(0.1, 0.1) }];
    const options = { grid: 0.01, reach: 0.004, points };
    expect(snap(vec(0.102, 0.101), options)).toEqual({ at: vec(0.1, 0.1), to: "point", name: "A" });
    expect(snap(vec(0.0513, 0.0009), { ...options, from: vec(0, 0) })).toEqual({ at: vec(0.05, 0), to: "angle" });
    expect(snap(vec(0.0513, 0.0209), { ...options, from: vec(0, 0) })).toEqual({ at: vec(0.05, 0.02), to: "grid" });
    expect(snap(vec(0.0513, 0.02), { ...options, grid: 0 }).to).toBe("free");
    const diagonal = snap(vec(0.0301, 0.0299), { ...options, from: vec(0, 0) });
    expect(diagonal.to).toBe("angle");
    expect(diagonal.at.x).toBeCloseTo(diagonal.at.y, 12);
  });

  it("keeps the position under the pointer while zooming", () => {
    const camera = { centre: vec(0.1, 0.2), scale: 1000 };
    const pointer = vec(700, 100);
    const at = fromScreen(camera, size, pointer);
    const near = zoomed(camera, size, 1.7, pointer);
    expect(toScreen(near, size, at).x).toBeCloseTo(700);
    expect(toScreen(near, size, at).y).toBeCloseTo(100);
  });

  it("shows all points, and an empty drawing at a useful scale", () => {
    const camera = fitted([vec(0, 0), vec(0.4, 0.1), vec(Number.NaN, 0)], size);
    expect(toScreen(camera, size, vec(0.4, 0.1)).x).toBeLessThanOrEqual(800 - 47);
    expect(fitted([], size).scale).toBeGreaterThan(100);
  });

  it("measures distances and outlines", () => {
    expect(segmentDistance(vec(0.5, 1), vec(0, 0), vec(1, 0))).toBe(1);
    expect(segmentDistance(vec(3, 4), vec(0, 0), vec(0, 0))).toBe(5);
    const corners = hull([vec(0, 0), vec(1, 0), vec(0.4, 0.3), vec(0, 1)]);
    expect(corners).toHaveLength(3);
    expect(isInside(vec(0.2, 0.2), corners)).toBe(true);
    expect(isInside(vec(0.9, 0.9), corners)).toBe(false);
  });

  it("chooses grids of 1, 2 or 5", () => {
    expect(gridStep(1500)).toBe(0.01);
    expect(gridStep(4000)).toBe(0.005);
    expect(gridStep(400)).toBe(0.05);
  });
});
