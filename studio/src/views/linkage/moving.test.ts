import { describe, expect, it } from "vitest";
import type { Figure } from "./figure";
import { STILL, vec } from "./geometry";
import type { MechanismData } from "./mechanism";
import { connected, endOfSide, shiftBodies, sidesOf } from "./moving";

describe("bodies moved as a whole", () => {
  const data: MechanismData = {
    bodies: {
      ground: { points: { A: [0, 0], B: ["apart", "1mm"], C: { radius: "30mm", angle: 0 } } },
      bar: { points: { D: ["10mm", 0], E: { offset: [0, "5mm"], from: "D" } }, centre: ["4mm", "1mm"] },
      link: { length: "9mm" },
    },
    joints: { A: { pin: ["ground", "link"] }, D: { pin: ["bar", "plate", "arm"] } },
  };
  const drawn = (name: string, points: Record<string, [number, number]>) => ({
    name,
    points: Object.entries(points).map(([point, [x, y]]) => ({ body: name, name: point, at: vec(x, y) })),
    outline: [],
    solved: false,
  });

  it("shifts coordinates in the frame of each body, expressions too, and leaves points that follow others", () => {
    const own = structuredClone(data);
    const figure = {
      poses: { ground: STILL, bar: { x: 0, y: 0, angle: Math.PI / 2 } },
      bodies: [drawn("ground", { A: [0, 0], C: [0.03, 0] }), drawn("bar", { D: [0, 0.01] })],
    } as unknown as Figure;
    shiftBodies(own, ["ground", "bar", "link"], vec(0.002, 0), figure);
    const points = own.bodies?.["ground"]?.points;
    expect(points).toEqual({ A: ["2mm", 0], B: ["apart + 2mm", "1mm"], C: ["32mm", 0] });
    expect(own.bodies?.["bar"]).toEqual({
      points: { D: ["10mm", "-2mm"], E: { offset: [0, "5mm"], from: "D" } },
      centre: ["4mm", "-1mm"],
    });
    expect(own.bodies?.["link"]).toEqual({ length: "9mm" });
  });

  it("finds what is joined, and whether the ground is", () => {
    expect(connected(data, "bar")).toEqual({ bodies: ["bar", "plate", "arm"], grounded: false });
    expect(connected(data, "link")).toEqual({ bodies: ["link"], grounded: true });
  });

  it("sets a side of a body to a length", () => {
    const points = { A: vec(0, 0), B: vec(0.03, 0.04), C: vec(0.03, 0) };
    const sides = sidesOf(points);
    expect(sides.map((side) => `${side.from}${side.to} ${side.length.toFixed(3)}`)).toEqual([
      "AB 0.050",
      "AC 0.030",
      "BC 0.040",
    ]);
    const at = endOfSide(points, sides[0] as (typeof sides)[0], 0.1);
    expect([at.x, at.y]).toEqual([0.06, 0.08]);
    expect(sidesOf({ ...points, D: vec(0, 0) }).map((side) => side.to)).toEqual(["B", "C", "D"]);
  });
});
