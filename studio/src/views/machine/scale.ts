/** The scale of a slider: which part of a parameter's bounds it covers, linear or logarithmic. */
import { type Bounds, outside, parseUnit, quantityText, readQuantity } from "../../ui/units";

export interface Scale {
  /** Least and greatest value [SI]. */
  low: number;
  high: number;
  log: boolean;
  /** Whole numbers only. */
  whole: boolean;
}

/** Positions of a slider: 0 to this. */
export const STEPS = 400;

/** A window reaches from the value over this to the value times this. */
const REACH = 4;

/** Bounds that are at most this many times the value apart are covered as a whole. */
const NEAR = 12;

/** Share of the window by which it keeps from a bound that is excluded. */
const INSIDE = 1e-3;

/**
 * The scale around a value [SI]: the whole of near bounds and of angles, else a window around the value, logarithmic
 * where the value is above 0.
 */
export function scaleAround(value: number, bounds: Bounds, unit: string, whole = false): Scale {
  const low = bounds.at_least ?? bounds.above ?? Number.NEGATIVE_INFINITY;
  const high = bounds.at_most ?? bounds.below ?? Number.POSITIVE_INFINITY;
  const [from, to, log] = ends(value, low, high, unit, whole);
  const inside = (to - from) * INSIDE;
  return {
    low: whole ? Math.round(from) : bounds.above != null && from <= bounds.above ? bounds.above + inside : from,
    high: whole ? Math.round(to) : bounds.below != null && to >= bounds.below ? bounds.below - inside : to,
    log,
    whole,
  };
}

function ends(value: number, low: number, high: number, unit: string, whole: boolean): [number, number, boolean] {
  const size = Math.abs(value);
  const angle = unit === "deg" || unit === "rad";
  const share = unit === "" && high - low <= 2;
  if (high - low <= NEAR * size || (Number.isFinite(high - low) && (angle || share))) return [low, high, false];
  if (whole) return [Math.max(low, Math.min(0, value * REACH)), Math.min(high, Math.max(10, value * REACH)), false];
  if (value > 0) return [Math.max(low, value / REACH), Math.min(high, value * REACH), true];
  const reach = 2 * size || 10 * (parseUnit(unit)?.factor ?? 1);
  return [Math.max(low, -reach), Math.min(high, reach), false];
}

/** Whether a value [SI] is on the scale. */
export function onScale(value: number, scale: Scale): boolean {
  const slack = 1e-9 * Math.max(Math.abs(scale.low), Math.abs(scale.high));
  return value >= scale.low - slack && value <= scale.high + slack;
}

/** The position of a value [SI] on the slider, 0 to `STEPS`. */
export function positionOf(value: number, { low, high, log }: Scale): number {
  if (high <= low) return 0;
  const share = log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
  return STEPS * Math.min(1, Math.max(0, Number.isFinite(share) ? share : 0));
}

/** The value [SI] at a position of the slider. */
export function valueAt(position: number, { low, high, log, whole }: Scale): number {
  const share = Math.min(1, Math.max(0, position / STEPS));
  const value = log ? low * (high / low) ** share : low + (high - low) * share;
  return whole ? Math.round(value) : value;
}

/**
 * The value at a position as a text with its unit, in as few digits as tell two positions apart; never out of bounds.
 */
export function textAt(position: number, scale: Scale, unit: string, bounds: Bounds): string {
  const value = valueAt(position, scale);
  if (scale.whole) return String(value);
  const apart = Math.abs(valueAt(position + 1, scale) - valueAt(position - 1, scale)) / 2;
  const most = Math.max(Math.abs(value), apart);
  const digits = Math.min(6, Math.max(2, Math.ceil(Math.log10(most / apart)) + 1));
  for (const count of [digits, digits + 2, 12]) {
    const text = quantityText(value, unit, count);
    const read = readQuantity(text, unit);
    if ("si" in read && outside(read.si, bounds) === null) return text;
  }
  return quantityText(value, unit, 15);
}
