/** The borders of the recipe, its entries [[border]], from the edge inwards. */
import type { Grid } from "./geometry";

/** A border: a stripe of a yarn, teeth of two yarns, or a tile with a corner. */
export interface Border {
  width?: number | string;
  yarn?: string;
  teeth?: readonly string[];
  tile?: string;
  corner?: string;
  [key: string]: unknown;
}

export const BORDER_KINDS = ["stripe", "teeth", "tile"] as const;
export type BorderKind = (typeof BORDER_KINDS)[number];

export function kindOf(border: Border): BorderKind {
  return border.tile !== undefined ? "tile" : border.teeth !== undefined ? "teeth" : "stripe";
}

export function bordersOf(recipe: object | null): readonly Border[] {
  const borders = (recipe as { border?: unknown } | null)?.border;
  return Array.isArray(borders) ? (borders as Border[]) : [];
}

/** A border as another kind, of its own width; the repeats of a tile are adjusted until they fill a side. */
export function asKind(border: Border, kind: BorderKind, yarns: readonly string[], tiles: readonly string[]): Border {
  const width = border.width === undefined ? {} : { width: border.width };
  const [first = "", second = first] = yarns;
  if (kind === "teeth") return { ...width, teeth: [border.yarn ?? first, second] };
  if (kind === "tile") return { ...width, tile: tiles[0] ?? "", adjust: true };
  return { ...width, yarn: border.yarn ?? border.teeth?.[0] ?? first };
}

/** The borders with one in another place. */
export function movedBorder(borders: readonly Border[], from: number, to: number): Border[] {
  const rest = borders.filter((_, place) => place !== from);
  const moved = borders[from];
  return moved === undefined ? rest : [...rest.slice(0, to), moved, ...rest.slice(to)];
}

/** Where a border lies on the left side of the chart: its first column, and its width [knots]. */
export interface Reach {
  begin: number;
  width: number;
}

/** The reaches of the borders, as far as their widths are given in knots: of the others the engine decides. */
export function reachesOf(borders: readonly Border[]): Reach[] {
  const reaches: Reach[] = [];
  let begin = 0;
  for (const { width } of borders) {
    if (typeof width !== "number") break;
    reaches.push({ begin, width });
    begin += width;
  }
  return reaches;
}

/** The width of a border whose inner edge is dragged to a column: at least a knot, and some of the field remains. */
export function draggedWidth(borders: readonly Border[], place: number, column: number, grid: Grid): number {
  const reaches = reachesOf(borders);
  const own = reaches[place];
  if (own === undefined) return 1;
  const others = reaches.reduce((sum, reach) => sum + reach.width, 0) - own.width;
  const most = Math.floor((Math.min(grid.columns, grid.rows) - 1) / 2) - others;
  return Math.min(Math.max(Math.round(column - own.begin), 1), Math.max(most, 1));
}
