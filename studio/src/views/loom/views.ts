/** Standard views and where the camera stands for them; what a key does to the camera. */
export type ViewName = "iso" | "front" | "side" | "above" | "fell" | "shed" | "head";

export const VIEW_NAMES: ViewName[] = ["iso", "front", "side", "above", "fell", "shed", "head"];

/** Direction from the target to the camera: x to the weaver's right, y up, z to the front. */
export const DIRECTIONS: Record<ViewName, [number, number, number]> = {
  iso: [0.75, 0.45, 1],
  front: [0, 0.02, 1],
  side: [1, 0.02, 0.0001],
  above: [0, 1, 0.0001],
  fell: [0.5, 0.35, 1],
  shed: [1, 0.06, 0.62],
  head: [1, 0.35, 0.9],
};

export interface Box {
  low: [number, number, number];
  high: [number, number, number];
}

/** Distance at which a box of a diagonal fits a camera's angle of view [rad] and the picture's width over height. */
export function fittingDistance(box: Box, angle: number, aspect: number): number {
  const size = [0, 1, 2].map((k) => (box.high[k] ?? 0) - (box.low[k] ?? 0));
  const radius = Math.hypot(...size) / 2;
  const narrow = aspect < 1 ? Math.atan(Math.tan(angle / 2) * aspect) : angle / 2;
  return Math.max(radius / Math.sin(narrow), 0.02);
}

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
