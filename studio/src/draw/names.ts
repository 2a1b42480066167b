/** Names of points and lines, placed beside them where they cover no other name. */
import { FONT } from "./canvas";
import { colourOf, colours } from "./looks";
import { name } from "./strokes";

interface Box {
  x: number;
  y: number;
  w: number;
  h: number;
}

/** A name to be placed near one of its anchors [px]. */
export interface Named {
  text: string;
  anchors: readonly [number, number][];
  bold: boolean;
  look: number;
  /** Distance from the anchor [px]. */
  clear: number;
}

const DIRECTIONS = [
  [1, -0.7],
  [1, 0.7],
  [-1, -0.7],
  [-1, 0.7],
  [0, -1.2],
  [0, 1.2],
  [1.2, 0],
  [-1.2, 0],
] as const;

/** Writes names, those first in the list first; one without a free place is left out. */
export function paintNames(
  context: CanvasRenderingContext2D,
  names: readonly Named[],
  width: number,
  height: number,
): void {
  const shades = colours();
  const taken: Box[] = [];
  context.textAlign = "center";
  context.textBaseline = "middle";
  for (const one of names) {
    context.font = one.bold ? `bold 12px ${FONT}` : `11px ${FONT}`;
    const w = context.measureText(one.text).width + 4;
    const found = placeOf(one, w, 13, taken, width, height);
    if (found === null) continue;
    taken.push(found);
    const colour = one.look >= 0 ? colourOf(one.look, shades) : shades.ink;
    name(context, one.text, found.x + w / 2, found.y + 7, one.bold ? shades.ink : colour, shades.paper);
  }
}

function placeOf(one: Named, w: number, h: number, taken: readonly Box[], width: number, height: number): Box | null {
  for (const [ax, ay] of one.anchors) {
    if (Number.isNaN(ax) || Number.isNaN(ay)) continue;
    for (const [dx, dy] of DIRECTIONS) {
      const x = ax + dx * one.clear + (dx > 0 ? 0 : dx < 0 ? -w : -w / 2);
      const y = ay + dy * one.clear - h / 2 + Math.sign(dy) * 2;
      const box = { x, y, w, h };
      const inside = x >= 1 && y >= 1 && x + w <= width - 1 && y + h <= height - 1;
      if (inside && taken.every((other) => apart(box, other))) return box;
    }
  }
  return null;
}

function apart(a: Box, b: Box): boolean {
  return a.x + a.w <= b.x || b.x + b.w <= a.x || a.y + a.h <= b.y || b.y + b.h <= a.y;
}
