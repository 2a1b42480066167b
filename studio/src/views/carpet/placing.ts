/** What is held over the chart to be placed: a part of the chart, reflected and turned, or a motif. */
import { type Grid, type Knot, weaverNumbers } from "./geometry";

/** A small picture, row by row from the upper edge: four bytes a knot, red, green, blue and what shows. */
export interface Piece {
  columns: number;
  rows: number;
  pixels: Uint8ClampedArray<ArrayBuffer>;
}

export interface Placing {
  kind: "copy" | "move" | "motif";
  piece: Piece;
  /** Of a copy the corners of its part. */
  from?: readonly [Knot, Knot];
  /** Of a motif its file. */
  picture?: string;
  /** It is reflected left to right, and then turned clockwise by so many right angles. */
  mirrored: boolean;
  turned: number;
}

/** Turned by a right angle more, clockwise. */
export function turned(placing: Placing): Placing {
  return { ...placing, turned: (placing.turned + 1) % 4 };
}

/** Reflected left to right as it is seen. */
export function mirrored(placing: Placing): Placing {
  return { ...placing, mirrored: !placing.mirrored, turned: (4 - placing.turned) % 4 };
}

/** The piece as it is held. */
export function shownPiece({ piece, mirrored: flipped, turned: quarters }: Placing): Piece {
  const { columns, rows } = piece;
  const [wide, high] = quarters % 2 === 1 ? [rows, columns] : [columns, rows];
  const pixels = new Uint8ClampedArray(4 * wide * high);
  for (let line = 0; line < rows; line += 1)
    for (let column = 0; column < columns; column += 1) {
      let [x, y] = [flipped ? columns - 1 - column : column, line];
      let [width, height] = [columns, rows];
      for (let quarter = 0; quarter < quarters; quarter += 1) {
        [x, y] = [height - 1 - y, x];
        [width, height] = [height, width];
      }
      const from = 4 * (line * columns + column);
      pixels.set(piece.pixels.subarray(from, from + 4), 4 * (y * wide + x));
    }
  return { columns: wide, rows: high, pixels };
}

/** The upper left knot of a piece about a knot; its lower left one lies on the carpet. */
export function placeAbout(knot: Knot, piece: Piece, grid: Grid): Knot {
  const hold = (at: number, least: number, most: number) => Math.min(Math.max(at, least), most);
  return {
    column: hold(knot.column - Math.floor(piece.columns / 2), 0, grid.columns - 1),
    line: hold(knot.line - Math.floor(piece.rows / 2), 1 - piece.rows, grid.rows - piece.rows),
  };
}

/** The edit that places a part of the chart with its upper left knot at a knot; `yarn`: what a moved one leaves. */
export function placingEdit(placing: Placing, at: Knot, yarn: string, grid: Grid): string {
  const text = (knot: Knot) => {
    const { row, knot: column } = weaverNumbers(knot, grid);
    return `${row},${column}`;
  };
  const [first, last] = placing.from ?? [at, at];
  const lower = { column: at.column, line: at.line + shownPiece(placing).rows - 1 };
  const words = [placing.kind, text(first), text(last), "to", text(lower)];
  if (placing.turned > 0) words.push(`turned ${90 * placing.turned}deg`);
  if (placing.mirrored) words.push("mirrored across");
  if (placing.kind === "move") words.push(yarn);
  return words.join(" ");
}

/** A part of a chart as a picture. */
export function pieceOf(
  knots: Uint8Array,
  grid: Grid,
  [one, other]: readonly [Knot, Knot],
  colours: readonly string[],
): Piece {
  const [left, right] = [Math.min(one.column, other.column), Math.max(one.column, other.column)];
  const [top, bottom] = [Math.min(one.line, other.line), Math.max(one.line, other.line)];
  const [columns, rows] = [right - left + 1, bottom - top + 1];
  const pixels = new Uint8ClampedArray(4 * columns * rows);
  for (let line = 0; line < rows; line += 1)
    for (let column = 0; column < columns; column += 1) {
      const yarn = knots[(top + line) * grid.columns + left + column] ?? 0;
      const code = Number.parseInt((colours[yarn] ?? "#000000").slice(1), 16);
      pixels.set([code >> 16, (code >> 8) & 255, code & 255, 255], 4 * (line * columns + column));
    }
  return { columns, rows, pixels };
}
