/** Plane geometry of the drawing: poses, snapping, hits, camera. Lengths in metres, angles in radians, y upward. */

export interface Vec {
  readonly x: number;
  readonly y: number;
}

/** A body's frame in the world: origin and angle. */
export interface Pose extends Vec {
  readonly angle: number;
}

export const STILL: Pose = { x: 0, y: 0, angle: 0 };

export const vec = (x: number, y: number): Vec => ({ x, y });
export const plus = (a: Vec, b: Vec): Vec => vec(a.x + b.x, a.y + b.y);
export const minus = (a: Vec, b: Vec): Vec => vec(a.x - b.x, a.y - b.y);
export const times = (a: Vec, by: number): Vec => vec(a.x * by, a.y * by);
export const distance = (a: Vec, b: Vec): number => Math.hypot(a.x - b.x, a.y - b.y);
export const direction = (a: Vec, b: Vec): number => Math.atan2(b.y - a.y, b.x - a.x);

/** A point of a body's frame in the world. */
export function toWorld(pose: Pose, local: Vec): Vec {
  const [cos, sin] = [Math.cos(pose.angle), Math.sin(pose.angle)];
  return vec(pose.x + cos * local.x - sin * local.y, pose.y + sin * local.x + cos * local.y);
}

/** A point of the world in a body's frame. */
export function toLocal(pose: Pose, at: Vec): Vec {
  const [cos, sin, d] = [Math.cos(pose.angle), Math.sin(pose.angle), minus(at, pose)];
  return vec(cos * d.x + sin * d.y, -sin * d.x + cos * d.y);
}

/** Distance of a point from a segment. */
export function segmentDistance(at: Vec, from: Vec, to: Vec): number {
  const along = minus(to, from);
  const square = along.x * along.x + along.y * along.y;
  const share = square === 0 ? 0 : ((at.x - from.x) * along.x + (at.y - from.y) * along.y) / square;
  return distance(at, plus(from, times(along, Math.min(Math.max(share, 0), 1))));
}

/** Whether a point is inside of a polygon. */
export function isInside(at: Vec, corners: readonly Vec[]): boolean {
  let inside = false;
  corners.forEach((a, index) => {
    const b = corners[(index + 1) % corners.length] ?? a;
    if (a.y > at.y !== b.y > at.y && at.x < ((b.x - a.x) * (at.y - a.y)) / (b.y - a.y) + a.x) inside = !inside;
  });
  return inside;
}

/** The corners of the smallest convex polygon around points, counter-clockwise [Andrew's monotone chain]. */
export function hull(points: readonly Vec[]): Vec[] {
  const sorted = [...points].sort((a, b) => a.x - b.x || a.y - b.y);
  if (sorted.length < 3) return sorted;
  const half = (ordered: readonly Vec[]) => {
    const kept: Vec[] = [];
    for (const point of ordered) {
      while (kept.length > 1 && turn(kept.at(-2) as Vec, kept.at(-1) as Vec, point) <= 0) kept.pop();
      kept.push(point);
    }
    return kept.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

function turn(a: Vec, b: Vec, c: Vec): number {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/** What a pointer snapped to. */
export interface Snap {
  readonly at: Vec;
  readonly to: "free" | "grid" | "point" | "angle";
  /** Name of the point, of "point". */
  readonly name?: string;
}

export interface SnapOptions {
  /** Distance of the grid's lines; 0: no grid. */
  readonly grid: number;
  /** Reach of points and directions. */
  readonly reach: number;
  /** Points that attract. */
  readonly points: readonly { readonly name: string; readonly at: Vec }[];
  /** Start of a line whose direction snaps to multiples of 45°. */
  readonly from?: Vec | undefined;
}

/** Snaps a position: to the nearest point, to horizontal, vertical or 45° from a start, to the grid; in this order. */
export function snap(at: Vec, options: SnapOptions): Snap {
  let best: Snap | undefined;
  let nearest = options.reach;
  for (const point of options.points) {
    const apart = distance(point.at, at);
    if (apart <= nearest) {
      nearest = apart;
      best = { at: point.at, to: "point", name: point.name };
    }
  }
  if (best) return best;
  const { from, grid, reach } = options;
  if (from && distance(from, at) > reach) {
    const step = Math.PI / 4;
    const angle = Math.round(direction(from, at) / step) * step;
    const unit = vec(clean(Math.cos(angle)), clean(Math.sin(angle)));
    const along = (at.x - from.x) * unit.x + (at.y - from.y) * unit.y;
    const held = grid > 0 ? Math.round(along / grid) * grid : along;
    if (distance(plus(from, times(unit, along)), at) <= reach / 2) {
      return { at: plus(from, times(unit, held)), to: "angle" };
    }
  }
  if (grid > 0) return { at: vec(tidy(at.x, grid), tidy(at.y, grid)), to: "grid" };
  return { at, to: "free" };
}

function clean(value: number): number {
  return Math.abs(value) < 1e-12 ? 0 : value;
}

/** The nearest multiple of a step, without the rounding of its product. */
export function tidy(value: number, step: number): number {
  return Number((Math.round(value / step) * step).toPrecision(12)) + 0;
}

/** The part of the world that is shown: its middle, and pixels per metre. */
export interface Camera {
  readonly centre: Vec;
  readonly scale: number;
}

export interface Size {
  readonly width: number;
  readonly height: number;
}

export function toScreen(camera: Camera, size: Size, at: Vec): Vec {
  return vec(
    size.width / 2 + (at.x - camera.centre.x) * camera.scale,
    size.height / 2 - (at.y - camera.centre.y) * camera.scale,
  );
}

export function fromScreen(camera: Camera, size: Size, at: Vec): Vec {
  return vec(
    camera.centre.x + (at.x - size.width / 2) / camera.scale,
    camera.centre.y - (at.y - size.height / 2) / camera.scale,
  );
}

/** Zooms about a position on the screen. */
export function zoomed(camera: Camera, size: Size, by: number, about: Vec): Camera {
  const fixed = fromScreen(camera, size, about);
  const scale = Math.min(Math.max(camera.scale * by, 1), 1e7);
  const moved = fromScreen({ ...camera, scale }, size, about);
  return { scale, centre: plus(camera.centre, minus(fixed, moved)) };
}

/** The camera that shows all points with a margin. */
export function fitted(points: readonly Vec[], size: Size, margin = 48): Camera {
  const real = points.filter((point) => Number.isFinite(point.x) && Number.isFinite(point.y));
  if (real.length === 0) return { centre: vec(0, 0), scale: 1500 };
  const xs = real.map((point) => point.x);
  const ys = real.map((point) => point.y);
  const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const [wide, tall] = [Math.max(size.width - 2 * margin, 80), Math.max(size.height - 2 * margin, 80)];
  const scale = Math.min(wide / Math.max(right - left, 0.01), tall / Math.max(high - low, 0.01));
  return { centre: vec((left + right) / 2, (low + high) / 2), scale };
}

/** Distance of the grid's lines for a scale: 1, 2 or 5 times a power of ten, 12 pixels or more [m]. */
export function gridStep(scale: number): number {
  const least = 12 / scale;
  const power = 10 ** Math.floor(Math.log10(least));
  const step = [1, 2, 5, 10].find((factor) => factor * power >= least) ?? 10;
  return Number((step * power).toPrecision(6));
}
