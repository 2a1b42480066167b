/** Parts of a picture as a recipe writes them: two corners of a crop, four corners of a carpet. */

export interface PicturePoint {
  x: number;
  y: number;
}

/** The points of a text like "10%,5% 90%,95%" or "412,180 1150,240", in pixels; null where it has another number. */
export function pointsOf(text: string, count: number, width: number, height: number): PicturePoint[] | null {
  const found = [...text.matchAll(/(-?[\d.]+)\s*(%?)\s*,\s*(-?[\d.]+)\s*(%?)/g)];
  if (found.length !== count) return null;
  const side = (value: string | undefined, sign: string | undefined, whole: number) =>
    sign === "%" ? (Number(value) * whole) / 100 : Number(value);
  return found.map((one) => ({ x: side(one[1], one[2], width), y: side(one[3], one[4], height) }));
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

/** The corners that are moved with one of a crop's rectangle: of two opposite ones, upper left first. */
export function movedCrop(points: readonly PicturePoint[], at: number, to: PicturePoint): PicturePoint[] {
  const [first, last] = [points[0] ?? to, points[1] ?? to];
  // The handles go clockwise from the upper left.
  const left = at === 0 || at === 3;
  const top = at === 0 || at === 1;
  return [
    { x: left ? to.x : first.x, y: top ? to.y : first.y },
    { x: left ? last.x : to.x, y: top ? last.y : to.y },
  ];
}

/** The four corners of a crop's rectangle, clockwise from the upper left. */
export function cropHandles([first, last]: readonly PicturePoint[]): PicturePoint[] {
  if (first === undefined || last === undefined) return [];
  return [first, { x: last.x, y: first.y }, last, { x: first.x, y: last.y }];
}
