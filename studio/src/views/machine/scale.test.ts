import { expect, test } from "vitest";
import { readQuantity } from "../../ui/units";
import { onScale, positionOf, STEPS, scaleAround, textAt, valueAt } from "./scale";

const mm = 1e-3;
const deg = Math.PI / 180;

test("a length with wide bounds gets a logarithmic window around its value", () => {
  const scale = scaleAround(300 * mm, { at_least: 0.1 * mm, at_most: 100 }, "mm");
  expect(scale).toMatchObject({ log: true, low: 75 * mm, high: 1200 * mm });
  expect(valueAt(STEPS / 2, scale)).toBeCloseTo(300 * mm, 12);
});

test("angles and shares are covered as a whole, linear", () => {
  expect(scaleAround(0, { at_least: 0, at_most: 2 * Math.PI }, "deg")).toMatchObject({
    low: 0,
    high: 2 * Math.PI,
    log: false,
  });
  expect(scaleAround(0.05, { at_least: 0.0001, at_most: 1 }, "")).toMatchObject({ low: 0.0001, high: 1, log: false });
});

test("a value of 0 gets a linear window of ten units within its bounds", () => {
  expect(scaleAround(0, { at_least: 0, at_most: 1000 }, "m/s^2")).toMatchObject({ low: 0, high: 10, log: false });
  expect(scaleAround(0, { at_least: -1, at_most: 1 }, "mm")).toMatchObject({ low: -10 * mm, high: 10 * mm });
});

test("excluded bounds are never reached", () => {
  const bounds = { above: 0, below: Math.PI };
  const scale = scaleAround(30 * deg, bounds, "deg");
  expect(scale.low).toBeGreaterThan(0);
  expect(scale.high).toBeLessThan(Math.PI);
  for (const position of [0, 1, STEPS])
    expect(readable(textAt(position, scale, "deg", bounds), "deg")).toBeGreaterThan(0);
});

test("whole numbers stay whole and within their bounds", () => {
  const scale = scaleAround(3, { at_least: 1, at_most: 1000 }, "", true);
  expect(scale).toMatchObject({ low: 1, high: 12, whole: true });
  for (let at = 0; at <= STEPS; at += 17) expect(Number.isInteger(valueAt(at, scale))).toBe(true);
});

test("position and value are each other's inverse", () => {
  for (const value of [2, 60, 900].map((one) => one * mm)) {
    const scale = scaleAround(60 * mm, { at_least: mm, at_most: 100 }, "mm");
    if (onScale(value, scale)) expect(valueAt(positionOf(value, scale), scale)).toBeCloseTo(value, 12);
  }
  expect(onScale(2 * mm, scaleAround(60 * mm, { at_least: mm, at_most: 100 }, "mm"))).toBe(false);
});

test("texts rise with the position, in few digits", () => {
  const bounds = { at_least: 0.1 * mm, at_most: 100 };
  const scale = scaleAround(300 * mm, bounds, "mm");
  const texts = Array.from({ length: STEPS + 1 }, (_, at) => textAt(at, scale, "mm", bounds));
  const values = texts.map((text) => readable(text, "mm"));
  expect(values.every((value, at) => at === 0 || value > (values[at - 1] ?? Infinity))).toBe(true);
  expect(Math.max(...texts.map((text) => text.length))).toBeLessThanOrEqual("300.25mm".length);
});

function readable(text: string, unit: string): number {
  const read = readQuantity(text, unit);
  return "si" in read ? read.si : Number.NaN;
}
