import { describe, expect, it } from "vitest";
import { between, Frames, openShed, product, rigid, sampleAt, TURN, underWay, yarnPoints } from "./motion";
import { type SceneAbout, type SceneFrame, sceneModel } from "./scene";

const numbers: number[] = [];
const put = (...values: number[]): [number, number] => {
  numbers.push(...values);
  return [numbers.length - values.length, values.length];
};

function frame(name: string, parent: string, origins: number[], more: Partial<SceneFrame> = {}): SceneFrame {
  return { name, parent, origins: put(...origins), phases: null, axis: [1, 0, 0], motion: null, ...more };
}

function model(frames: SceneFrame[]) {
  const points = put(...[0, 0.03, 0.01, 0].flatMap((front) => [0, 0, 0, 0, 0.4, front, 0, 1, 0]));
  const warps = [{ drive: "shed", number: 3, angle: put(0, 1, 3, TURN), points }];
  const about = { frames, warps } as unknown as SceneAbout;
  return sceneModel(
    { ...about, chart: null },
    new Float32Array(numbers).buffer,
    new Uint32Array().buffer,
    new Uint8Array(),
  );
}

describe("samples", () => {
  it("are found on both sides and between", () => {
    const angles = new Float32Array([0, 1, 2, 4]);
    expect(sampleAt(angles, -1)).toEqual([0, 0]);
    expect(sampleAt(angles, 1.5)).toEqual([1, 0.5]);
    expect(sampleAt(angles, 3)).toEqual([2, 0.5]);
    expect(sampleAt(angles, 9)).toEqual([2, 1]);
    expect(between(new Float32Array([0, 2, 4, 8]), 2, 0.25)).toBe(5);
  });
});

describe("matrices", () => {
  it("turn from up to the front about x", () => {
    const out = new Float32Array(16);
    rigid(out, 0, [1, 0, 0], Math.PI / 2, [1, 2, 3]);
    const up = [0, 1, 2].map((row) => (out[4 + row] ?? 0) + (out[12 + row] ?? 0));
    expect(up[0]).toBeCloseTo(1);
    expect(up[1]).toBeCloseTo(2);
    expect(up[2]).toBeCloseTo(4);
  });

  it("multiply like two motions after each other", () => {
    const [a, b, out] = [new Float32Array(16), new Float32Array(16), new Float32Array(16)];
    rigid(a, 0, [0, 0, 1], Math.PI / 2, [1, 0, 0]);
    rigid(b, 0, [1, 0, 0], 0, [2, 0, 0]);
    product(out, 0, a, 0, b, 0);
    expect([out[12], out[13], out[14]].map((one) => Math.round(1e6 * (one ?? 0)) / 1e6)).toEqual([1, 2, 0]);
  });
});

describe("frames", () => {
  it("are carried, repeated, and moved only by their drive", () => {
    const motion = { drive: "row" as const, angle: put(0, TURN), shift: put(0, 0, 0, 0, 0, 4), rotation: null };
    const frames = new Frames(
      model([
        frame("head", "rail", [1, 0, 0, 2, 0, 0]),
        frame("rail", "", [0, 5, 0], { motion }),
        frame("tool", "head", [0, 1, 0]),
      ]),
    );
    expect(frames.placed.map((one) => [one.frame.name, one.count, [...one.drives]])).toEqual([
      ["rail", 1, ["row"]],
      ["head", 2, ["row"]],
      ["tool", 2, ["row"]],
    ]);
    frames.update({ row: TURN / 2 });
    const tool = frames.byName.get("tool");
    expect([...(tool?.matrices.slice(28, 31) ?? [])]).toEqual([2, 6, 2]);
  });

  it("name the frame that is missing", () => {
    expect(() => new Frames(model([frame("head", "rail", [0, 0, 0])]))).toThrow("no frame");
  });
});

it("a yarn lies straight between the lines of its samples", () => {
  const own = model([]);
  const out = new Float32Array(9);
  for (const sheet of own.about.warps) yarnPoints(own, sheet, 2, out);
  expect([...out].map((one) => Number(one.toFixed(6)))).toEqual([0, 0, 0, 0, 0.4, 0.02, 0, 1, 0]);
});

it("the shed is open where the first sheet is farthest in front", () => {
  const { drive, angle, height } = openShed(model([]));
  expect([drive, angle, Number(height.toFixed(6))]).toEqual(["shed", 1, 0.4]);
});

it("a motion is under way from its start on, also over the end of a turn", () => {
  const phases = [{ drive: "knot", track: "carriage", name: "step", start: TURN - 0.1, end: TURN + 0.2 }];
  const own = { about: { phases } } as unknown as Parameters<typeof underWay>[0];
  expect([TURN - 0.2, TURN - 0.05, 0.1, 0.3].map((angle) => underWay(own, "knot", angle).length)).toEqual([0, 1, 1, 0]);
  expect(underWay(own, "row", 0.1)).toEqual([]);
});
