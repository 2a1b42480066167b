import * as three from "three";
import { expect, test } from "vitest";
import { distanceText, Measure, snapped } from "./measure";

test("a distance is that of Pythagoras, in millimetres with its shares", () => {
  expect(distanceText([0, 0, 0], [0.003, 0.004, 0.012])).toBe("13 mm: across 3, up 4, to the front 12");
  expect(distanceText([0.01, 0, 0], [0, 0, 0])).toMatch(/across [-−]10/);
});

test("a corner is taken where it is near in the picture, else the point that was pressed", () => {
  const [point, corner] = [new three.Vector3(0, 0, 0), new three.Vector3(0.004, 0, 0)];
  const far = new three.Vector3(0.006, 0, 0);
  expect(snapped(point, [far, corner], 0.001)).toEqual(corner);
  expect(snapped(point, [far, corner], 0.0001)).toEqual(point);
});

test("the third press begins a new measurement", () => {
  const measure = new Measure();
  expect(measure.label()).toBeNull();
  measure.take(new three.Vector3());
  expect(measure.line.visible).toBe(false);
  measure.take(new three.Vector3(0, 0.1, 0));
  expect(measure.line.visible).toBe(true);
  expect(measure.label()?.text).toContain("100 mm");
  measure.take(new three.Vector3());
  expect(measure.line.visible).toBe(false);
  measure.clear();
  expect(measure.label()).toBeNull();
});
