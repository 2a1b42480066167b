/** From the plane [m] to the screen [px], y up. */
import type { Size } from "../../ui";

export interface Camera {
  /** Pixels a metre along x and along y. */
  sx: number;
  sy: number;
  /** Screen position of the origin. */
  ox: number;
  oy: number;
}

export type { Size } from "../../ui";

export interface At {
  x: number;
  y: number;
}

export function toScreen(camera: Camera, at: At): At {
  return { x: camera.ox + at.x * camera.sx, y: camera.oy - at.y * camera.sy };
}

export function toPlane(camera: Camera, at: At): At {
  return { x: (at.x - camera.ox) / camera.sx, y: (camera.oy - at.y) / camera.sy };
}

/** Bounds of some points: least and greatest x and y; a small square about one point. */
export function boundsOf(points: readonly At[], least = 1e-3): { low: At; high: At } {
  const xs = points.map((at) => at.x);
  const ys = points.map((at) => at.y);
  const low = { x: Math.min(...xs), y: Math.min(...ys) };
  const high = { x: Math.max(...xs), y: Math.max(...ys) };
  if (points.length === 0) return { low: { x: -0.05, y: -0.05 }, high: { x: 0.05, y: 0.05 } };
  for (const axis of ["x", "y"] as const) {
    const missing = least - (high[axis] - low[axis]);
    if (missing > 0) {
      low[axis] -= missing / 2;
      high[axis] += missing / 2;
    }
  }
  return { low, high };
}

/** The camera that shows all points with a margin [px]; stretched: each axis has its own scale. */
export function fitted(points: readonly At[], size: Size, margin = 40, stretched = false): Camera {
  const { low, high } = boundsOf(points, stretched ? 1e-9 : 1e-3);
  const room = { x: Math.max(size.width - 2 * margin, 10), y: Math.max(size.height - 2 * margin, 10) };
  let [sx, sy] = [room.x / (high.x - low.x), room.y / (high.y - low.y)];
  if (!stretched) sx = sy = Math.min(sx, sy);
  return {
    sx,
    sy,
    ox: size.width / 2 - ((low.x + high.x) / 2) * sx,
    oy: size.height / 2 + ((low.y + high.y) / 2) * sy,
  };
}

/** The camera closer by a factor, with one point of the screen fixed. */
export function zoomed(camera: Camera, factor: number, about: At): Camera {
  return {
    sx: camera.sx * factor,
    sy: camera.sy * factor,
    ox: about.x + (camera.ox - about.x) * factor,
    oy: about.y + (camera.oy - about.y) * factor,
  };
}

/** The greatest of 1, 2, 5 times a power of ten that is at most a value. */
export function niceStep(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  const share = value / power;
  return (share >= 5 ? 5 : share >= 2 ? 2 : 1) * power;
}

/** A number rounded to a multiple of a step, without rounding noise. */
export function snapped(value: number, step: number): number {
  return Number((Math.round(value / step) * step).toPrecision(10));
}

/** Values of grid lines between two bounds, at most some. */
export function gridLines(low: number, high: number, most = 12): number[] {
  const least = (high - low) / most;
  const step = niceStep(least) < least ? nextStep(niceStep(least)) : least;
  const found: number[] = [];
  for (let at = Math.ceil(low / step); at * step <= high; at++) found.push(snapped(at * step, step));
  return found;
}

function nextStep(step: number): number {
  const lead = Math.round(step / 10 ** Math.floor(Math.log10(step) + 1e-9));
  return lead === 2 ? step * 2.5 : step * 2;
}
