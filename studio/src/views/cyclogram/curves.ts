/** Curves of the tracks: unpacked, drawn, and read at the cursor. */
import type { CyclogramView } from "../../api/messages";
import type { Packed } from "../../api/request";

export const QUANTITIES = ["position", "velocity", "acceleration", "jerk"] as const;
export type Curve = (typeof QUANTITIES)[number];

/** Curves of one track over the master angle [rad]; SI. A jump has its angle twice. */
export interface TrackCurves extends Record<Curve, Float32Array> {
  angle: Float32Array;
}

/** A cyclogram with its curves. */
export interface Shown {
  about: CyclogramView;
  curves: readonly TrackCurves[];
}

/** The curves of a packed answer. */
export function unpack({ about, parts }: Packed<CyclogramView>): Shown {
  const curves = parts(about.lengths).map((part, index) => {
    const count = about.tracks[index]?.count ?? 0;
    const row = (at: number) => new Float32Array(part.buffer, part.byteOffset + 4 * count * at, count);
    return { angle: row(0), position: row(1), velocity: row(2), acceleration: row(3), jerk: row(4) };
  });
  return { about, curves };
}

/** The value of a curve at an angle; where it jumps, that after the jump. */
export function valueAt(curves: TrackCurves, curve: Curve, angle: number): number {
  const { angle: angles } = curves;
  const values = curves[curve];
  let [low, high] = [0, angles.length - 1];
  if (high < 0) return Number.NaN;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if ((angles[middle] ?? 0) <= angle) low = middle;
    else high = middle;
  }
  const [a, b] = [angles[low] ?? 0, angles[high] ?? 0];
  const share = b > a ? Math.min(Math.max((angle - a) / (b - a), 0), 1) : 1;
  return (values[low] ?? 0) + ((values[high] ?? 0) - (values[low] ?? 0)) * share;
}

export interface Range {
  low: number;
  high: number;
}

/** Least and greatest value of a curve; derivatives with 0 in sight; never empty. */
export function rangeOf(values: Float32Array, curve: Curve): Range {
  let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const value of values) {
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  if (curve !== "position") [low, high] = [Math.min(low, 0), Math.max(high, 0)];
  if (!(high - low > 1e-12 * Math.max(1, Math.abs(high)))) return { low: low - 1, high: high + 1 };
  const noise = 1e-6 * (high - low);
  return { low: Math.abs(low) < noise ? 0 : low, high: Math.abs(high) < noise ? 0 : high };
}

/** A curve as a path: x [px] of an angle, y [px] of a value. */
export function pathOf(
  curves: TrackCurves,
  curve: Curve,
  x: (angle: number) => number,
  y: (value: number) => number,
): string {
  const parts: string[] = [];
  const values = curves[curve];
  for (let index = 0; index < curves.angle.length; index++) {
    parts.push(`${index ? "L" : "M"}${x(curves.angle[index] ?? 0).toFixed(1)} ${y(values[index] ?? 0).toFixed(1)}`);
  }
  return parts.join("");
}

const PER = { position: "", velocity: "/s", acceleration: "/s^2", jerk: "/s^3" } as const;

/** The unit of a curve of a track. */
export function unitOf(unit: string, curve: Curve): string {
  return `${unit || (curve === "position" ? "" : "1")}${PER[curve]}`;
}

/** Windows of the master angle within one turn: those that run over its end are cut in two. */
export function withinTurn(windows: readonly (readonly number[])[]): [number, number][] {
  const turn = 2 * Math.PI;
  return windows.flatMap(([start = 0, end = 0]): [number, number][] => {
    if (end - start >= turn) return [[0, turn]];
    const from = ((start % turn) + turn) % turn;
    const to = from + (end - start);
    return to > turn + 1e-9
      ? [
          [from, turn],
          [0, to - turn],
        ]
      : [[from, Math.min(to, turn)]];
  });
}
