/** One position for all figures over the same quantity: the slider, the mechanism, the cursors of the plots. */
import { type Signal, signal } from "@preact/signals";
import { createContext } from "preact";
import { useContext } from "preact/hooks";
import { parseUnit } from "../ui";
import type { Numbers } from "./figures";

export interface Cursor {
  /** Position [SI]; null: none. */
  at: Signal<number | null>;
  /** What plays it; null: nothing. */
  player: Signal<object | null>;
}

export type Cursors = Map<string, Cursor>;

/** The cursors of the figures that belong together, by the label of their axis. */
export const CursorContext = createContext<Cursors>(new Map());

export function cursorOf(cursors: Cursors, label: string): Cursor {
  let found = cursors.get(label);
  if (found === undefined) {
    found = { at: signal(null), player: signal(null) };
    cursors.set(label, found);
  }
  return found;
}

export function useCursor(label: string): Cursor {
  return cursorOf(useContext(CursorContext), label);
}

/** A person moves the cursor: what plays it stops. */
export function moveTo(cursor: Cursor, at: number | null): void {
  cursor.player.value = null;
  cursor.at.value = at;
}

const TURN = 2 * Math.PI;

/** Whether a unit is one of angles: a value is the same a turn later. */
export function isAngle(unit: string): boolean {
  return parseUnit(unit)?.dimension.join() === "0,0,0,1";
}

/** A value within a range, null outside; an angle may be given a turn off. */
export function within(value: number, low: number, high: number, angle: boolean): number | null {
  const slack = 1e-6 * (high - low);
  let at = value;
  if (angle && (at < low - slack || at > high + slack)) at -= TURN * Math.floor((at - low + slack) / TURN);
  return at >= low - slack && at <= high + slack ? Math.min(Math.max(at, low), high) : null;
}

/** The step of the arrow keys over a range [SI]: a degree, or about a hundredth of the range, round in its unit. */
export function keyStep(low: number, high: number, unit: string): number {
  const factor = parseUnit(unit)?.factor ?? 1;
  const span = high - low;
  if (isAngle(unit) && span > 0.35) return Math.PI / 180;
  return factor * 10 ** Math.floor(Math.log10(span / factor / 50));
}

/** Where a key moves the cursor to; undefined for other keys, null for no cursor. */
export function keyed(
  event: KeyboardEvent,
  at: number,
  low: number,
  high: number,
  unit: string,
): number | null | undefined {
  const step = keyStep(low, high, unit) * (event.shiftKey ? 10 : 1);
  const by: Record<string, number> = {
    ArrowLeft: -step,
    ArrowDown: -step,
    ArrowRight: step,
    ArrowUp: step,
    PageDown: -10 * step,
    PageUp: 10 * step,
    Home: low - at,
    End: high - at,
  };
  if (event.key === "Escape") return null;
  const moved = by[event.key];
  if (moved === undefined || event.ctrlKey || event.metaKey || event.altKey) return undefined;
  event.preventDefault();
  return Math.min(Math.max(at + moved, low), high);
}

/** The ordinate of a curve at an abscissa, straight between its samples; null in gaps and outside. */
export function valueAt(x: Numbers, y: Numbers, at: number): number | null {
  const rising = (x[x.length - 1] ?? 0) >= (x[0] ?? 0);
  let low = 0;
  let high = x.length - 1;
  if (high < 0) return null;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    const value = x[middle] ?? Number.NaN;
    if (value <= at === rising) low = middle;
    else high = middle;
  }
  const [x0, x1, y0, y1] = [x[low], x[high], y[low], y[high]];
  if (x0 == null || x1 == null || y0 == null || y1 == null) return null;
  const slack = 1e-6 * Math.abs((x[x.length - 1] ?? 0) - (x[0] ?? 0));
  if (at < Math.min(x0, x1) - slack || at > Math.max(x0, x1) + slack) return null;
  return x0 === x1 ? y1 : y0 + (y1 - y0) * Math.min(Math.max((at - x0) / (x1 - x0), 0), 1);
}

/** The greatest magnitude of curves. */
export function greatestOf(curves: readonly Numbers[]): number {
  return curves.flat().reduce((most: number, one) => Math.max(most, Math.abs(one ?? 0)), 0);
}

/** A value, 0 where it is rounding noise beside the greatest of its figure. */
export function quiet(value: number, greatest: number): number {
  return Math.abs(value) < 1e-7 * greatest ? 0 : value;
}
