import { expect, test } from "vitest";
import type { Effect, ShownCheck } from "../../api/messages";
import { barsOf, lengthOf, turning } from "./effects";

function effect(check: string, change: number, more: Partial<Effect> = {}): Effect {
  return {
    check,
    machine: "",
    change,
    relative: change,
    ok: true,
    after: true,
    turns_at: null,
    turns_text: "",
    ...more,
  };
}

function check(name: string, relation: string, limit: number): ShownCheck {
  return {
    name,
    machine: "",
    ok: true,
    value: 1,
    limit,
    relation,
    value_text: "1",
    limit_text: String(limit),
    ratio: 1 / limit,
    source: "",
    cure: "",
  };
}

const CHECKS = [check("stress", "<=", 2), check("safety", ">=", 0.5), check("room", ">=", -1)];

test("more of what must stay below its limit harms, more of what must stay above helps", () => {
  const better = (name: string, change: number) => barsOf([effect(name, change)], CHECKS)[0]?.better;
  expect(better("stress", 0.01)).toBe(false);
  expect(better("stress", -0.01)).toBe(true);
  expect(better("safety", 0.01)).toBe(true);
  expect(better("room", 0.01)).toBe(false);
  expect(better("unknown", 0.01)).toBe(null);
});

test("lengths rise with the size, and are never invisible", () => {
  const lengths = [1e-9, 1e-4, 1e-3, 1e-2, 1e-1, 10].map(lengthOf);
  expect(lengths).toEqual([...lengths].sort((a, b) => a - b));
  expect(lengths[0]).toBeGreaterThan(0);
  expect(lengths.at(-1)).toBe(1);
  expect(lengthOf(-1e-2)).toBe(lengthOf(1e-2));
});

test("what turns a check is found among the effects", () => {
  const effects = [
    effect("a", 1),
    effect("b", 1, { turns_at: 2, turns_text: "2 mm" }),
    effect("c", 1, { after: false }),
  ];
  expect(turning(effects).map((one) => one.check)).toEqual(["b", "c"]);
});
