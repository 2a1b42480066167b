import { describe, expect, it } from "vitest";
import type { ShownTrack } from "../../api/messages";
import { type CyclogramData, DEGREE, TURN } from "./model";
import {
  exclusionsOf,
  freeName,
  longestDwell,
  relationsOf,
  renamedEvent,
  renamedMotion,
  renamedTrack,
  withNewExclusion,
  withNewRelation,
  withoutEvent,
  withoutMotion,
  withoutTrack,
  withRules,
  withSides,
  withStroke,
  withTrack,
} from "./structure";

const part = (name: string, start: number, end: number, begin: number, finish: number) => ({
  ...{ name, start: start * DEGREE, end: end * DEGREE, begin, finish },
  ...{ law: "cycloidal", law_label: "cycloidal", speed: 1, acceleration: 1, jerk: 1 },
});

const die = {
  name: "die",
  shown_unit: "mm",
  low: 0,
  high: 0.1,
  motions: [part("down", 170, 215, 0, 0.1), part("up", 225, 270, 0.1, 0)],
} as unknown as ShownTrack;

const motions = {
  down: { start: "170deg", end: "215deg", from: "0mm", to: "100mm", law: "cycloidal" },
  up: { start: "225deg", end: "270deg", from: "100mm", to: "0mm", law: "cycloidal" },
};

const plain: CyclogramData = {
  period: "1s",
  tracks: {
    die: { motions, events: { pressed: { on: "down", share: 1 }, free: { angle: "10deg" } } },
    feeder: { motions: { in: motions.down } },
  },
  exclusions: [{ first: { track: "die", above: "30mm" }, second: { track: "feeder", above: "50mm" } }],
};

const data = withRules(
  plain,
  [
    withSides({ gap: "1deg" } as never, { track: "die", event: "pressed" }, { track: "feeder", starts: "in" }),
    withSides({ gap: "2deg" } as never, { angle: "5deg" }, { track: "die", starts: "up" }),
  ],
  exclusionsOf(plain),
);

describe("names", () => {
  it("are changed wherever they are used", () => {
    const track = renamedTrack(data, "die", "ram");
    expect(Object.keys(track.tracks ?? {})).toEqual(["ram", "feeder"]);
    expect(relationsOf(track).map((one) => [one.first.track, one.then.track])).toEqual([
      ["ram", "feeder"],
      [undefined, "ram"],
    ]);
    expect(exclusionsOf(track)[0]?.first.track).toBe("ram");
    const motion = renamedMotion(data, "die", "down", "press");
    expect(Object.keys(motion.tracks?.["die"]?.motions ?? {})).toEqual(["press", "up"]);
    expect(motion.tracks?.["die"]?.events?.["pressed"]?.on).toBe("press");
    expect(relationsOf(renamedMotion(data, "die", "up", "lift"))[1]?.then.starts).toBe("lift");
    const event = renamedEvent(data, "die", "pressed", "closed");
    expect(Object.keys(event.tracks?.["die"]?.events ?? {})).toEqual(["closed", "free"]);
    expect(relationsOf(event)[0]?.first.event).toBe("closed");
  });
  it("are free where none of them has the number", () => {
    expect(freeName("track", ["track 1", "track 3"])).toBe("track 2");
  });
});

describe("what is removed", () => {
  it("takes with it the rules that name it", () => {
    const track = withoutTrack(data, "die");
    expect(Object.keys(track.tracks ?? {})).toEqual(["feeder"]);
    expect([track.relations, track.exclusions]).toEqual([undefined, undefined]);
    expect(relationsOf(withoutEvent(data, "die", "pressed"))).toHaveLength(1);
    const motion = withoutMotion(data, die, "down");
    expect(relationsOf(motion)).toHaveLength(1);
    expect(Object.keys(motion.tracks?.["die"]?.events ?? {})).toEqual(["free"]);
  });
  it("leaves a track that joins", () => {
    expect(withoutMotion(data, die, "down").tracks?.["die"]?.motions).toEqual({ up: { ...motions.up, from: "0mm" } });
  });
});

describe("what is added", () => {
  it("is a motion and its return in the longest dwell", () => {
    expect(longestDwell(die)).toEqual({ start: 0, end: 170 * DEGREE, level: 0 });
    const made = withStroke(data, die, ["cycloidal"]).tracks?.["die"]?.motions;
    expect(made?.["motion 1"]).toEqual({ start: "17deg", end: "68deg", from: "0mm", to: "100mm", law: "cycloidal" });
    expect(made?.["motion 2"]?.to).toBe("0mm");
    const full = { ...die, motions: [part("all", 0, 359, 0, 0)] } as unknown as ShownTrack;
    expect(longestDwell(full)).toBeNull();
    expect(withStroke(data, full, [])).toBe(data);
    const over = { ...die, motions: [part("over", 300, 400, 0.2, 0.2)] } as unknown as ShownTrack;
    expect(longestDwell(over)?.start).toBeCloseTo(400 * DEGREE - TURN, 12);
  });
  it("is a track, and rules of what is there", () => {
    expect(withTrack(data, "ram").tracks?.["ram"]).toEqual({ unit: "mm" });
    const made = relationsOf(withNewRelation(data)).at(-1);
    expect([made?.first, made?.then]).toEqual([
      { track: "die", ends: "down" },
      { track: "feeder", starts: "in" },
    ]);
    const one = withNewRelation({ period: "1s", tracks: { die: { motions } } });
    expect(relationsOf(one)[0]?.then).toEqual({ track: "die", starts: "up" });
    expect(exclusionsOf(withNewExclusion(data, [die])).at(-1)?.second.windows).toEqual([["0deg", "30deg"]]);
    expect(exclusionsOf(withNewExclusion(data, [die, die])).at(-1)?.first.above).toBe("50mm");
  });
});
