import { describe, expect, it } from "vitest";
import type { CyclogramView, ShownTrack } from "../../api/messages";
import { unpacked } from "../../api/request";
import { pathOf, rangeOf, unitOf, unpack, valueAt, withinTurn } from "./curves";
import {
  type CyclogramData,
  DEGREE,
  dragged,
  lawName,
  room,
  snap,
  TURN,
  withBegin,
  withLevel,
  withSpan,
} from "./model";

const part = (name: string, start: number, end: number, begin: number, finish: number) => ({
  ...{ name, start: start * DEGREE, end: end * DEGREE, begin, finish },
  ...{ law: "cycloidal", law_label: "cycloidal", speed: 1, acceleration: 1, jerk: 1 },
});

const track = {
  name: "die",
  shown_unit: "mm",
  motions: [part("down", 170, 215, 0, 0.1), part("up", 225, 270, 0.1, 0)],
} as unknown as ShownTrack;

const data: CyclogramData = {
  period: "1s",
  tracks: {
    die: {
      motions: {
        down: { start: "170deg", end: "215deg", from: "0mm", to: "100mm", law: "cycloidal" },
        up: { start: "225deg", end: "270deg", from: "100mm", to: "0mm", law: { name: "scca", ramp: 0.2 } },
      },
      events: { pressed: { angle: "215deg", on: "down", share: 1 }, free: { angle: "10deg" } },
    },
  },
};

describe("a drag of a motion", () => {
  it("stays between its neighbours", () => {
    expect(room(track, "down")).toEqual({ start: 0, end: 225 * DEGREE });
    expect(room(track, "up").end).toBeCloseTo(TURN + 170 * DEGREE, 12);
    expect(dragged(track, "down", "end", 1)?.end).toBeCloseTo(225 * DEGREE, 12);
    expect(dragged(track, "up", "start", -1)?.start).toBeCloseTo(215 * DEGREE, 12);
    expect(dragged(track, "down", "start", 9)?.start).toBeCloseTo(214.5 * DEGREE, 12);
    expect(dragged(track, "none", "all", 1)).toBeNull();
  });
  it("keeps the angle of the motion where all of it moves", () => {
    const span = dragged(track, "down", "all", -10.2 * DEGREE);
    expect(span?.start).toBeCloseTo(160 * DEGREE, 12);
    expect((span?.end ?? 0) - (span?.start ?? 0)).toBeCloseTo(45 * DEGREE, 12);
  });
  it("rounds to half a degree", () => {
    expect(snap(10.3 * DEGREE)).toBeCloseTo(10.5 * DEGREE, 12);
  });
});

describe("the file after an edit", () => {
  it("has the new angles, and events that follow the motion have none of their own", () => {
    const next = withSpan(data, "die", "down", { start: 160 * DEGREE, end: 205.5 * DEGREE });
    expect(next.tracks?.["die"]?.motions?.["down"]).toMatchObject({ start: "160deg", end: "205.5deg", to: "100mm" });
    expect(next.tracks?.["die"]?.events).toEqual({ pressed: { on: "down", share: 1 }, free: { angle: "10deg" } });
    expect(data.tracks?.["die"]?.motions?.["down"]?.start).toBe("170deg");
  });
  it("changes a level on both sides of a dwell, also over the end of the turn", () => {
    const motions = withLevel(data, track, "down", 0.12).tracks?.["die"]?.motions;
    expect([motions?.["down"]?.to, motions?.["up"]?.from]).toEqual(["120mm", "120mm"]);
    const round = withBegin(data, track, "down", 0.01).tracks?.["die"]?.motions;
    expect([round?.["up"]?.to, round?.["down"]?.from]).toEqual(["10mm", "10mm"]);
  });
  it("names the law of a table", () => {
    expect(lawName(data.tracks?.["die"]?.motions?.["up"]?.law)).toBe("scca");
  });
});

describe("curves", () => {
  const rows = [
    [0, 1, 1, 2],
    [0, 2, 2, 4],
    [1, 1, 5, 5],
    [0, 0, 0, 0],
    [0, 0, 0, 0],
  ];
  const floats = new Float32Array(rows.flat());
  const text = new TextEncoder().encode(JSON.stringify({ tracks: [{ count: 4 }], lengths: [80] }));
  const padded = Math.ceil((text.length + 4) / 8) * 8;
  const bytes = new Uint8Array(padded + 80).fill(32);
  new DataView(bytes.buffer).setUint32(0, padded - 4, true);
  bytes.set(text, 4);
  bytes.set(new Uint8Array(floats.buffer), padded);
  const shown = unpack(unpacked<CyclogramView>(bytes.buffer));
  const curves = shown.curves[0];
  if (curves === undefined) throw new Error("no curves");
  it("are unpacked from the answer", () => {
    expect([...curves.position]).toEqual([0, 2, 2, 4]);
    expect([...curves.velocity]).toEqual([1, 1, 5, 5]);
  });
  it("are read at the cursor, after a jump with its later value", () => {
    expect(valueAt(curves, "position", 0.25)).toBeCloseTo(0.5, 9);
    expect(valueAt(curves, "velocity", 1)).toBe(5);
    expect(valueAt(curves, "velocity", 0.999)).toBe(1);
    expect(valueAt(curves, "position", 7)).toBe(4);
  });
  it("have a range with 0 for derivatives, and never an empty one", () => {
    expect(rangeOf(curves.velocity, "velocity")).toEqual({ low: 0, high: 5 });
    expect(rangeOf(curves.jerk, "jerk")).toEqual({ low: -1, high: 1 });
  });
  it("are drawn with their jumps", () => {
    expect(
      pathOf(
        curves,
        "velocity",
        (x) => x * 10,
        (y) => y,
      ),
    ).toBe("M0.0 1.0L10.0 1.0L10.0 5.0L20.0 5.0");
  });
  it("have units over time", () => {
    expect([unitOf("mm", "jerk"), unitOf("", "velocity"), unitOf("deg", "position")]).toEqual(["mm/s^3", "1/s", "deg"]);
  });
  it("cut windows at the end of the turn", () => {
    expect(withinTurn([[6, 7]])).toEqual([
      [6, TURN],
      [0, 7 - TURN],
    ]);
    expect(withinTurn([[0, 7]])).toEqual([[0, TURN]]);
  });
});
