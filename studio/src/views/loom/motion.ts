/** Motions of frames over the angle of a drive, and the positions of everything in the loom at two angles. */
import type { Drive, SceneFrame, SceneModel, ScenePhase, SceneYarn } from "./scene";

export const TURN = 2 * Math.PI;

/** The number of the sample at or before an angle, and the share of the step after it. */
export function sampleAt(angles: Float32Array, angle: number): [index: number, share: number] {
  const last = angles.length - 1;
  if (last < 1 || angle <= (angles[0] ?? 0)) return [0, 0];
  if (angle >= (angles[last] ?? 0)) return [last - 1, 1];
  let [low, high] = [0, last];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if ((angles[middle] ?? 0) <= angle) low = middle;
    else high = middle;
  }
  const [before, after] = [angles[low] ?? 0, angles[high] ?? 0];
  return [low, after > before ? (angle - before) / (after - before) : 0];
}

/** A value between two samples. */
export function between(values: Float32Array, index: number, share: number, step = 1, offset = 0): number {
  const before = values[index * step + offset] ?? 0;
  const after = values[(index + 1) * step + offset] ?? before;
  return before + share * (after - before);
}

/** A matrix, columns first: a rotation about an axis through the origin, then a shift. */
export function rigid(
  out: Float32Array,
  at: number,
  axis: readonly number[],
  rotation: number,
  shift: readonly number[],
) {
  const [x = 0, y = 0, z = 0] = axis;
  const [c, s] = [Math.cos(rotation), Math.sin(rotation)];
  const d = 1 - c;
  out[at] = c + x * x * d;
  out[at + 1] = y * x * d + z * s;
  out[at + 2] = z * x * d - y * s;
  out[at + 3] = 0;
  out[at + 4] = x * y * d - z * s;
  out[at + 5] = c + y * y * d;
  out[at + 6] = z * y * d + x * s;
  out[at + 7] = 0;
  out[at + 8] = x * z * d + y * s;
  out[at + 9] = y * z * d - x * s;
  out[at + 10] = c + z * z * d;
  out[at + 11] = 0;
  out[at + 12] = shift[0] ?? 0;
  out[at + 13] = shift[1] ?? 0;
  out[at + 14] = shift[2] ?? 0;
  out[at + 15] = 1;
}

/** The product of two rigid matrices: first b, then a. */
export function product(out: Float32Array, at: number, a: Float32Array, ai: number, b: Float32Array, bi: number) {
  for (let column = 0; column < 4; column++) {
    const [b0, b1, b2, b3] = [0, 1, 2, 3].map((row) => b[bi + 4 * column + row] ?? 0) as [
      number,
      number,
      number,
      number,
    ];
    for (let row = 0; row < 4; row++)
      out[at + 4 * column + row] =
        (a[ai + row] ?? 0) * b0 +
        (a[ai + 4 + row] ?? 0) * b1 +
        (a[ai + 8 + row] ?? 0) * b2 +
        (a[ai + 12 + row] ?? 0) * b3;
  }
}

/** A frame with the matrices of all its copies in space. */
export interface Placed {
  frame: SceneFrame;
  parent: Placed | null;
  /** 16 numbers for each copy: those in the first parent, then in the second. */
  matrices: Float32Array;
  count: number;
  /** The drives that move it, by itself or by what carries it. */
  drives: ReadonlySet<Drive>;
  origins: Float32Array;
  local: Float32Array;
}

/** Of the drives [rad]; one that is not named is at its beginning. */
export type Angles = Partial<Record<Drive, number>>;

/** All frames of a scene, each after what carries it. */
export class Frames {
  readonly placed: Placed[] = [];
  readonly byName = new Map<string, Placed>();

  constructor(private readonly model: SceneModel) {
    const waiting = [...model.about.frames];
    while (waiting.length > 0) {
      const next = waiting.findIndex((one) => one.parent === "" || this.byName.has(one.parent));
      const frame = waiting.splice(Math.max(next, 0), 1)[0];
      if (frame === undefined || next < 0) throw new Error(`no frame ${waiting.map((one) => one.parent).join(", ")}`);
      this.add(frame);
    }
  }

  private add(frame: SceneFrame) {
    const parent = this.byName.get(frame.parent) ?? null;
    const origins = this.model.floats(frame.origins).slice();
    const own = origins.length / 3;
    const drives = new Set([...(parent?.drives ?? []), ...(frame.motion === null ? [] : [frame.motion.drive])]);
    const count = own * (parent?.count ?? 1);
    const placed = {
      frame,
      parent,
      origins,
      count,
      drives,
      matrices: new Float32Array(16 * count),
      local: new Float32Array(16),
    };
    this.placed.push(placed);
    this.byName.set(frame.name, placed);
  }

  /** Computes the matrices of the frames that move with a drive; without one, of all. */
  update(angles: Angles, drive?: Drive): void {
    for (const one of this.placed) if (drive === undefined || one.drives.has(drive)) this.place(one, angles);
  }

  private place(one: Placed, angles: Angles): void {
    const { motion, axis, phases } = one.frame;
    let [x, y, z, rotation] = [0, 0, 0, 0];
    if (motion !== null) {
      const [index, share] = sampleAt(this.model.floats(motion.angle), angles[motion.drive] ?? 0);
      if (motion.rotation !== null) rotation = between(this.model.floats(motion.rotation), index, share);
      if (motion.shift !== null) {
        const shift = this.model.floats(motion.shift);
        [x, y, z] = [0, 1, 2].map((k) => between(shift, index, share, 3, k)) as [number, number, number];
      }
    }
    const own = one.origins.length / 3;
    const phase = phases === null ? null : this.model.floats(phases);
    for (let k = 0; k < own; k++) {
      const at = [0, 1, 2].map((axisOf) => one.origins[3 * k + axisOf] ?? 0);
      const moved = [(at[0] ?? 0) + x, (at[1] ?? 0) + y, (at[2] ?? 0) + z];
      const turned = rotation + (phase?.[k] ?? 0);
      const parents = one.parent?.count ?? 1;
      for (let p = 0; p < parents; p++) {
        const into = 16 * (p * own + k);
        if (one.parent === null) rigid(one.matrices, into, axis, turned, moved);
        else {
          rigid(one.local, 0, axis, turned, moved);
          product(one.matrices, into, one.parent.matrices, 16 * p, one.local, 0);
        }
      }
    }
  }
}

/** The angle of its drive at which the first sheet of warps is farthest in front, and the height of that point [m]. */
export function openShed({ about, floats }: SceneModel): { drive: Drive; angle: number; height: number } {
  const sheet = about.warps[0];
  if (sheet === undefined) return { drive: "row", angle: 0, height: 0.2 };
  const points = floats(sheet.points);
  let front = 2;
  for (let k = front; k < points.length; k += 3) if ((points[k] ?? 0) > (points[front] ?? 0)) front = k;
  const sample = Math.floor(front / (3 * sheet.number));
  return { drive: sheet.drive, angle: floats(sheet.angle)[sample] ?? 0, height: points[front - 1] ?? 0 };
}

/** The motions of the machine that are under way at an angle of a drive: what moves, and what it does. */
export function underWay({ about }: SceneModel, drive: Drive, angle: number): ScenePhase[] {
  return about.phases.filter((one) => one.drive === drive && (angle - one.start + TURN) % TURN < one.end - one.start);
}

/** The points of a yarn at an angle of its drive, (x, y, z) in turn. */
export function yarnPoints(model: SceneModel, yarn: SceneYarn, angle: number, out: Float32Array): void {
  const [index, share] = sampleAt(model.floats(yarn.angle), angle);
  const points = model.floats(yarn.points);
  for (let k = 0; k < 3 * yarn.number; k++) out[k] = between(points, index, share, 3 * yarn.number, k);
}
