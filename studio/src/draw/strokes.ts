/** Painting of each role of a drawing: bars, hatched ground, pivots, dimensions, yarn. Positions are pixels, flat. */
import { FONT } from "./canvas";
import type { Numbers } from "./figures";
import { type Colours, colourOf, colours } from "./looks";
import type { Map2D } from "./viewport";

type Context = CanvasRenderingContext2D;

/** Half the length and height of a slider's block [px]. */
const BLOCK = { x: 12, y: 8 };

/** Points [m] as pixels; gaps are NaN. */
export function placed(points: Numbers, map: Map2D): Float64Array {
  const made = new Float64Array(points.length);
  for (let k = 0; k + 1 < points.length; k += 2) {
    made[k] = map.x0 + (points[k] ?? Number.NaN) * map.scale;
    made[k + 1] = map.y0 - (points[k + 1] ?? Number.NaN) * map.scale;
  }
  return made;
}

/** A polyline with gaps, ready to be stroked or filled. */
function trace(context: Context, points: Float64Array, closed: boolean): void {
  context.beginPath();
  let open = false;
  for (let k = 0; k + 1 < points.length; k += 2) {
    const [x, y] = [points[k] ?? Number.NaN, points[k + 1] ?? Number.NaN];
    if (Number.isNaN(x) || Number.isNaN(y)) {
      open = false;
      continue;
    }
    if (open) context.lineTo(x, y);
    else context.moveTo(x, y);
    open = true;
  }
  if (closed) context.closePath();
}

export interface Line {
  role: string;
  closed: boolean;
  filled?: boolean;
  look: number;
  label: string;
}

const ORDER = ["construction", "ground", "guide", "outline", "path", "yarn", "link", "wheel", "dimension"];

/** The order in which strokes are painted, by their role. */
export function byRole<T extends { role: string }>(strokes: readonly T[]): T[] {
  return [...strokes].sort((a, b) => ORDER.indexOf(a.role) - ORDER.indexOf(b.role));
}

/** Paints a stroke. */
export function paintStroke(context: Context, line: Line, points: Float64Array): void {
  const shades = colours();
  context.lineCap = "round";
  context.lineJoin = "round";
  context.setLineDash([]);
  const own = line.look >= 0 ? colourOf(line.look, shades) : shades.ink;
  switch (line.role) {
    case "link":
      fill(context, line, points, own, 0.3);
      stroke(context, points, line.closed, own, 8);
      stroke(context, points, line.closed, mixed(own, shades.paper, 0.5), 5.4);
      break;
    case "wheel":
      context.setLineDash([9, 3, 2, 3]);
      stroke(context, points, line.closed, own, 1.6);
      context.setLineDash([]);
      break;
    case "ground":
      fill(context, line, points, shades.steel, 0.25);
      stroke(context, points, line.closed, shades.steel, 1.7);
      hatch(context, points, shades, 7);
      break;
    case "guide":
      guide(context, points, shades);
      break;
    case "path":
      stroke(context, points, line.closed, own, 1.5);
      break;
    case "construction":
      context.setLineDash([5, 3]);
      stroke(context, points, line.closed, shades.steel, 1);
      context.setLineDash([]);
      break;
    case "dimension":
      dimension(context, line, points, shades);
      break;
    case "yarn":
      fill(context, line, points, shades.yarn, 0.25);
      stroke(context, points, line.closed, shades.yarn, 2.4);
      break;
    default:
      fill(context, line, points, shades.steel, 0.12);
      stroke(context, points, line.closed, shades.ink, 1.7);
  }
}

/** Paints a point by its role; along: direction of a block's guide, y down. */
export function paintDot(context: Context, role: string, x: number, y: number, along?: [number, number]): void {
  if (Number.isNaN(x) || Number.isNaN(y)) return;
  const shades = colours();
  if (role === "block") {
    block(context, x, y, along ?? [1, 0], shades);
    return;
  }
  if (role === "pivot") pivot(context, x, y, shades);
  context.beginPath();
  context.arc(x, y, role === "point" ? 2.6 : 4, 0, 2 * Math.PI);
  context.fillStyle = role === "point" ? shades.ink : shades.paper;
  context.fill();
  context.strokeStyle = shades.ink;
  context.lineWidth = 1.5;
  if (role !== "point") context.stroke();
}

function stroke(context: Context, points: Float64Array, closed: boolean, colour: string, width: number): void {
  trace(context, points, closed);
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.stroke();
}

function fill(context: Context, line: Line, points: Float64Array, colour: string, share: number): void {
  if (!line.filled) return;
  trace(context, points, true);
  context.globalAlpha = share;
  context.fillStyle = colour;
  context.fill();
  context.globalAlpha = 1;
}

/** Short lines on the right of a line's direction, 45 degrees back. */
function hatch(context: Context, points: Float64Array, shades: Colours, length: number): void {
  context.beginPath();
  let left = 3;
  for (let k = 0; k + 3 < points.length; k += 2) {
    const [x, y] = [points[k] ?? 0, points[k + 1] ?? 0];
    const [dx, dy] = [(points[k + 2] ?? 0) - x, (points[k + 3] ?? 0) - y];
    const size = Math.hypot(dx, dy);
    if (!(size > 0)) continue;
    const [ux, uy] = [dx / size, dy / size];
    const [hx, hy] = [(-ux - uy) * Math.SQRT1_2 * length, (ux - uy) * Math.SQRT1_2 * length];
    for (; left < size; left += 6.5) {
      context.moveTo(x + ux * left, y + uy * left);
      context.lineTo(x + ux * left + hx, y + uy * left + hy);
    }
    left -= size;
  }
  context.strokeStyle = shades.steel;
  context.lineWidth = 0.9;
  context.stroke();
}

/** The wall of a slider's guide, on the right of its direction and clear of the block. */
function guide(context: Context, points: Float64Array, shades: Colours): void {
  const last = points.length - 2;
  const [dx, dy] = [(points[last] ?? 0) - (points[0] ?? 0), (points[last + 1] ?? 0) - (points[1] ?? 0)];
  const size = Math.hypot(dx, dy) || 1;
  const [ux, uy] = [dx / size, dy / size];
  const wall = Float64Array.from(points, (value, k) => {
    const along = BLOCK.x * (k < 2 ? -1 : k >= last ? 1 : 0);
    return value + (k % 2 === 0 ? ux * along - uy * (BLOCK.y + 1) : uy * along + ux * (BLOCK.y + 1));
  });
  stroke(context, wall, false, shades.steel, 1.7);
  hatch(context, wall, shades, 7);
}

function dimension(context: Context, line: Line, points: Float64Array, shades: Colours): void {
  stroke(context, points, false, shades.muted, 1);
  const last = points.length - 2;
  if (last < 2) return;
  arrow(context, points, 0, 2, shades.muted);
  arrow(context, points, last, last - 2, shades.muted);
  if (line.label === "") return;
  const [x0, y0] = [points[0] ?? 0, points[1] ?? 0];
  const [x1, y1] = [points[last] ?? 0, points[last + 1] ?? 0];
  let angle = Math.atan2(y1 - y0, x1 - x0);
  if (angle > Math.PI / 2 + 1e-6 || angle <= -Math.PI / 2 + 1e-6) angle += Math.PI;
  context.save();
  context.translate((x0 + x1) / 2, (y0 + y1) / 2);
  context.rotate(angle);
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.font = `11px ${FONT}`;
  const fits = context.measureText(line.label).width + 22 < Math.hypot(x1 - x0, y1 - y0);
  name(context, line.label, 0, fits ? 0 : -9, shades.ink, shades.paper);
  context.restore();
}

function arrow(context: Context, points: Float64Array, tip: number, inner: number, colour: string): void {
  const [x, y] = [points[tip] ?? 0, points[tip + 1] ?? 0];
  const [dx, dy] = [(points[inner] ?? 0) - x, (points[inner + 1] ?? 0) - y];
  const size = Math.hypot(dx, dy) || 1;
  const [ux, uy] = [dx / size, dy / size];
  context.beginPath();
  context.moveTo(x, y);
  context.lineTo(x + 8 * ux - 2.2 * uy, y + 8 * uy + 2.2 * ux);
  context.lineTo(x + 8 * ux + 2.2 * uy, y + 8 * uy - 2.2 * ux);
  context.closePath();
  context.fillStyle = colour;
  context.fill();
}

function pivot(context: Context, x: number, y: number, shades: Colours): void {
  context.beginPath();
  context.moveTo(x, y);
  context.lineTo(x - 9, y + 14);
  context.lineTo(x + 9, y + 14);
  context.closePath();
  context.fillStyle = shades.grid;
  context.fill();
  context.strokeStyle = shades.ink;
  context.lineWidth = 1.2;
  context.stroke();
  const base = Float64Array.of(x - 13, y + 14, x + 13, y + 14);
  stroke(context, base, false, shades.ink, 1.2);
  hatch(context, base, shades, 6);
}

function block(context: Context, x: number, y: number, along: [number, number], shades: Colours): void {
  context.save();
  context.translate(x, y);
  context.rotate(Math.atan2(along[1], along[0]));
  context.fillStyle = shades.grid;
  context.strokeStyle = shades.steel;
  context.lineWidth = 1.5;
  context.beginPath();
  context.roundRect(-BLOCK.x, -BLOCK.y, 2 * BLOCK.x, 2 * BLOCK.y, 2);
  context.fill();
  context.stroke();
  context.restore();
}

/** A name with an edge in the colour of the paper, which hides lines behind it. */
export function name(context: Context, text: string, x: number, y: number, colour: string, paper: string): void {
  context.setLineDash([]);
  context.lineJoin = "round";
  context.lineWidth = 3.5;
  context.strokeStyle = paper;
  context.strokeText(text, x, y);
  context.fillStyle = colour;
  context.fillText(text, x, y);
}

/** A colour mixed with another; both are written #rrggbb or #rgb. */
export function mixed(colour: string, other: string, share: number): string {
  const [a, b] = [channels(colour), channels(other)];
  return `rgb(${a.map((value, k) => Math.round(share * value + (1 - share) * (b[k] ?? 0))).join(" ")})`;
}

function channels(colour: string): number[] {
  const digits = colour.length === 4 ? [1, 1, 2, 2, 3, 3] : [1, 2, 3, 4, 5, 6];
  const long = digits.map((at) => colour[at] ?? "0").join("");
  return [0, 2, 4].map((at) => Number.parseInt(long.slice(at, at + 2), 16));
}
