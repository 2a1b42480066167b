/** Live symmetry: what is drawn on one side of the carpet is drawn on the others too. And the knots of a brush. */
import type { Grid, Knot } from "./geometry";

/** none; across: left and right; along: above and below; both; turned: by half a turn about the middle. */
export const SYMMETRIES = ["none", "across", "along", "both", "turned"] as const;
export type Symmetry = (typeof SYMMETRIES)[number];

/** A path and its images, the path first. */
export function imagesOf(path: readonly Knot[], symmetry: Symmetry, grid: Grid): Knot[][] {
  const across = ({ column, line }: Knot) => ({ column: grid.columns - 1 - column, line });
  const along = ({ column, line }: Knot) => ({ column, line: grid.rows - 1 - line });
  const images = [[...path]];
  if (symmetry === "across" || symmetry === "both") images.push(path.map(across));
  if (symmetry === "along" || symmetry === "both") images.push(path.map(along));
  if (symmetry === "turned" || symmetry === "both") images.push(path.map((knot) => along(across(knot))));
  return images;
}

/** Widths of the brushes: odd ones, which are symmetric about a knot. */
export const BRUSHES = [1, 3, 5, 9, 15, 25] as const;

/** A part of a row: from a column on, some knots. */
export interface Span extends Knot {
  length: number;
}

/** The knots of a round brush about a knot, as far as they lie on the carpet: the brush of the recipe's strokes. */
export function brushSpans({ column, line }: Knot, width: number, grid: Grid): Span[] {
  const reach = (width - 1) / 2;
  const spans: Span[] = [];
  for (let down = -reach; down <= reach; down += 1) {
    const half = Math.floor(Math.sqrt((width / 2) ** 2 - down ** 2));
    const [left, right] = [Math.max(column - half, 0), Math.min(column + half, grid.columns - 1)];
    if (line + down >= 0 && line + down < grid.rows && left <= right)
      spans.push({ column: left, line: line + down, length: right - left + 1 });
  }
  return spans;
}
