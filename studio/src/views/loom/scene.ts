/** A loom in space as the server sends it: its description, and typed arrays of its numbers. */
import type { Packed } from "../../api/request";

export type Range = [first: number, count: number];

export interface SceneCheck {
  name: string;
  value: number | null;
  limit: number | null;
  unit: string;
  ok: boolean;
  source: string;
  relation: string;
  cure: string;
  shown: string;
}

export interface SceneMotion {
  drive: Drive;
  angle: Range;
  shift: Range | null;
  rotation: Range | null;
}

export interface SceneFrame {
  name: string;
  parent: string;
  origins: Range;
  phases: Range | null;
  axis: [number, number, number];
  motion: SceneMotion | null;
}

export interface SceneSolid {
  points: Range;
  triangles: Range;
  deviation: number;
}

export interface ScenePart {
  name: string;
  title: string;
  machine: string;
  frame: string;
  solids: SceneSolid[];
  material: string;
  mass: number | null;
  number: number;
  checks: SceneCheck[];
  plate: string;
  envelope: boolean;
  /** Of one of it where it stands [m]: across, upright, front to back. */
  extents: [number, number, number];
  /** Of the part, and of the body that it is on. */
  ids: [part: string, body: string];
}

/** The model with its parts compared in space: the checks of the loom and of its parts are those of the comparison. */
export function takeComparison(model: SceneModel, space: Comparison): void {
  Object.assign(model.about, { failures: space.failures, nearest: space.nearest });
  for (const part of model.about.parts) part.checks = space.checks[part.name] ?? [];
}

/** The checks that a part fails. */
export function failures(part: ScenePart): SceneCheck[] {
  return part.checks.filter((check) => !check.ok);
}

export interface SceneYarn {
  name: string;
  title: string;
  frame: string;
  drive: Drive;
  angle: Range;
  points: Range;
  number: number;
  diameter: number;
  /** Positions across, at which it is as often [m]; null: once, at 0. */
  across: Range | null;
}

export interface SceneChart {
  rows: number;
  columns: number;
  colours: string[];
  yarns: string[];
}

/** What turns: the cyclogram of a row, that of a knot, the change of a shed by hand and back, or its two driven beats. */
export type Drive = "row" | "knot" | "shed" | "beat";

/** A motion of a cyclogram, from one angle to another [rad]. */
export interface ScenePhase {
  drive: Drive;
  track: string;
  name: string;
  start: number;
  end: number;
}

/** Two parts that come near to each other; what they share where the distance [m] is below 0. */
export interface NearPair {
  parts: [string, string];
  bodies: [string, string];
  distance: number;
  /** What turns when they do, and where [rad]; the heads alone, or nothing, for any other word. */
  cyclogram: string;
  angle: number;
  /** Distance of the heads from the middles of their shares of the row [m]. */
  heads_shift: number;
}

/** What is found of a loom. */
export interface Judgement {
  /** The checks of the whole loom that fail, also those that concern no part alone. */
  failures: SceneCheck[];
  /** The pairs of parts that come nearest; null: they are not compared yet. */
  nearest: NearPair[] | null;
}

/** What turns in a scene, the first at its beginning. */
export function drivesOf({ periods }: SceneAbout): Drive[] {
  return Object.keys(periods) as Drive[];
}

/** The two parts of a pair, as they are in the scene. */
export function partsOf({ parts }: SceneAbout, pair: NearPair): ScenePart[] {
  return pair.parts.flatMap((id, k) => parts.filter(({ ids }) => ids[0] === id && ids[1] === pair.bodies[k]));
}

/** What the comparison of the parts in space adds to a scene: all of it again, and the checks of each part. */
export interface Comparison extends Judgement {
  checks: Record<string, SceneCheck[]>;
}

/** What moves as one. */
export interface SceneBody {
  /** The body that holds it, "" for the floor. */
  parent: string;
  joint: string;
  /** "" where nothing moves it. */
  drive: Drive | "";
  /** What moves it: a motor, or else other bodies; what else holds it, in words. */
  motor: string;
  follows: string[];
  passive: string;
}

/** A body, what holds it, and what holds that, down to the floor. */
export function carriers(about: SceneAbout, body: string): SceneBody[] {
  const held = about.bodies[body];
  return held === undefined ? [] : [held, ...carriers(about, held.parent)];
}

/** What moves a body, what moves that, up to a motor: ids of bodies, at last the motor in words. */
export function movers(about: SceneAbout, body: string): string[] {
  const { motor = "", follows = [] } = about.bodies[body] ?? {};
  const first = follows[0];
  return first === undefined ? [motor].filter((one) => one !== "") : [first, ...movers(about, first)];
}

export interface SceneAbout extends Judgement {
  bodies: Record<string, SceneBody>;
  title: string;
  heads: string;
  /** What people call the tools that tie, by the frames that carry them. */
  tools: Record<string, string>;
  /** Ids of the parts that have the colours of the yarns, one copy after the other. */
  dyed: string[];
  /** Frames of fence and doors. */
  guards: string[];
  floor: number;
  /** Time of a turn of each drive [s]. */
  periods: Partial<Record<Drive, number>>;
  /** What moves when, of each drive. */
  phases: ScenePhase[];
  frames: SceneFrame[];
  parts: ScenePart[];
  /** In sheets that move alike; the first is that which opens the shed in front of all others. */
  warps: SceneYarn[];
  yarns: SceneYarn[];
  carpet: {
    width: number;
    columns: number;
    rows: number;
    columnPitch: number;
    rowPitch: number;
    pile: number;
    line: Range;
  };
  chart: SceneChart | null;
  lengths: [number, number, number];
}

export interface SceneModel {
  about: SceneAbout;
  /** Numbers at a range of the block of floats. */
  floats: (range: Range) => Float32Array;
  /** Whole numbers at a range of the block of integers. */
  integers: (range: Range) => Uint32Array;
  /** The yarn of each knot, the top row of the carpet first; null without a chart. */
  knots: Uint8Array | null;
}

/** The model of an answer: its JSON, and the blocks of floats, integers and knots. */
export function sceneModel(
  about: SceneAbout,
  floats: ArrayBuffer,
  integers: ArrayBuffer,
  knots: Uint8Array,
): SceneModel {
  const [reals, wholes] = [new Float32Array(floats), new Uint32Array(integers)];
  return {
    about,
    floats: ([first, count]) => reals.subarray(first, first + count),
    integers: ([first, count]) => wholes.subarray(first, first + count),
    knots: about.chart === null ? null : knots,
  };
}

/** The model of a packed answer. */
export function modelOf({ about, parts }: Packed<SceneAbout>): SceneModel {
  const [floats, integers, knots] = parts(about.lengths);
  if (!floats || !integers || !knots) throw new Error("a scene without its numbers");
  return sceneModel(about, exact(floats), exact(integers), knots);
}

function exact(part: Uint8Array<ArrayBuffer>): ArrayBuffer {
  return part.buffer.slice(part.byteOffset, part.byteOffset + part.byteLength);
}
