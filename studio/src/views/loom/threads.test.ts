import { expect, it } from "vitest";
import { ribbons } from "./threads";

it("threads beside each other have the same segments, with four corners each", () => {
  const made = ribbons([-1, 1], 2);
  const values = (name: string) => [...made.getAttribute(name).array].filter((_, k) => k % 4 === 0);
  expect(values("shift")).toEqual([-1, -1, 1, 1]);
  expect(values("segment")).toEqual([0, 1, 0, 1]);
  expect(Math.max(...(made.getIndex()?.array ?? []))).toBe(4 * 4 - 1);
});
