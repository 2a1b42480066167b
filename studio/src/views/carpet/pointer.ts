/** What pointers and keys do on the chart, without the page: pan, pinch, strokes, parts. */
import { type Grid, heldView, type Knot, panned, type Size, type View, zoomed } from "./geometry";
import type { Tool } from "./model";
import { type Brush, borderEdit, fillEdits, mirrorEdit, type Part, repeatEdit, strokeEdits } from "./strokes";

export interface Point {
  x: number;
  y: number;
}

/** The view after two fingers moved: what was between them stays between them. */
export function pinched(
  view: View,
  grid: Grid,
  size: Size,
  before: readonly [Point, Point],
  after: readonly [Point, Point],
): View {
  const middle = ([a, b]: readonly [Point, Point]) => ({ x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 });
  const far = ([a, b]: readonly [Point, Point]) => Math.max(1, Math.hypot(a.x - b.x, a.y - b.y));
  const [from, to] = [middle(before), middle(after)];
  const moved = panned(view, grid, size, to.x - from.x, to.y - from.y);
  return heldView(zoomed(moved, grid, size, far(after) / far(before), to.x, to.y), grid, size);
}

/** What the tools need to know. */
export interface Hand extends Brush {
  tool: Tool;
  mirror: "across" | "along" | "both";
  borderWidth: number;
  tile: readonly [Knot, Knot] | null;
}

/** The edits of a stroke that has ended; none while a tile is chosen. */
export function editsOf(hand: Hand, points: readonly Knot[], grid: Grid): string[] {
  const [first, last] = [points[0], points[points.length - 1]];
  if (first === undefined || last === undefined || hand.yarn === "") return [];
  if (hand.tool === "pencil") return strokeEdits(points, hand, grid);
  if (hand.tool === "line") return strokeEdits([first, last], hand, grid);
  if (hand.tool === "fill") return fillEdits(last, hand, grid);
  return isPoint(first, last) ? [] : areaEdits(hand, [first, last], grid);
}

/** The edits of a tool on a part, or on the whole carpet. */
export function areaEdits(hand: Hand, part: Part, grid: Grid): string[] {
  if (hand.tool === "mirror") return [mirrorEdit(hand.mirror, part, grid)];
  if (hand.tool === "border") return [borderEdit(hand.borderWidth, hand.yarn, part, grid)];
  if (hand.tool === "repeat" && hand.tile !== null) return [repeatEdit(hand.tile, part, grid)];
  return [];
}

/** Whether a tool acts on a part that is dragged. */
export function takesPart(tool: Tool): boolean {
  return tool === "mirror" || tool === "repeat" || tool === "border" || tool === "select";
}

export function isPoint(one: Knot, other: Knot): boolean {
  return one.column === other.column && one.line === other.line;
}

/** Whether a tool draws with the images of a symmetry. */
export function drawsLive(tool: Tool): boolean {
  return tool === "pencil" || tool === "line" || tool === "fill";
}
