import { expect, test } from "vitest";
import type { Figure } from "./figure";
import { forcesOf } from "./loads";
import { type MechanismData, setForce } from "./mechanism";

const point = { body: "ram", name: "B", at: { x: 1, y: 2 } };
const figure: Figure = {
  poses: { ram: { x: 1, y: 2, angle: Math.PI / 6 } },
  bodies: [{ name: "ram", points: [point], outline: [], solved: true }],
  joints: [],
  points: [point],
  closes: true,
};
const data = {
  loads: {
    plain: { force: "3kN", direction: "-90deg", on: ["ram", "B"] },
    parts: { force: ["3N", "4N"], on: ["ram", "B"] },
    turned: { force: 5, direction: "30deg", frame: "body", on: ["ram", "B"] },
    table: { force: 5, table: [], on: ["ram", "B"] },
    torque: { torque: "1N*m", on: "ram" },
  },
} as unknown as MechanismData;

test("forces of constant size stand at their points, in the direction of their frame", () => {
  const found = forcesOf(data, figure).map(({ name, at, size, turn }) => [name, at, size, (turn * 180) / Math.PI]);
  expect(found[0]).toEqual(["plain", point.at, 3000, -90]);
  expect(found[1]?.slice(0, 3)).toEqual(["parts", point.at, 5]);
  expect(found[1]?.[3]).toBeCloseTo(53.130102, 6);
  expect(found[2]?.[3]).toBeCloseTo(60, 9);
  expect(found.length).toBe(3);
});

test("a force that is dragged is written as size and direction, and read as these", () => {
  const copy = structuredClone(data);
  setForce(copy, "parts", 12.3456, Math.PI / 4);
  expect(copy["loads"]).toMatchObject({ parts: { force: "12.3N", direction: "45deg" } });
  const [, now] = forcesOf(copy, figure);
  expect([now?.size, now?.turn]).toEqual([12.3, Math.PI / 4]);
});
