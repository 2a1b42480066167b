import { describe, expect, it } from "vitest";
import type { MechanismAnswer, MotionAnswer } from "../../api/messages";
import { arrowPath, greatest } from "./arrows";
import { plotOf } from "./curve";
import { bodiesAt, figureAt, hitAt, nearestSolved, sampleAt, valueNear, wrapped } from "./figure";
import { vec } from "./geometry";
import { inFrame } from "./pointer";

const motion: MotionAnswer = {
  driving: "crank",
  kind: "rotation",
  values: [0, 1, 2, 3],
  speed: 1,
  status: [0, 0, 1, 1],
  fault: { given: "cannot close", allowed: "", do: "" },
  poses: { crank: { x: [0, 0, 0, 0], y: [0, 0, 0, 0], angle: [0, 1, null, null] } },
  points: { crank: { A: { x: [1, 0.54, null, null], y: [0, 0.84, null, null] } } },
  transmission: {},
  closing: [[0, 1.5]],
  dead_centres: [],
  change_points: [],
  rates: {},
  forces: null,
  no_forces: "",
};

const answer: MechanismAnswer = {
  name: "crank",
  bodies: [
    { name: "ground", points: { O: [0, 0] }, solved: true },
    { name: "crank", points: { O: [0, 0], A: [0.1, 0] }, solved: true },
    { name: "rod", points: { A: [0.1, 0], B: [0.2, 0.1], C: [0.1, 0.1] }, solved: false },
  ],
  joints: [
    { name: "O", file_joint: "O", kind: "pin", bodies: ["ground", "crank"], along: 0, turned: 0 },
    { name: "A", file_joint: "A", kind: "pin", bodies: ["crank", "rod"], along: 0, turned: 0 },
  ],
  couplings: [],
  inputs: [{ name: "crank", joint: "O", kind: "rotation" }],
  structure: { degrees_of_freedom: 2, driven: 1, loops: 0, groups: [], left: ["rod"], loose: [], missing: null },
  poses: { rod: [0, 0, 0] },
  motion,
  no_motion: null,
  changes: [],
  values: {},
  refused: null,
};

describe("the figure at a value of the drive", () => {
  it("lies between two samples", () => {
    expect(sampleAt(motion.values, 0.25)).toEqual({ index: 0, share: 0.25 });
    expect(sampleAt([3, 2, 1], 1.5)).toEqual({ index: 1, share: 0.5 });
    expect(sampleAt([5], 1)).toEqual({ index: 0, share: 0 });
    expect(figureAt(answer, 0.5).poses["crank"]?.angle).toBeCloseTo(0.5);
  });

  it("is drawn up to where it fails", () => {
    expect(figureAt(answer, 0.5).closes).toBe(true);
    const failing = figureAt(answer, 2.6);
    expect(failing.closes).toBe(false);
    expect(failing.poses["crank"]?.angle).toBe(1);
    expect(nearestSolved({ ...motion, status: [1, 1, 1, 1] }, { index: 1, share: 0 })).toBeUndefined();
  });

  it("takes whole turns off a turning drive", () => {
    const turn = { ...motion, values: [0, Math.PI, 2 * Math.PI] };
    expect(wrapped(turn, -0.5)).toBeCloseTo(2 * Math.PI - 0.5);
    expect(wrapped(turn, 7)).toBeCloseTo(7 - 2 * Math.PI);
    expect(wrapped(turn, 2 * Math.PI)).toBeCloseTo(2 * Math.PI);
    expect(wrapped({ ...turn, kind: "displacement" }, -0.5)).toBe(-0.5);
  });

  it("hits joints before points before bodies", () => {
    const figure = figureAt(answer, 0);
    expect(hitAt(figure, vec(0.101, 0), 0.01)).toMatchObject({ kind: "joint", name: "A" });
    expect(hitAt(figure, vec(0.2, 0.099), 0.01)).toMatchObject({ kind: "point", body: "rod", name: "B" });
    expect(hitAt(figure, vec(0.05, 0.002), 0.01)).toEqual({ kind: "body", name: "crank" });
    expect(hitAt(figure, vec(0.12, 0.08), 0.001)).toEqual({ kind: "body", name: "rod" });
    expect(hitAt(figure, vec(0.5, 0.5), 0.01)).toBeUndefined();
    expect(bodiesAt(figure, vec(0.1, 0.002), 0.01)).toEqual(["rod", "crank"]);
  });

  it("chooses what lies whole in a frame", () => {
    const chosen = inFrame(figureAt(answer, 0), { from: vec(-0.01, 0.01), to: vec(0.11, -0.01) });
    expect(chosen.bodies).toEqual(["crank"]);
    expect(chosen.joints).toEqual(["O", "A"]);
  });
});

describe("curves and arrows", () => {
  it("have a limit across and the dead centres as marks", () => {
    const dead = { ...motion, dead_centres: [{ value: 1.5, bodies: ["coupler", "rocker"] }] };
    const plot = plotOf(dead, "angle", "deg", { B: [1, 1, null, null] }, { value: 0.7, label: "usual" });
    expect(plot.x).toEqual({ label: "crank", unit: "deg" });
    expect(plot.series.map((curve) => [curve.label, curve.y])).toEqual([
      ["B", [1, 1, null, null]],
      ["usual", [0.7, 0.7]],
    ]);
    expect(plot.marks).toEqual([{ x: 1.5, label: "coupler, rocker" }]);
    expect(plotOf(dead, "angle", "deg", {}, { value: 0.7, label: "usual" }).series).toEqual([]);
  });

  it("have the scale of the greatest of all samples, and no head without a shaft", () => {
    expect(greatest([{ x: [3, null], y: [4, 1] }])).toBe(5);
    expect(arrowPath(vec(0, 0), vec(1, 1))).toBe("");
    expect(arrowPath(vec(0, 0), vec(20, 0))).toMatch(/^M0 0L20 0M12 /);
  });
});

describe("a mechanism that closes nowhere", () => {
  it("is drawn with its links towards each other, and the gap between them", () => {
    const bars = [
      { name: "ground", points: { A: [0, 0], D: [1, 0] }, solved: true },
      { name: "coupler", points: { A: [0, 0], B: [0.3, 0] }, solved: true },
      { name: "rocker", points: { D: [0, 0], B: [0, 0.4] }, solved: true },
    ];
    const pin = (name: string, bodies: string[]) => ({ name, file_joint: name, kind: "pin", bodies });
    const nothing = { x: [null, null], y: [null, null], angle: [null, null] };
    const own = {
      ...answer,
      bodies: bars,
      joints: [pin("A", ["ground", "coupler"]), pin("B", ["coupler", "rocker"]), pin("D", ["ground", "rocker"])],
      inputs: [],
      motion: { kind: "rotation", values: [0, 1], status: [1, 1], poses: { coupler: nothing, rocker: nothing } },
    } as unknown as MechanismAnswer;
    const figure = figureAt(own, 0);
    expect(figure.closes).toBe(false);
    const end = (body: string) =>
      figure.bodies.find((one) => one.name === body)?.points.find(({ name }) => name === "B");
    expect(end("coupler")?.at.x).toBeCloseTo(0.3);
    expect(end("rocker")?.at.x).toBeCloseTo(0.6);
    expect(end("rocker")?.at.y).toBeCloseTo(0);
  });
});

describe("a mechanism moved by hand", () => {
  it("goes to the nearest position of the grip, not across the turn", () => {
    const count = 361;
    const angle = Array.from({ length: count }, (_, index) => (index * Math.PI) / 180);
    const zeros = angle.map(() => 0);
    const motion = {
      kind: "rotation",
      values: angle,
      status: zeros,
      poses: { crank: { x: zeros, y: zeros, angle } },
    } as unknown as MotionAnswer;
    expect(valueNear(motion, "crank", vec(1, 0), vec(2, 0.4), 0.1)).toBeCloseTo(0.192, 2);
    expect(valueNear(motion, "crank", vec(1, 0), vec(2, -0.4), 0.1)).toBeCloseTo(6.091, 2);
    expect(valueNear(motion, "crank", vec(1, 0), vec(-1, 0.1), 0.1)).toBeLessThan(1.3);
    expect(valueNear(motion, "rod", vec(1, 0), vec(0, 1), 0.1)).toBe(0.1);
  });
});
