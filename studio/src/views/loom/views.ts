/** Standard views and where the camera stands for them; what a key does to the camera. */
export type ViewName = "iso" | "front" | "side" | "above" | "fell" | "shed" | "head";

export const VIEW_NAMES: ViewName[] = ["iso", "front", "side", "above", "fell", "shed", "head"];

/** Direction from the target to the camera: x to the weaver's right, y up, z to the front. */
export const DIRECTIONS: Record<ViewName, [number, number, number]> = {
  iso: [0.75, 0.45, 1],
  front: [0, 0.02, 1],
  side: [1, 0.02, 0.0001],
  above: [0, 1, 0.0001],
  fell: [0.25, 0.75, 1],
  shed: [1, 0.08, 0.2],
  head: [0.75, 0.55, 0.6],
};

type Vector = [number, number, number];

const dot = (a: Vector, b: Vector) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const scaled = (a: Vector, by: number): Vector => [a[0] * by, a[1] * by, a[2] * by];

/**
 * What a camera looks at, and how far from it, to see points as large as can be; in the plane through the origin.
 *
 *     |x - X| <= w (D - z),   |y - Y| <= h (D - z)      x right, y up, z to the camera; w, h half widths of view at 1
 *     X = w (max(z + x/w) - max(z - x/w)) / 2,   D >= (max(z + x/w) + max(z - x/w)) / 2,   Y and h in the same way
 *
 * angle  of view, upright [rad]        aspect  width over height of the picture
 */
export function framed(points: readonly Vector[], direction: Vector, angle: number, aspect: number) {
  const away = scaled(direction, 1 / Math.hypot(...direction));
  const right = scaled([away[2], 0, -away[0]], 1 / Math.hypot(away[0], away[2]));
  const up: Vector = [away[1] * right[2], away[2] * right[0] - away[0] * right[2], -away[1] * right[0]];
  const along = (axis: Vector, wide: number) => {
    const most = (sign: number) => Math.max(...points.map((one) => dot(one, away) + (sign * dot(one, axis)) / wide));
    const [high, low] = [most(1), most(-1)];
    return { shift: scaled(axis, (wide * (high - low)) / 2), distance: (high + low) / 2 };
  };
  const [x, y] = [along(right, Math.tan(angle / 2) * aspect), along(up, Math.tan(angle / 2))];
  const target = x.shift.map((own, k) => own + (y.shift[k] ?? 0)) as Vector;
  return { target, distance: Math.max(x.distance, y.distance) };
}

/** Where the view of the shed cuts, in widths of the carpet from its middle. */
export const SHED_CUT = 0.2;

export interface Turn {
  /** About the upright axis and over it [rad]. */
  turn: number;
  tilt: number;
  /** Factor of the distance. */
  zoom: number;
  /** Shift in the picture, in shares of the distance: right, up. */
  right: number;
  up: number;
}

const STEP = Math.PI / 24;
const SHIFT = 0.05;

/** What a key does; null: nothing. */
export function turnOfKey(key: string, shift: boolean): Turn | null {
  const none: Turn = { turn: 0, tilt: 0, zoom: 1, right: 0, up: 0 };
  if (key === "ArrowLeft") return shift ? { ...none, right: -SHIFT } : { ...none, turn: -STEP };
  if (key === "ArrowRight") return shift ? { ...none, right: SHIFT } : { ...none, turn: STEP };
  if (key === "ArrowUp") return shift ? { ...none, up: SHIFT } : { ...none, tilt: STEP };
  if (key === "ArrowDown") return shift ? { ...none, up: -SHIFT } : { ...none, tilt: -STEP };
  if (key === "+" || key === "=") return { ...none, zoom: 0.85 };
  if (key === "-") return { ...none, zoom: 1 / 0.85 };
  return null;
}

/** The number of the solid that is fine enough: its deviation is less than a pixel of so many metres. */
export function levelFor(deviations: readonly number[], pixel: number): number {
  for (let level = deviations.length - 1; level > 0; level--) if ((deviations[level] ?? 0) < pixel) return level;
  return 0;
}
