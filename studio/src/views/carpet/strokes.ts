/** From strokes on the chart to edits of the recipe, as `ilmek weave` reads them. */
import { type Grid, type Knot, weaverNumbers } from "./geometry";

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

/** The knots of a stroke: lines from point to point, each knot once. */
export function strokeKnots(points: readonly Knot[]): Knot[] {
  const found = new Map<string, Knot>();
  points.forEach((point, at) => {
    for (const knot of lineKnots(points[at - 1] ?? point, point)) found.set(`${knot.line},${knot.column}`, knot);
  });
  return [...found.values()];
}

/** A knot as edits write it: row from the lower edge, column from the left, both from 1. */
export function written(knot: Knot, grid: Grid): string {
  const { row, knot: column } = weaverNumbers(knot, grid);
  return `${row},${column}`;
}

/** Edits that give the knots of a stroke a yarn: a line where they are one, else single knots. */
export function strokeEdits(points: readonly Knot[], yarn: string, grid: Grid): string[] {
  const knots = strokeKnots(points);
  const [first, last] = [knots[0], knots[knots.length - 1]];
  if (first === undefined || last === undefined) return [];
  if (knots.length > 2 && isLine(knots, first, last)) return [lineEdit(first, last, yarn, grid)];
  return setEdits(knots, yarn, grid);
}

/** Edits that give single knots a yarn. */
export function setEdits(knots: readonly Knot[], yarn: string, grid: Grid): string[] {
  const edits: string[] = [];
  let text = "set";
  for (const knot of knots) {
    const point = written(knot, grid);
    if (text.length + point.length + yarn.length + 2 > LONGEST) {
      edits.push(`${text} ${yarn}`);
      text = "set";
    }
    text += ` ${point}`;
  }
  return [...edits, `${text} ${yarn}`];
}

function isLine(knots: readonly Knot[], first: Knot, last: Knot): boolean {
  const line = lineKnots(first, last);
  return (
    line.length === knots.length &&
    line.every((one, at) => one.column === knots[at]?.column && one.line === knots[at]?.line)
  );
}

export function lineEdit(from: Knot, to: Knot, yarn: string, grid: Grid): string {
  return `line ${written(from, grid)} ${written(to, grid)} ${yarn}`;
}

export function fillEdit(knot: Knot, yarn: string, grid: Grid): string {
  return `fill ${written(knot, grid)} ${yarn}`;
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
