/** Painting of a plot: axes, marks, curves, cursor. */
import { formatNumber } from "../text";
import { fromSi, parseUnit } from "../ui";
import { FONT } from "./canvas";
import { valueAt } from "./cursor";
import type { Numbers, ShownPlot } from "./figures";
import { colourOf, colours, dashesOf, markerOf } from "./looks";
import { roomy, type Span, spanOf, tickLabels, ticks, widened } from "./ticks";

/** Where a plot's data lie on its canvas [px], and what it shows [SI]. */
export interface Layout {
  left: number;
  right: number;
  top: number;
  bottom: number;
  x: Span;
  y: Span;
}

const SMALL = `11px ${FONT}`;
const PIXELS_PER_TICK = { x: 74, y: 38 };

export interface Ranges {
  x: Span;
  y: Span;
}

/** The ranges of a plot's data [SI]. */
export function rangesOf(plot: ShownPlot): Ranges {
  const x = spanOf(plot.series.map((curve) => curve.x));
  const marks = plot.marks.filter((mark) => mark.x >= x.low && mark.x <= x.high).map((mark) => mark.x);
  return {
    x: widened({ low: Math.min(x.low, ...marks), high: Math.max(x.high, ...marks) }),
    y: spanOf(plot.series.map((curve) => curve.y)),
  };
}

/** Ranges of equal scales in both directions for a curve in a plane, which has no single ordinate for an abscissa. */
function equalScales(plot: ShownPlot, ranges: Ranges, room: number): Ranges {
  const rising = (x: Numbers) => x.every((value, k) => k === 0 || (value ?? 0) >= (x[k - 1] ?? 0));
  const { x, y } = ranges;
  if (plot.x.unit !== plot.y.unit || plot.series.some((curve) => rising(curve.x))) return ranges;
  const [wide, high] = [x.high - x.low, y.high - y.low];
  const [moreX, moreY] = [Math.max(high * room - wide, 0) / 2, Math.max(wide / room - high, 0) / 2];
  return { x: { low: x.low - moreX, high: x.high + moreX }, y: { low: y.low - moreY, high: y.high + moreY } };
}

/** Paints axes, marks and curves, and returns where they lie. */
export function paintPlot(
  context: CanvasRenderingContext2D,
  plot: ShownPlot,
  given: Ranges,
  width: number,
  height: number,
): Layout {
  const ranges = equalScales(plot, given, (width - 60) / (height - 40));
  const [fx, fy] = [parseUnit(plot.x.unit)?.factor ?? 1, parseUnit(plot.y.unit)?.factor ?? 1];
  const top = plot.marks.length > 0 ? 22 : 8;
  const bottom = height - 20;
  const count = Math.max(2, Math.min(7, Math.round((bottom - top) / PIXELS_PER_TICK.y)));
  const inUnit = { low: ranges.y.low / fy, high: ranges.y.high / fy };
  const room = roomy(inUnit, plot.y.unit, count);
  const rows = ticks(room, plot.y.unit, count);
  const names = tickLabels(rows);
  context.font = SMALL;
  const left = Math.ceil(Math.max(...names.map((name) => context.measureText(name).width), 18)) + 10;
  const right = width - 10;
  const layout = { left, right, top, bottom, x: ranges.x, y: { low: room.low * fy, high: room.high * fy } };
  paintAxes(context, layout, plot, rows, names, fx, fy);
  paintMarks(context, layout, plot);
  context.save();
  context.beginPath();
  context.rect(left - 1, top - 2, right - left + 2, bottom - top + 4);
  context.clip();
  for (const curve of plot.series) {
    context.strokeStyle = colourOf(curve.look);
    context.lineWidth = 1.8;
    context.setLineDash(dashesOf(curve.look, curve.dashed).map((length) => 1.8 * length));
    line(context, layout, curve.x, curve.y);
  }
  context.setLineDash([]);
  context.restore();
  if (plot.series.length > 1) {
    for (const [number, curve] of plot.series.entries()) {
      paintMarkers(context, layout, curve.x, curve.y, curve.look, number);
    }
  }
  return layout;
}

function paintAxes(
  context: CanvasRenderingContext2D,
  layout: Layout,
  plot: ShownPlot,
  rows: number[],
  names: string[],
  fx: number,
  fy: number,
): void {
  const { left, right, top, bottom } = layout;
  const shades = colours();
  const columns = ticks(
    { low: layout.x.low / fx, high: layout.x.high / fx },
    plot.x.unit,
    Math.max(2, (right - left) / PIXELS_PER_TICK.x),
  );
  context.lineWidth = 1;
  context.strokeStyle = shades.grid;
  context.beginPath();
  for (const row of rows) {
    const y = crisp(toY(layout, row * fy));
    context.moveTo(left, y);
    context.lineTo(right, y);
  }
  for (const column of columns) {
    const x = crisp(toX(layout, column * fx));
    context.moveTo(x, top);
    context.lineTo(x, bottom);
  }
  context.stroke();
  context.strokeStyle = shades.axis;
  context.beginPath();
  const zero = layout.y.low < 0 && layout.y.high > 0 ? toY(layout, 0) : bottom;
  context.moveTo(left, crisp(zero));
  context.lineTo(right, crisp(zero));
  context.stroke();
  context.font = SMALL;
  context.fillStyle = shades.muted;
  context.textBaseline = "middle";
  context.textAlign = "right";
  rows.forEach((row, at) => {
    context.fillText(names[at] ?? "", left - 6, toY(layout, row * fy));
  });
  context.textBaseline = "alphabetic";
  context.textAlign = "center";
  tickLabels(columns).forEach((name, at) => {
    const half = context.measureText(name).width / 2;
    context.fillText(name, Math.min(toX(layout, (columns[at] ?? 0) * fx), right + 9 - half), bottom + 14);
  });
}

function paintMarks(context: CanvasRenderingContext2D, layout: Layout, plot: ShownPlot): void {
  const shades = colours();
  context.font = SMALL;
  context.textBaseline = "alphabetic";
  context.textAlign = "left";
  let free = layout.left - 20;
  for (const mark of [...plot.marks].sort((a, b) => a.x - b.x)) {
    const x = toX(layout, mark.x);
    if (!(x >= layout.left - 1 && x <= layout.right + 1)) continue;
    context.strokeStyle = shades.muted;
    context.setLineDash([2, 3]);
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(crisp(x), layout.top - 4);
    context.lineTo(crisp(x), layout.bottom);
    context.stroke();
    context.setLineDash([]);
    const wide = context.measureText(mark.label).width;
    const from = Math.min(Math.max(x - wide / 2, layout.left - 20), layout.right + 8 - wide);
    if (from < free) continue;
    context.fillStyle = shades.ink;
    context.fillText(mark.label, from, layout.top - 8);
    free = from + wide + 8;
  }
}

/** A polyline with gaps. */
function line(context: CanvasRenderingContext2D, layout: Layout, x: Numbers, y: Numbers): void {
  const { left, bottom } = layout;
  const sx = (layout.right - left) / (layout.x.high - layout.x.low);
  const sy = (bottom - layout.top) / (layout.y.high - layout.y.low);
  context.beginPath();
  let open = false;
  for (let k = 0; k < x.length; k += 1) {
    const [a, b] = [x[k], y[k]];
    if (a == null || b == null) {
      open = false;
      continue;
    }
    const [px, py] = [left + (a - layout.x.low) * sx, bottom - (b - layout.y.low) * sy];
    if (open) context.lineTo(px, py);
    else context.moveTo(px, py);
    open = true;
  }
  context.stroke();
}

const MARKERS = 5;

/** A few markers along a curve, so that curves differ by more than colour. */
function paintMarkers(
  context: CanvasRenderingContext2D,
  layout: Layout,
  x: Numbers,
  y: Numbers,
  look: number,
  number: number,
): void {
  context.fillStyle = colourOf(look);
  for (let k = 0; k < MARKERS; k += 1) {
    const share = (k + 0.35 + 0.13 * (number % 5)) / MARKERS;
    const at = layout.x.low + share * (layout.x.high - layout.x.low);
    const value = valueAt(x, y, at);
    if (value !== null) fillMarker(context, look, toX(layout, at), toY(layout, value), 3.6);
  }
}

function fillMarker(context: CanvasRenderingContext2D, look: number, x: number, y: number, radius: number): void {
  context.beginPath();
  for (const [dx, dy] of markerOf(look)) context.lineTo(x + radius * dx, y + radius * dy);
  context.closePath();
  context.fill();
}

/** Paints the cursor and the points of the curves at it. */
export function paintCursor(context: CanvasRenderingContext2D, plot: ShownPlot, layout: Layout, at: number): void {
  const shades = colours();
  const x = toX(layout, at);
  context.strokeStyle = shades.accent;
  context.lineWidth = 1.4;
  context.beginPath();
  context.moveTo(x, layout.top - 3);
  context.lineTo(x, layout.bottom + 3);
  context.stroke();
  for (const curve of plot.series) {
    const value = valueAt(curve.x, curve.y, at);
    if (value === null) continue;
    context.beginPath();
    context.arc(x, toY(layout, value), 4, 0, 2 * Math.PI);
    context.fillStyle = colourOf(curve.look);
    context.fill();
    context.strokeStyle = shades.paper;
    context.lineWidth = 1.5;
    context.stroke();
  }
}

function toX(layout: Layout, value: number): number {
  return layout.left + ((value - layout.x.low) / (layout.x.high - layout.x.low)) * (layout.right - layout.left);
}

function toY(layout: Layout, value: number): number {
  return layout.bottom - ((value - layout.y.low) / (layout.y.high - layout.y.low)) * (layout.bottom - layout.top);
}

/** The abscissa [SI] below a pixel. */
export function fromX(layout: Layout, pixel: number): number {
  const share = (pixel - layout.left) / (layout.right - layout.left);
  return layout.x.low + Math.min(Math.max(share, 0), 1) * (layout.x.high - layout.x.low);
}

/** A value as it is shown beside a cursor. */
export function shownValue(value: number | null, unit: string): string {
  return value === null ? "–" : formatNumber(fromSi(value, unit), 4);
}

function crisp(at: number): number {
  return Math.round(at) + 0.5;
}
