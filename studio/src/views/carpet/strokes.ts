/** From strokes on the chart to edits of the recipe, as `ilmek weave` reads them. */
import { type Grid, type Knot, weaverNumbers } from "./geometry";
import { imagesOf, type Symmetry } from "./symmetry";

/** Largest number of characters of an edit: a recipe takes texts of 1,000. */
const LONGEST = 900;

/** The knots of an 8-connected line, the same from either end: the line of the recipe's edits. */
export function lineKnots(from: Knot, to: Knot): Knot[] {
  const swapped = from.line > to.line || (from.line === to.line && from.column > to.column);
  const [begin, end] = swapped ? [to, from] : [from, to];
  const steps = Math.max(Math.abs(end.line - begin.line), Math.abs(end.column - begin.column), 1);
  const along = (first: number, last: number, number: number) =>
    first + Math.floor((2 * number * (last - first) + steps - (last > first ? 1 : 0)) / (2 * steps));
  const knots: Knot[] = [];
  for (let number = 0; number <= steps; number += 1) {
    const knot = {
      column: along(begin.column, end.column, number),
      line: along(begin.line, end.line, number),
    };
    const last = knots[knots.length - 1];
    if (last?.column !== knot.column || last.line !== knot.line) knots.push(knot);
  }
  return swapped ? knots.reverse() : knots;
}

/** Each knot once. */
function distinct(knots: readonly Knot[]): Knot[] {
  return [...new Map(knots.map((knot) => [`${knot.line},${knot.column}`, knot])).values()];
}

/** A knot as edits write it: row from the lower edge, column from the left, both from 1. */
export function written(knot: Knot, grid: Grid): string {
  const { row, knot: column } = weaverNumbers(knot, grid);
  return `${row},${column}`;
}

/** How a stroke is drawn: its yarn, the width of the brush [knots], the images that are drawn with it. */
export interface Brush {
  yarn: string;
  width: number;
  symmetry: Symmetry;
}

/** The edits of a stroke and of its images: lines where it is straight, single knots, or strokes of a brush. */
export function strokeEdits(points: readonly Knot[], brush: Brush, grid: Grid): string[] {
  const path = pathOf(points);
  const paths = imagesOf(path, brush.symmetry, grid);
  if (path.length === 0) return [];
  if (brush.width > 1) return paths.flatMap((path) => brushEdits(path, brush, grid));
  const isStraight = path.length > 2 && isLine(path);
  if (isStraight && paths.every(isLine)) return paths.map((path) => lineEdit(path, brush.yarn, grid));
  return setEdits(distinct(paths.flat()), brush.yarn, grid);
}

/** The knots that a stroke passes, one beside the other. */
function pathOf(points: readonly Knot[]): Knot[] {
  const path: Knot[] = [];
  points.forEach((point, at) => {
    for (const knot of lineKnots(points[at - 1] ?? point, point)) {
      const last = path[path.length - 1];
      if (last === undefined || knot.line !== last.line || knot.column !== last.column) path.push(knot);
    }
  });
  return path;
}

/** Strokes of a brush along a path: a knot where its direction changes. So a mirrored path is exactly the mirrored one. */
function brushEdits(path: readonly Knot[], { yarn, width }: Brush, grid: Grid): string[] {
  const turns = path.filter((knot, at) => {
    const [before, after] = [path[at - 1], path[at + 1]];
    if (before === undefined || after === undefined) return true;
    return (
      after.line - knot.line !== knot.line - before.line || after.column - knot.column !== knot.column - before.column
    );
  });
  return chunks(turns, `stroke ${width}`, yarn, grid, 1);
}

/** Edits that give single knots a yarn. */
export function setEdits(knots: readonly Knot[], yarn: string, grid: Grid): string[] {
  return chunks(knots, "set", yarn, grid, 0);
}

/** Texts of knots, cut before they get too long; `shared`: knots that a text has of the one before. */
function chunks(knots: readonly Knot[], head: string, yarn: string, grid: Grid, shared: number): string[] {
  const edits: string[] = [];
  let points: string[] = [];
  let length = head.length + yarn.length + 2;
  for (const knot of knots) {
    const point = written(knot, grid);
    if (length + point.length + 1 > LONGEST) {
      edits.push([head, ...points, yarn].join(" "));
      points = points.slice(points.length - shared);
      length = [head, ...points, yarn].join(" ").length;
    }
    points.push(point);
    length += point.length + 1;
  }
  return [...edits, [head, ...points, yarn].join(" ")];
}

function isLine(path: readonly Knot[]): boolean {
  const [first, last] = [path[0], path[path.length - 1]];
  if (first === undefined || last === undefined) return false;
  const line = lineKnots(first, last);
  return (
    line.length === path.length &&
    line.every((knot, index) => knot.column === path[index]?.column && knot.line === path[index]?.line)
  );
}

/** A line from the first to the last knot of a path. */
function lineEdit(path: readonly Knot[], yarn: string, grid: Grid): string {
  const [first, last] = [path[0], path[path.length - 1]];
  return first === undefined || last === undefined ? "" : `line ${written(first, grid)} ${written(last, grid)} ${yarn}`;
}

/** Fills about a knot and its images. */
export function fillEdits(knot: Knot, { yarn, symmetry }: Brush, grid: Grid): string[] {
  const knots = distinct(imagesOf([knot], symmetry, grid).flat());
  return knots.map((knot) => `fill ${written(knot, grid)} ${yarn}`);
}

/** Two opposite corners of a part; null: the whole carpet. */
export type Part = readonly [Knot, Knot] | null;

function within(part: Part, grid: Grid): string {
  return part === null ? "" : ` in ${written(part[0], grid)} ${written(part[1], grid)}`;
}

export function mirrorEdit(direction: "across" | "along" | "both", part: Part, grid: Grid): string {
  return `mirror ${direction}${within(part, grid)}`;
}

export function borderEdit(width: number, yarn: string, part: Part, grid: Grid): string {
  return `border ${width} ${yarn}${within(part, grid)}`;
}

export function repeatEdit(tile: readonly [Knot, Knot], part: Part, grid: Grid): string {
  return `repeat ${written(tile[0], grid)} ${written(tile[1], grid)}${within(part, grid)}`;
}
