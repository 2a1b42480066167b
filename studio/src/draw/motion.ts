/** The parts of an animation at a frame, between frames on straight lines. */
import type { MovingShape, Numbers, ShownAnimation } from "./figures";
import { type Extent, extentOf, include, type Map2D } from "./viewport";

/** Number of steps between frames from the first to the last, or to the first again. */
export function stepsOf(animation: ShownAnimation): number {
  const frames = animation.at.length;
  return Math.max(animation.closes ? frames : frames - 1, 1);
}

/** Least and greatest value of the drive [SI]; of one that closes, a step beyond the last frame. */
export function rangeOf(animation: ShownAnimation): { low: number; high: number } {
  const frames = animation.at.length;
  const [low, last] = [animation.at[0] ?? 0, animation.at[frames - 1] ?? 1];
  const step = frames > 1 ? (last - low) / (frames - 1) : 1;
  return { low, high: animation.closes ? last + step : Math.max(last, low + 1e-12) };
}

/** The frame, with its fraction, of a value of the drive within its range. */
export function frameAt(animation: ShownAnimation, value: number): number {
  const { low, high } = rangeOf(animation);
  return ((value - low) / (high - low)) * stepsOf(animation);
}

/** A number over the frames at a frame with a fraction; list of `width` numbers a frame. */
export function between(values: Numbers, frame: number, frames: number, width: number, of: number): number {
  const before = Math.min(Math.floor(frame), frames - 1);
  const share = frame - before;
  const a = values[before * width + of] ?? Number.NaN;
  if (share === 0) return a;
  const b = values[((before + 1) % frames) * width + of] ?? Number.NaN;
  return a + share * (b - a);
}

/** All positions that an animation reaches. */
export function reachOf(animation: ShownAnimation): Extent {
  const extent = extentOf(animation.still);
  for (const point of animation.points) include(extent, animation.tracks[point.track] ?? []);
  for (const shape of animation.shapes) {
    if (shape.shape.length === 0) {
      for (const track of shape.tracks) include(extent, animation.tracks[track] ?? []);
      continue;
    }
    for (let frame = 0; frame < animation.at.length; frame++) {
      include(extent, pointsAt(animation, shape, frame));
    }
  }
  return extent;
}

/** The points of a moving shape at a frame [px]. */
export function shapeAt(animation: ShownAnimation, shape: MovingShape, frame: number, map: Map2D): Float64Array {
  return pointsAt(animation, shape, frame).map((value, k) =>
    k % 2 === 0 ? map.x0 + value * map.scale : map.y0 - value * map.scale,
  );
}

/** The points of a moving shape at a frame [m]. */
function pointsAt(animation: ShownAnimation, shape: MovingShape, frame: number): Float64Array {
  const frames = animation.at.length;
  const point = (track: number): [number, number] => {
    const list = animation.tracks[track] ?? [];
    return [between(list, frame, frames, 2, 0), between(list, frame, frames, 2, 1)];
  };
  if (shape.shape.length === 0) return Float64Array.from(shape.tracks.flatMap(point));
  const [x, y] = point(shape.tracks[0] ?? 0);
  const [ax, ay] = point(shape.tracks[1] ?? 0);
  const size = Math.hypot(ax - x, ay - y) || 1;
  const [c, s] = [(ax - x) / size, (ay - y) / size];
  const made = new Float64Array(shape.shape.length);
  for (let k = 0; k + 1 < made.length; k += 2) {
    const [lx, ly] = [shape.shape[k] ?? Number.NaN, shape.shape[k + 1] ?? Number.NaN];
    made[k] = x + c * lx - s * ly;
    made[k + 1] = y + s * lx + c * ly;
  }
  return made;
}

/** Position of a drive in its run, 0 to 1, at a phase of the run: over a turn, or forth and back. */
export function shareAt(animation: ShownAnimation, phase: number): number {
  return animation.closes ? phase : (1 - Math.cos(2 * Math.PI * phase)) / 2;
}

/** The phase of a run at which its drive has a share of its range. */
export function phaseAt(animation: ShownAnimation, share: number): number {
  if (animation.closes) return share % 1;
  return Math.acos(1 - 2 * Math.min(Math.max(share, 0), 1)) / (2 * Math.PI);
}
