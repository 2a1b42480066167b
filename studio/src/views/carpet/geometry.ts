/** Where the knots of a chart lie on the screen. A chart's column 0, line 0 is its upper left knot. */

/** The grid of a chart; `aspect`: breadth of a knot over its height. */
export interface Grid {
  rows: number;
  columns: number;
  aspect: number;
}

/** What is seen: the point of the chart in the middle [knots], and the height of a knot [px]. */
export interface View {
  x: number;
  y: number;
  scale: number;
}

export interface Size {
  width: number;
  height: number;
}

/** A knot: column and line from 0 at the upper left. */
export interface Knot {
  column: number;
  line: number;
}

/** A part of the chart that is one texture. */
export interface Tile {
  column: number;
  line: number;
  columns: number;
  rows: number;
}

/** Largest height of a knot [px]. */
export const CLOSEST = 64;

/** Height of a knot in a view of single knots [px]. */
const CLOSE = 28;

/** Room around the whole carpet [px]. */
const ROOM = 16;

/** The view of the whole carpet. */
export function wholeView(grid: Grid, size: Size): View {
  const across = Math.max(1, size.width - 2 * ROOM) / (grid.columns * grid.aspect);
  const along = Math.max(1, size.height - 2 * ROOM) / grid.rows;
  return { x: grid.columns / 2, y: grid.rows / 2, scale: Math.min(CLOSEST, across, along) };
}

/** A view that keeps some of the carpet in sight and is neither too close nor too far. */
export function heldView(view: View, grid: Grid, size: Size): View {
  const whole = wholeView(grid, size);
  const scale = Math.min(CLOSEST, Math.max(view.scale, whole.scale / 2));
  const hold = (at: number, most: number) => Math.min(Math.max(at, 0), most);
  return { x: hold(view.x, grid.columns), y: hold(view.y, grid.rows), scale };
}

/** The point of the chart [knots] under a point of the canvas [px]. */
export function chartPoint(view: View, grid: Grid, size: Size, x: number, y: number): { x: number; y: number } {
  return {
    x: view.x + (x - size.width / 2) / (view.scale * grid.aspect),
    y: view.y + (y - size.height / 2) / view.scale,
  };
}

/** The point of the canvas [px] over a point of the chart [knots]. */
export function canvasPoint(view: View, grid: Grid, size: Size, x: number, y: number): { x: number; y: number } {
  return {
    x: (x - view.x) * view.scale * grid.aspect + size.width / 2,
    y: (y - view.y) * view.scale + size.height / 2,
  };
}

/** The knot under a point of the canvas; null outside the carpet. */
export function knotAt(view: View, grid: Grid, size: Size, x: number, y: number): Knot | null {
  const at = chartPoint(view, grid, size, x, y);
  const knot = { column: Math.floor(at.x), line: Math.floor(at.y) };
  return isInside(knot, grid) ? knot : null;
}

/** The knot under a point of the canvas, or the nearest one of the carpet. */
export function nearestKnot(view: View, grid: Grid, size: Size, x: number, y: number): Knot {
  const at = chartPoint(view, grid, size, x, y);
  return heldKnot({ column: Math.floor(at.x), line: Math.floor(at.y) }, grid);
}

export function heldKnot(knot: Knot, grid: Grid): Knot {
  return {
    column: Math.min(Math.max(knot.column, 0), grid.columns - 1),
    line: Math.min(Math.max(knot.line, 0), grid.rows - 1),
  };
}

function isInside(knot: Knot, grid: Grid): boolean {
  return knot.column >= 0 && knot.line >= 0 && knot.column < grid.columns && knot.line < grid.rows;
}

/** A view zoomed by a factor about a point of the canvas, which stays over the same point of the chart. */
export function zoomed(view: View, grid: Grid, size: Size, factor: number, x: number, y: number): View {
  const before = chartPoint(view, grid, size, x, y);
  const scale = heldView({ ...view, scale: view.scale * factor }, grid, size).scale;
  const after = chartPoint({ ...view, scale }, grid, size, x, y);
  return heldView({ x: view.x + before.x - after.x, y: view.y + before.y - after.y, scale }, grid, size);
}

/** A view moved by a drag [px]. */
export function panned(view: View, grid: Grid, size: Size, dx: number, dy: number): View {
  const moved = { ...view, x: view.x - dx / (view.scale * grid.aspect), y: view.y - dy / view.scale };
  return heldView(moved, grid, size);
}

/** A view in which a knot is in sight, at least `margin` px from the edge. */
export function showing(view: View, grid: Grid, size: Size, knot: Knot, margin = 40): View {
  const at = canvasPoint(view, grid, size, knot.column + 0.5, knot.line + 0.5);
  const over = (value: number, most: number) =>
    most < 2 * margin ? value - most / 2 : Math.min(0, value - margin) + Math.max(0, value - most + margin);
  return panned(view, grid, size, -over(at.x, size.width), -over(at.y, size.height));
}

/** A view of single knots with a knot in its middle. */
export function closeTo(knot: Knot, grid: Grid, size: Size): View {
  return heldView({ x: knot.column + 0.5, y: knot.line + 0.5, scale: CLOSE }, grid, size);
}

/** The knot in the middle of a view. */
export function middleKnot(view: View): Knot {
  return { column: Math.floor(view.x), line: Math.floor(view.y) };
}

/** Number of a knot's row as the weaver counts, from 1 at the lower edge, and of the knot from the left. */
export function weaverNumbers(knot: Knot, grid: Grid): { row: number; knot: number } {
  return { row: grid.rows - knot.line, knot: knot.column + 1 };
}

/** The tiles of a chart whose sides have at most `most` knots. */
export function tilesOf(rows: number, columns: number, most: number): Tile[] {
  const tiles: Tile[] = [];
  for (let line = 0; line < rows; line += most) {
    for (let column = 0; column < columns; column += most) {
      tiles.push({ column, line, columns: Math.min(most, columns - column), rows: Math.min(most, rows - line) });
    }
  }
  return tiles;
}

/** The part of the knots of a chart that a tile has; the whole where it is the only one across. */
export function tileKnots(knots: Uint8Array, columns: number, tile: Tile): Uint8Array {
  if (tile.columns === columns) return knots.subarray(tile.line * columns, (tile.line + tile.rows) * columns);
  const part = new Uint8Array(tile.columns * tile.rows);
  for (let line = 0; line < tile.rows; line += 1) {
    const begin = (tile.line + line) * columns + tile.column;
    part.set(knots.subarray(begin, begin + tile.columns), line * tile.columns);
  }
  return part;
}
