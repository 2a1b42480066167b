import { expect, it } from "vitest";
import { Pace } from "./pace";

/** Draws pictures at an interval, each wanted at once after the one before. */
function drawn(pace: Pace, begin: number, interval: number, count: number): number[] {
  return Array.from({ length: count }, (_, k) => {
    pace.wanted(begin + k * interval + 1);
    return pace.drawn(begin + (k + 1) * interval);
  });
}

it("a motion that falls behind is drawn coarser, a still picture fine", () => {
  const pace = new Pace();
  pace.wanted(0);
  expect(pace.drawn(0)).toBe(1);
  expect(drawn(pace, 0, 100, 5)).toEqual([0.7, 0.5, 0.35, 0.35, 0.35]);
  pace.wanted(900);
  expect(pace.drawn(900)).toBe(1);
});

it("a motion that is quick for long is drawn finer again", () => {
  const pace = new Pace();
  pace.drawn(0);
  drawn(pace, 0, 100, 2);
  const shares = drawn(pace, 200, 10, 45);
  expect(shares[0]).toBe(0.5);
  expect(shares[44]).toBe(1);
  expect(drawn(pace, 650, 30, 3)).toEqual([1, 1, 1]);
});
