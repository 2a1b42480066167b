/** The mechanism at one value of the drive: poses, points and shapes in the world, and what a pointer hits. */
import type { MechanismAnswer, MotionAnswer } from "../../api/messages";
import {
  direction,
  distance,
  hull,
  isInside,
  minus,
  type Pose,
  plus,
  STILL,
  segmentDistance,
  toWorld,
  type Vec,
  vec,
} from "./geometry";
import { GROUND } from "./mechanism";

/** A place between two samples: index of the first, and share towards the next. */
export interface Sample {
  readonly index: number;
  readonly share: number;
}

/** A point of a body in the world. */
export interface DrawnPoint {
  readonly body: string;
  readonly name: string;
  readonly at: Vec;
  /** The joint of the file to which it belongs. */
  readonly joint?: string | undefined;
}

export interface DrawnBody {
  readonly name: string;
  readonly points: readonly DrawnPoint[];
  /** Corners of its outline: one of a block, two of a bar, three or more of a plate. */
  readonly outline: readonly Vec[];
  readonly solved: boolean;
}

export interface DrawnJoint {
  readonly name: string;
  readonly kind: "pin" | "slide";
  readonly at: Vec;
  readonly bodies: readonly string[];
  /** Of a slide: position of its block, and direction of its line in the world. */
  readonly block: Vec;
  readonly line: number;
  readonly grounded: boolean;
  readonly driven: boolean;
}

export interface Figure {
  readonly poses: Readonly<Record<string, Pose>>;
  readonly bodies: readonly DrawnBody[];
  readonly joints: readonly DrawnJoint[];
  readonly points: readonly DrawnPoint[];
  /** Whether the mechanism closes at the value; else it is drawn at the nearest value at which it does. */
  readonly closes: boolean;
}

const TURN = 2 * Math.PI;

/** The value within the range of a motion that is the same position: a turning drive by whole turns. */
export function wrapped(motion: MotionAnswer, value: number): number {
  const [first, last] = range(motion);
  if (motion.kind !== "rotation" || value >= first - 1e-12 === value <= last + 1e-12) return value;
  const turns = Math.floor((value - first) / TURN);
  return Math.min(value - turns * TURN, Math.max(last, first));
}

/** Least and greatest value of the drive. */
export function range(motion: MotionAnswer): [number, number] {
  const [first, last] = [motion.values[0] ?? 0, motion.values.at(-1) ?? 0];
  return first <= last ? [first, last] : [last, first];
}

/** Where a value lies between the samples. */
export function sampleAt(values: readonly (number | null)[], value: number): Sample {
  const count = values.length;
  if (count < 2) return { index: 0, share: 0 };
  const up = (values.at(-1) ?? 0) >= (values[0] ?? 0);
  let [low, high] = [0, count - 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    const below = (values[middle] ?? 0) <= value;
    if (below === up) low = middle;
    else high = middle;
  }
  const [a, b] = [values[low] ?? 0, values[high] ?? 0];
  const share = a === b ? 0 : (value - a) / (b - a);
  return { index: low, share: Math.min(Math.max(share, 0), 1) };
}

/** The nearest sample at which the mechanism has a position; undefined where there is none. */
export function nearestSolved(motion: MotionAnswer, at: Sample): Sample | undefined {
  const good = (index: number) => motion.status[index] === 0 || (motion.status[index] === 2 && isPlaced(motion, index));
  const nearer = at.share < 0.5 ? at.index : at.index + 1;
  if (good(at.index) && (at.share === 0 || good(at.index + 1))) return at;
  for (let apart = 0; apart < motion.status.length; apart += 1) {
    for (const index of [nearer - apart, nearer + apart]) {
      if (index >= 0 && index < motion.status.length && good(index)) return { index, share: 0 };
    }
  }
  return undefined;
}

/** Share of the samples on both sides of the present one in which a mechanism is moved by hand. */
const NEAR = 1 / 6;

/** The value of the drive, near the present one, at which a point of a body is nearest to a position. */
export function valueNear(motion: MotionAnswer, body: string, local: Vec, to: Vec, now: number): number {
  const series = motion.poses[body];
  const count = motion.values.length;
  if (!series || count < 2) return now;
  const around = motion.kind === "rotation" && Math.abs(range(motion)[1] - range(motion)[0] - TURN) < 1e-6;
  const middle = sampleAt(motion.values, wrapped(motion, now)).index;
  const apart = (index: number): number => {
    const [x, y, angle] = [series.x[index], series.y[index], series.angle[index]];
    if (motion.status[index] !== 0 || x == null || y == null || angle == null) return Number.POSITIVE_INFINITY;
    return distance(toWorld({ x, y, angle }, local), to);
  };
  let [best, nearest] = [middle, Number.POSITIVE_INFINITY];
  for (let step = -Math.ceil(count * NEAR); step <= count * NEAR; step += 1) {
    const index = around ? (middle + step + count - 1) % (count - 1) : middle + step;
    if (index < 0 || index >= count) continue;
    const own = apart(index);
    if (own < nearest) [best, nearest] = [index, own];
  }
  return motion.values[best] ?? now;
}

function isPlaced(motion: MotionAnswer, index: number): boolean {
  return Object.values(motion.poses).every((pose) => pose.x[index] != null && pose.angle[index] != null);
}

/** A series between two samples. */
export function between(series: readonly (number | null)[], at: Sample): number | null {
  const a = series[at.index];
  if (a == null || at.share === 0) return a ?? null;
  const b = series[at.index + 1];
  return b == null ? null : a + (b - a) * at.share;
}

/** Bodies that are being moved as a whole, and by how much. */
export interface Shift {
  readonly bodies: readonly string[];
  readonly by: Vec;
}

/** The mechanism at a value of the drive; `earlier`: poses of bodies that are nowhere else. */
export function figureAt(
  answer: MechanismAnswer,
  value: number,
  earlier: Readonly<Record<string, Pose>> = {},
  shift?: Shift | null,
): Figure {
  const poses: Record<string, Pose> = { [GROUND]: STILL };
  for (const body of answer.bodies) if (body.name !== GROUND) poses[body.name] = earlier[body.name] ?? STILL;
  for (const [body, [x, y, angle]] of Object.entries(answer.poses)) poses[body] = { x, y, angle };
  let closes = true;
  const { motion } = answer;
  if (motion) {
    const at = sampleAt(motion.values, wrapped(motion, value));
    const solved = nearestSolved(motion, at);
    closes = solved === at;
    const open: string[] = [];
    for (const [body, { x, y, angle }] of Object.entries(motion.poses)) {
      const pose = poseOf(x, y, angle, solved ?? { index: at.index, share: 0 });
      if (pose) poses[body] = pose;
      else open.push(body);
    }
    reach(answer, poses, open);
  }
  for (const body of shift?.bodies ?? []) {
    const pose = poses[body];
    if (pose && shift) poses[body] = { ...plus(pose, shift.by), angle: pose.angle };
  }
  return { poses, closes, ...shapes(answer, poses) };
}

function poseOf(x: Numbers, y: Numbers, angle: Numbers, at: Sample): Pose | undefined {
  const [across, up, turned] = [between(x, at), between(y, at), between(angle, at)];
  return across === null || up === null || turned === null ? undefined : { x: across, y: up, angle: turned };
}

type Numbers = readonly (number | null)[];

/**
 * Draws bodies of groups that close nowhere: each from its pin on a located body towards the pin of its partner, so
 * that the gap between the two is seen.
 */
function reach(answer: MechanismAnswer, poses: Record<string, Pose>, open: readonly string[]): void {
  const local = (body: string, point: string) => {
    const [x, y] = answer.bodies.find((one) => one.name === body)?.points[point] ?? [0, 0];
    return vec(x, y);
  };
  const anchors = open.flatMap((body) =>
    answer.joints
      .filter((joint) => joint.kind === "pin" && joint.bodies.includes(body))
      .flatMap((joint) => {
        const other = joint.bodies.find((one) => one !== body) ?? GROUND;
        const pose = poses[other];
        return open.includes(other) || !pose
          ? []
          : [{ body, joint: joint.name, at: toWorld(pose, local(other, joint.name)) }];
      }),
  );
  for (const { body, joint, at } of anchors) {
    const inner = answer.joints.find(
      (one) => one.bodies.includes(body) && one.bodies.every((two) => open.includes(two)),
    );
    const partner = anchors.find((one) => one.body !== body && inner?.bodies.includes(one.body));
    if (!inner || !partner) continue;
    const [from, to] = [local(body, joint), local(body, inner.name)];
    const angle = direction(at, partner.at) - direction(from, to);
    poses[body] = { ...minus(at, toWorld({ x: 0, y: 0, angle }, from)), angle };
  }
}

function shapes(answer: MechanismAnswer, poses: Readonly<Record<string, Pose>>) {
  const fileJoint = new Map(answer.joints.map((joint) => [joint.name, joint.file_joint]));
  const bodies = answer.bodies.map((body): DrawnBody => {
    const pose = poses[body.name] ?? STILL;
    const points = Object.entries(body.points).map(
      ([name, [x, y]]): DrawnPoint => ({
        body: body.name,
        name,
        at: toWorld(pose, vec(x, y)),
        joint: fileJoint.get(name),
      }),
    );
    return { name: body.name, points, outline: outlineOf(points.map((point) => point.at)), solved: body.solved };
  });
  const byName = new Map(bodies.map((body) => [body.name, body]));
  const at = (body: string, point: string) =>
    byName.get(body)?.points.find((one) => one.name === point)?.at ?? vec(0, 0);
  const driven = new Set(answer.inputs.map((input) => input.joint));
  const merged = new Map<string, DrawnJoint>();
  for (const joint of answer.joints) {
    const [first, second] = joint.bodies;
    const known = merged.get(joint.file_joint);
    const members = [...new Set([...(known?.bodies ?? []), first, second])];
    merged.set(joint.file_joint, {
      name: joint.file_joint,
      kind: joint.kind === "slide" ? "slide" : "pin",
      at: known?.at ?? at(second, joint.name),
      block: at(first, joint.name),
      line: (poses[second]?.angle ?? 0) + joint.along,
      bodies: members,
      grounded: members.includes(GROUND),
      driven: (known?.driven ?? false) || driven.has(joint.name),
    });
  }
  const seen = new Set<string>();
  const points = bodies
    .flatMap((body) => body.points)
    .filter((point) => {
      if (point.joint === undefined) return true;
      if (seen.has(point.joint)) return false;
      seen.add(point.joint);
      return true;
    });
  return { bodies, joints: [...merged.values()], points };
}

/** The outline of points: of several at one position the first, of three or more their convex hull. */
export function outlineOf(points: readonly Vec[]): Vec[] {
  const apart: Vec[] = [];
  for (const point of points) if (apart.every((other) => distance(other, point) > 1e-9)) apart.push(point);
  return apart.length < 3 ? apart : hull(apart);
}

/** What lies under the pointer: joints before points before bodies. */
export type Hit =
  | { readonly kind: "joint"; readonly name: string; readonly at: Vec }
  | { readonly kind: "point"; readonly body: string; readonly name: string; readonly at: Vec }
  | { readonly kind: "body"; readonly name: string }
  | undefined;

export function hitAt(figure: Figure, at: Vec, reach: number): Hit {
  let best: Hit;
  let nearest = reach;
  for (const joint of figure.joints) {
    const apart = distance(joint.at, at) - (joint.kind === "pin" ? reach * 0.05 : 0);
    if (apart <= nearest) {
      nearest = apart;
      best = { kind: "joint", name: joint.name, at: joint.at };
    }
  }
  if (best) return best;
  for (const point of figure.points) {
    const apart = distance(point.at, at);
    if (point.joint === undefined && apart <= nearest) {
      nearest = apart;
      best = { kind: "point", body: point.body, name: point.name, at: point.at };
    }
  }
  if (best) return best;
  for (const body of [...figure.bodies].reverse()) {
    if (body.name !== GROUND && bodyDistance(body, at) <= reach) return { kind: "body", name: body.name };
  }
  return undefined;
}

/** Distance of a position from a body's outline; 0 inside. */
export function bodyDistance(body: DrawnBody, at: Vec): number {
  const { outline } = body;
  const [first] = outline;
  if (first === undefined) return Number.POSITIVE_INFINITY;
  if (outline.length === 1) return distance(first, at);
  if (outline.length > 2 && isInside(at, outline)) return 0;
  return Math.min(
    ...outline.map((corner, index) => segmentDistance(at, corner, outline[(index + 1) % outline.length] ?? corner)),
  );
}

/** Bodies under a position, nearest first. */
export function bodiesAt(figure: Figure, at: Vec, reach: number): string[] {
  return figure.bodies
    .filter((body) => body.name !== GROUND && bodyDistance(body, at) <= reach)
    .sort((a, b) => bodyDistance(a, at) - bodyDistance(b, at))
    .map((body) => body.name);
}

/** Everything of a figure and a motion that the first view must show. */
export function extent(answer: MechanismAnswer, figure: Figure): Vec[] {
  const all = figure.points.map((point) => point.at);
  for (const points of Object.values(answer.motion?.points ?? {})) {
    for (const { x, y } of Object.values(points)) {
      x.forEach((value, index) => {
        const other = y[index];
        if (index % 6 === 0 && value != null && other != null) all.push(vec(value, other));
      });
    }
  }
  return all;
}
