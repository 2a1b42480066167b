import { expect, test } from "vitest";
import { wanted } from "./wish";

test("results that are to be small or large are goals, others are only seen", () => {
  const wishes = new Map([
    ["torque", "least"],
    ["stroke", "most"],
    ["mass", "shown"],
  ] as const);
  expect(wanted(wishes)).toEqual({ goals: ["torque", "most stroke"], record: ["mass"] });
});
