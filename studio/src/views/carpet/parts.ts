/** Parts of a picture as a recipe writes them: two corners of a crop, four corners of a carpet. */

export interface PicturePoint {
  x: number;
  y: number;
}

/** The points of a text like "10%,5% 90%,95%" or "412,180 1150,240", in pixels; null where it has another number. */
export function pointsOf(text: string, count: number, width: number, height: number): PicturePoint[] | null {
  const pairs = [...text.matchAll(/(-?[\d.]+)\s*(%?)\s*,\s*(-?[\d.]+)\s*(%?)/g)];
  if (pairs.length !== count) return null;
  const side = (value: string | undefined, sign: string | undefined, whole: number) =>
    sign === "%" ? (Number(value) * whole) / 100 : Number(value);
  return pairs.map((pair) => ({ x: side(pair[1], pair[2], width), y: side(pair[3], pair[4], height) }));
}

/** Two corners in per cent of the sides, which hold for any copy of the picture; "" for the whole picture. */
export function cropText(first: PicturePoint, last: PicturePoint, width: number, height: number): string {
  const share = (value: number, whole: number) => Math.round((1000 * Math.min(Math.max(value, 0), whole)) / whole) / 10;
  const [left, right] = [share(Math.min(first.x, last.x), width), share(Math.max(first.x, last.x), width)];
  const [top, bottom] = [share(Math.min(first.y, last.y), height), share(Math.max(first.y, last.y), height)];
  if (left === 0 && top === 0 && right === 100 && bottom === 100) return "";
  return `${left}%,${top}% ${right}%,${bottom}%`;
}

/** Four corners in whole pixels. */
export function cornersText(corners: readonly PicturePoint[]): string {
  return corners.map(({ x, y }) => `${Math.round(x)},${Math.round(y)}`).join(" ");
}

/** The sides of a picture [pixels]. */
interface Sides {
  width: number;
  height: number;
}

/**
 * The opposite corners of a crop, upper left first, after one of its four is moved, clockwise from the upper left.
 *
 * ratio  width by height that is kept, with the corner opposite at rest; null: none
 */
export function movedCrop(
  points: readonly PicturePoint[],
  corner: number,
  to: PicturePoint,
  ratio: number | null = null,
  sides: Sides = { width: Number.POSITIVE_INFINITY, height: Number.POSITIVE_INFINITY },
): PicturePoint[] {
  const [first, last] = [points[0] ?? to, points[1] ?? to];
  const left = corner === 0 || corner === 3;
  const top = corner === 0 || corner === 1;
  const rest = { x: left ? last.x : first.x, y: top ? last.y : first.y };
  let moved = { x: between(to.x, 0, sides.width), y: between(to.y, 0, sides.height) };
  if (ratio !== null) {
    const room = { x: left ? rest.x : sides.width - rest.x, y: top ? rest.y : sides.height - rest.y };
    const wanted = (Math.abs(moved.x - rest.x) + Math.abs(moved.y - rest.y) * ratio) / 2;
    const width = Math.min(wanted, room.x, room.y * ratio);
    moved = { x: rest.x + (left ? -width : width), y: rest.y + ((top ? -1 : 1) * width) / ratio };
  }
  return [
    { x: left ? moved.x : first.x, y: top ? moved.y : first.y },
    { x: left ? last.x : moved.x, y: top ? last.y : moved.y },
  ];
}

/** The opposite corners of a crop that is moved as it is, held inside the picture. */
export function shiftedCrop(
  points: readonly PicturePoint[],
  by: PicturePoint,
  { width, height }: Sides,
): PicturePoint[] {
  const [xs, ys] = [points.map((point) => point.x), points.map((point) => point.y)];
  const x = between(by.x, -Math.min(...xs), width - Math.max(...xs));
  const y = between(by.y, -Math.min(...ys), height - Math.max(...ys));
  return points.map((point) => ({ x: point.x + x, y: point.y + y }));
}

/** The largest crop of a ratio about the middle of a crop. */
export function cropOfRatio(points: readonly PicturePoint[], ratio: number): PicturePoint[] {
  const [first, last] = points;
  if (first === undefined || last === undefined) return [...points];
  const [width, height] = [Math.abs(last.x - first.x), Math.abs(last.y - first.y)];
  const [halfWidth, halfHeight] = [Math.min(width, height * ratio) / 2, Math.min(height, width / ratio) / 2];
  const [x, y] = [(first.x + last.x) / 2, (first.y + last.y) / 2];
  return [
    { x: x - halfWidth, y: y - halfHeight },
    { x: x + halfWidth, y: y + halfHeight },
  ];
}

export function between(value: number, least: number, most: number): number {
  return Math.min(Math.max(value, least), most);
}

/** The four corners of a crop's rectangle, clockwise from the upper left. */
export function cropHandles([first, last]: readonly PicturePoint[]): PicturePoint[] {
  if (first === undefined || last === undefined) return [];
  return [first, { x: last.x, y: first.y }, last, { x: first.x, y: last.y }];
}
