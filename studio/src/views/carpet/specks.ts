/** Specks: the small patches of the chart, as the server finds them, and the edits that take them out. */
import type { Specks } from "../../api/messages";
import { type Packed, postPacked } from "../../api/request";
import { canvasPoint, type Grid, type Knot, type Size, type View } from "./geometry";
import { setEdits } from "./strokes";

export interface FoundSpecks extends Specks {
  /** Its knots, row by row from the upper edge. */
  places: Uint32Array;
  /** Of each knot the index of the yarn around its patch. */
  around: Uint8Array;
}

/** The specks of at most `most` knots of the chart of a recipe. */
export async function findSpecks(recipe: object, path: string, most: number, abort: AbortSignal): Promise<FoundSpecks> {
  return foundSpecks(await postPacked<Specks>("/carpet/specks", { recipe, path, most }, abort));
}

export function foundSpecks({ about, parts }: Packed<Specks>): FoundSpecks {
  const [places = new Uint8Array(), around = new Uint8Array()] = parts([4 * about.knots, about.knots]);
  const numbers = new DataView(places.buffer, places.byteOffset, places.byteLength);
  const knots = Uint32Array.from({ length: about.knots }, (_, index) => numbers.getUint32(4 * index, true));
  return { ...about, places: knots, around };
}

/** The number of patches. */
export function countOf(specks: Specks): number {
  return specks.sizes.reduce((sum, number) => sum + number, 0);
}

/** Edits that give the knots of all specks the yarn around them. */
export function speckEdits(specks: FoundSpecks, grid: Grid): string[] {
  const ofYarn = new Map<number, Knot[]>();
  specks.places.forEach((place, index) => {
    const knot = { column: place % grid.columns, line: Math.floor(place / grid.columns) };
    const yarn = specks.around[index] ?? 0;
    const known = ofYarn.get(yarn);
    if (known === undefined) ofYarn.set(yarn, [knot]);
    else known.push(knot);
  });
  return [...ofYarn].flatMap(([yarn, knots]) => setEdits(knots, specks.yarns[yarn] ?? "", grid));
}

/** Specks that are drawn at most: more are a texture, not marks. */
const MOST_DRAWN = 5000;

/** Least side of a mark [px]. */
const LEAST = 5;

/** Squares about the knots of the specks that are seen, as the path of a drawing. */
export function speckPath({ places }: FoundSpecks, grid: Grid, view: View, size: Size): string {
  const [width, height] = [Math.max(LEAST, view.scale * grid.aspect), Math.max(LEAST, view.scale)];
  const drawn: string[] = [];
  for (const place of places) {
    const { x, y } = canvasPoint(
      view,
      grid,
      size,
      (place % grid.columns) + 0.5,
      Math.floor(place / grid.columns) + 0.5,
    );
    if (x < -width || y < -height || x > size.width + width || y > size.height + height) continue;
    drawn.push(`M${(x - width / 2).toFixed(1)} ${(y - height / 2).toFixed(1)}h${width}v${height}h${-width}Z`);
    if (drawn.length >= MOST_DRAWN) break;
  }
  return drawn.join("");
}
