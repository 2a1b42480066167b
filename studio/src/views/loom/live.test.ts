import { expect, it } from "vitest";
import type { RunNews } from "../../api/messages";
import { liveOf } from "./live";
import { TURN } from "./motion";
import type { Run } from "./run";
import { type SceneAbout, sceneModel } from "./scene";

const about = {
  heads: "head",
  frames: [{ name: "head", parent: "", origins: [0, 6], phases: null, axis: [1, 0, 0], motion: null }],
  carpet: { columns: 10, columnPitch: 0.004 },
  periods: { row: 10, knot: 2 },
  chart: null,
} as unknown as SceneAbout;
const numbers = new Float32Array([-0.01, 0, 0, 0.01, 0, 0]);
const model = sceneModel(about, numbers.buffer, new ArrayBuffer(0), new Uint8Array());
const run: Run = { file: "carpet.toml", speed: 100, going: true, news: null, tied: 100, ended: "" };
const news = { row: 3, rows: 8, tied: 4, due: 10, time: 101, columns: [0, null] } as unknown as RunNews;

it("while knots are tied the heads stand at their knots and the row at its beginning", () => {
  const live = liveOf(model, run, news, null);
  expect(live.rows).toBe(3);
  expect(live.heads[0]).toBeCloseTo(-0.018);
  expect(live.heads[1]).toBeCloseTo(0.01);
  expect(live.angles).toEqual({ row: 0, knot: TURN / 2 });
  const later = liveOf(model, run, { ...news, columns: [null, 9] }, live);
  expect(later.heads[0]).toBeCloseTo(-0.018);
  expect(later.heads[1]).toBeCloseTo(0.018);
});

it("after the last knot the row turns", () => {
  const live = liveOf(model, run, { ...news, tied: 10, time: 105 }, null);
  expect(live.rows).toBe(4);
  expect(live.angles).toEqual({ row: TURN / 2, knot: 0 });
});
