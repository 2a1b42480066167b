import { describe, expect, it } from "vitest";
import { chartPixels, dyes, ribbon, yarnColour } from "./cloth";
import { TURN } from "./motion";
import { byMachine, judged } from "./parts";
import { boxOf, pathOf } from "./plate";
import { advanced } from "./player";
import { type SceneAbout, type ScenePart, sceneModel } from "./scene";
import { framed, levelFor, turnOfKey } from "./views";

function clothModel(knots: number[]) {
  const line = new Float32Array([0, 0, 0, -1, 0, -3]);
  const about = {
    carpet: { width: 2, columns: 2, rows: 2, columnPitch: 1, rowPitch: 1, pile: 0.1, line: [0, 6] },
    chart: { rows: 2, columns: 2, colours: ["#ff0000", "#00ff00"], yarns: ["red", "green"] },
  } as unknown as SceneAbout;
  return sceneModel(about, line.buffer, new ArrayBuffer(0), new Uint8Array(knots));
}

describe("carpet", () => {
  it("is a ribbon in front of its ground, its length from the fell on", () => {
    const made = ribbon(clothModel([0, 0, 0, 0]), 0.1);
    const points = [...made.points.slice(0, 12)].map((one) => Number(one.toFixed(6)));
    expect(points).toEqual([-1, 0, 0, 1, 0, 0, -1, 0, 0.1, 1, 0, 0.1]);
    expect([...made.uv].filter((_, k) => k % 4 === 1)).toEqual([0.5, 0, 1, 3]);
    expect(made.triangles.length).toBe(18);
  });

  it("begins with the row that is woven first, the lowest of the picture", () => {
    const pixels = chartPixels(clothModel([0, 0, 1, 0]));
    expect([...pixels.slice(0, 8)]).toEqual([0, 255, 0, 255, 255, 0, 0, 255]);
  });
});

describe("the yarn of a knot", () => {
  it("has the colour of the chart where the head stands, the lowest row first", () => {
    const model = clothModel([0, 0, 1, 0]);
    expect([-0.5, 0.5].map((x) => yarnColour(model, 0, x))).toEqual(["#00ff00", "#ff0000"]);
    expect([-9, 9].map((x) => yarnColour(model, 5, x))).toEqual(["#ff0000", "#ff0000"]);
  });

  it("is one of those that the carpet needs", () => {
    expect(dyes(clothModel([1, 1, 1, 1]))).toEqual(["#00ff00"]);
  });
});

describe("camera", () => {
  it("sees points as large as can be, each within the picture and some at two opposite edges", () => {
    const points: [number, number, number][] = [
      [-1, 0, 0.5],
      [3, 0, -0.5],
      [0, 0.2, 0],
    ];
    const { target, distance } = framed(points, [0, 0, 2], 0.5, 2);
    const shares = points.map(([x, , z]) => (x - target[0]) / (2 * Math.tan(0.25) * (distance - z)));
    expect(Math.min(...shares)).toBeCloseTo(-1, 9);
    expect(Math.max(...shares)).toBeCloseTo(1, 9);
    expect(framed(points, [0, 0, 1], 0.5, 1).distance).toBeGreaterThan(distance);
  });

  it("follows keys, and no others", () => {
    expect(turnOfKey("ArrowLeft", false)?.turn).toBeLessThan(0);
    expect(turnOfKey("ArrowLeft", true)?.right).toBeLessThan(0);
    expect(turnOfKey("+", false)?.zoom).toBeLessThan(1);
    expect(turnOfKey("a", false)).toBeNull();
  });

  it("needs a solid as fine as a pixel", () => {
    expect(levelFor([5e-5, 1e-3, 4e-3], 2e-3)).toBe(1);
    expect(levelFor([5e-5, 1e-3, 4e-3], 1e-5)).toBe(0);
    expect(levelFor([5e-5, 1e-3, 4e-3], 1)).toBe(2);
  });
});

it("an angle goes on as the loom turns, and never jumps after a pause", () => {
  expect(advanced(0, 100, 2, 1)).toBeCloseTo(TURN / 20);
  expect(advanced(TURN - 0.01, 100, 2, 1)).toBeLessThan(0.4);
  expect(advanced(0, 60_000, 2, 0.5)).toBeCloseTo(TURN / 16);
});

it("parts are listed by machine, a check is put in words", () => {
  const part = (name: string, machine: string) => ({ name, machine }) as ScenePart;
  expect(byMachine([part("a", "x"), part("b", "y"), part("c", "x")]).map(([name, own]) => [name, own.length])).toEqual([
    ["x", 2],
    ["y", 1],
  ]);
  const numbers = { value: 0.001, limit: 0.002, unit: "m", shown: "1 mm <= 2 mm" };
  const check = { name: "bow", ...numbers, ok: true, source: "", relation: "<=", cure: "" };
  expect(judged(check)).toBe("1 mm <= 2 mm: holds");
  expect(judged({ ...check, value: null, shown: "– <= 2 mm", ok: false })).toBe("– <= 2 mm: fails");
});

it("a plate is drawn with y up", () => {
  expect(boxOf([0, 0, 2, 0, 2, 1])).toEqual([0, 0, 2, 1]);
  expect(pathOf([[0, 0, 2, 0, 2, 1]])).toBe("M0.000000 0.000000L2.000000 0.000000L2.000000 -1.000000Z");
});
