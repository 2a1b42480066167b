/** What is held over the chart to be placed: a part of the chart, reflected and turned, or a motif. */
import { type Grid, type Knot, weaverNumbers } from "./geometry";
import { type Brush, setEdits, written } from "./strokes";
import { imagesOf } from "./symmetry";

/** A small picture, row by row from the upper edge: four bytes a knot, red, green, blue and what shows. */
export interface Piece {
  columns: number;
  rows: number;
  pixels: Uint8ClampedArray<ArrayBuffer>;
}

/** copy, move: a part of the chart; motif: knots of the yarn in hand; tile: a picture of the project. */
export interface Placing {
  kind: "copy" | "move" | "motif" | "tile";
  piece: Piece;
  /** Corners of the part that is copied or moved. */
  from?: readonly [Knot, Knot];
  /** File of a tile, and its colour that leaves the chart as it is. */
  picture?: string;
  transparent?: string;
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

/** The upper left knot of a piece about a knot; its lower left one lies on the carpet, a tile as a whole. */
export function placeAbout(knot: Knot, placing: Placing, grid: Grid): Knot {
  const { columns, rows } = shownPiece(placing);
  const hold = (place: number, least: number, most: number) => Math.max(Math.min(place, most), least);
  const isTile = placing.kind === "tile";
  return {
    column: hold(knot.column - Math.floor(columns / 2), 0, isTile ? grid.columns - columns : grid.columns - 1),
    line: hold(knot.line - Math.floor(rows / 2), isTile ? 0 : 1 - rows, grid.rows - rows),
  };
}

/** The edits that place what is held with its upper left knot at a knot; a moved part leaves the yarn of the brush. */
export function placingEdits(placing: Placing, place: Knot, brush: Brush, grid: Grid): string[] {
  if (placing.kind === "motif") return motifEdits(shownPiece(placing), place, brush, grid);
  const [first, last] = placing.from ?? [place, place];
  const words = [
    placing.kind,
    written(first, grid),
    written(last, grid),
    "to",
    written(lowerLeft(placing, place), grid),
  ];
  if (placing.turned > 0) words.push(`turned ${90 * placing.turned}deg`);
  if (placing.mirrored) words.push("mirrored across");
  if (placing.kind === "move") words.push(brush.yarn);
  return [words.join(" ")];
}

/** The knots of a motif and of its images, as far as they lie on the carpet. */
function motifEdits({ columns, rows, pixels }: Piece, place: Knot, { yarn, symmetry }: Brush, grid: Grid): string[] {
  const knots: Knot[] = [];
  for (let line = 0; line < rows; line += 1)
    for (let column = 0; column < columns; column += 1) {
      const knot = { column: place.column + column, line: place.line + line };
      if (pixels[4 * (line * columns + column) + 3] && isOn(knot, grid)) knots.push(knot);
    }
  return imagesOf(knots, symmetry, grid).flatMap((image) => setEdits(image, yarn, grid));
}

function isOn({ column, line }: Knot, grid: Grid): boolean {
  return column >= 0 && line >= 0 && column < grid.columns && line < grid.rows;
}

/** The entry [[motif]] of the recipe that places a tile. */
export function tileEntry(placing: Placing, place: Knot, grid: Grid): Record<string, unknown> {
  const { row, knot } = weaverNumbers(lowerLeft(placing, place), grid);
  const entry = { picture: placing.picture, position: [row, knot] };
  return placing.transparent === undefined ? entry : { ...entry, transparent: placing.transparent };
}

function lowerLeft(placing: Placing, place: Knot): Knot {
  return { column: place.column, line: place.line + shownPiece(placing).rows - 1 };
}

/** A part of a chart as a picture. */
export function pieceOf(
  knots: Uint8Array,
  grid: Grid,
  [first, last]: readonly [Knot, Knot],
  colours: readonly string[],
): Piece {
  const [left, right] = [Math.min(first.column, last.column), Math.max(first.column, last.column)];
  const [top, bottom] = [Math.min(first.line, last.line), Math.max(first.line, last.line)];
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

/** A motif drawn in a colour; each of its cells has `scale` by `scale` knots. */
export function pieceOfMotif(cells: readonly string[], scale: number, colour: string): Piece {
  const [columns, rows] = [(cells[0]?.length ?? 0) * scale, cells.length * scale];
  const code = Number.parseInt(colour.slice(1), 16);
  const pixels = new Uint8ClampedArray(4 * columns * rows);
  for (let line = 0; line < rows; line += 1)
    for (let column = 0; column < columns; column += 1)
      if (cells[Math.floor(line / scale)]?.[Math.floor(column / scale)] === "#")
        pixels.set([code >> 16, (code >> 8) & 255, code & 255, 255], 4 * (line * columns + column));
  return { columns, rows, pixels };
}

/** A piece with all that shows in one colour. */
export function recoloured({ columns, rows, pixels }: Piece, colour: string): Piece {
  const code = Number.parseInt(colour.slice(1), 16);
  const fresh = new Uint8ClampedArray(pixels);
  for (let at = 0; at < fresh.length; at += 4) fresh.set([code >> 16, (code >> 8) & 255, code & 255], at);
  return { columns, rows, pixels: fresh };
}

/** A piece as the address of a picture, for the page. */
export function pictureOf(piece: Piece): string {
  return canvasOf(piece).toDataURL();
}

export function canvasOf({ columns, rows, pixels }: Piece): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [columns, rows];
  canvas.getContext("2d")?.putImageData(new ImageData(pixels, columns, rows), 0, 0);
  return canvas;
}
