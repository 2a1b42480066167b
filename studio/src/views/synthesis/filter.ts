/** Filters and orders of the gallery. */
import type { ShownFourBar } from "../../api/messages";
import { readQuantity } from "../../ui";

/** What a candidate must have to be shown; "" and false: anything. */
export interface Filter {
  transmission: string;
  size: string;
  turns: boolean;
  certified: boolean;
}

export type Order = "rank" | "error" | "transmission" | "size";

export const NO_FILTER: Filter = { transmission: "", size: "", turns: false, certified: false };

function limit(text: string, unit: string): number | null {
  const read = readQuantity(text, unit);
  return "si" in read ? read.si : null;
}

/** Whether a candidate passes a filter. */
export function accepted(one: ShownFourBar, filter: Filter): boolean {
  const least = limit(filter.transmission, "deg");
  const most = limit(filter.size, "mm");
  return (
    (least === null || one.transmission >= least) &&
    (most === null || one.size <= most) &&
    (!filter.turns || one.crank_turns) &&
    (!filter.certified || one.certified)
  );
}

const KEYS: Record<Order, (one: ShownFourBar) => number> = {
  rank: (one) => one.number,
  error: (one) => one.error_max ?? Number.POSITIVE_INFINITY,
  transmission: (one) => -one.transmission,
  size: (one) => one.size,
};

/** The candidates in an order; equal ones by their rank. */
export function ordered(candidates: readonly ShownFourBar[], order: Order): ShownFourBar[] {
  const key = KEYS[order];
  return [...candidates].sort((a, b) => key(a) - key(b) || a.number - b.number);
}
