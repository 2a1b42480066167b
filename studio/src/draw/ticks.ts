/** Round numbers along an axis: those of the pages that the command line writes. */
import { formatNumber } from "../text";
import type { Numbers } from "./figures";

export interface Span {
  low: number;
  high: number;
}

const NOTHING: Span = { low: Number.POSITIVE_INFINITY, high: Number.NEGATIVE_INFINITY };

/** Least and greatest number of lists; an empty span is widened, without numbers it is 0 to 1. */
export function spanOf(lists: readonly Numbers[]): Span {
  let { low, high } = NOTHING;
  for (const list of lists) {
    for (const value of list) {
      if (value === null) continue;
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return widened({ low, high });
}

export function widened({ low, high }: Span): Span {
  if (low > high) return { low: 0, high: 1 };
  if (high - low > 1e-9 * Math.max(Math.abs(low), Math.abs(high))) return { low, high };
  const slack = 0.1 * Math.abs(high) || 1;
  return { low: low - slack, high: high + slack };
}

/** About `count` tick values within a span; angles in degrees step by 5, 10, 15, 30, 45, 60, 90 or 180. */
export function ticks(span: Span, unit = "", count = 6): number[] {
  const { low, high } = span;
  const slack = 1e-9 * (high - low);
  let step = roundStep((high - low) / count);
  if ((unit === "deg" || unit === "°") && high - low > 20) {
    step = [5, 10, 15, 30, 45, 60, 90].find((one) => (high - low) / one <= count) ?? 180;
  }
  const made: number[] = [];
  for (let k = Math.ceil((low - slack) / step); k <= Math.floor((high + slack) / step); k += 1) made.push(k * step + 0);
  return made;
}

/** The least of 1, 2, 2.5, 5, 10 times a power of ten that is not below `least`. */
export function roundStep(least: number): number {
  const decade = 10 ** Math.floor(Math.log10(least));
  return decade * ([1, 2, 2.5, 5].find((step) => decade * step >= least * (1 - 1e-9)) ?? 10);
}

/** Tick values as texts, with as many decimals as the step needs. */
export function tickLabels(values: readonly number[]): string[] {
  return values.map((value) => formatNumber(Number(value.toPrecision(12)), 6));
}

/** The span that reaches to the next tick beyond both ends, where that is no more than a tenth of it. */
export function roomy(span: Span, unit: string, count: number): Span {
  const step =
    (ticks(span, unit, count)[1] ?? 0) - (ticks(span, unit, count)[0] ?? 0) || (span.high - span.low) / count;
  const low = Math.floor(span.low / step + 1e-9) * step;
  const high = Math.ceil(span.high / step - 1e-9) * step;
  const slack = 0.04 * (span.high - span.low);
  return {
    low: span.low - low > step * 0.6 ? span.low - slack : low,
    high: high - span.high > step * 0.6 ? span.high + slack : high,
  };
}
