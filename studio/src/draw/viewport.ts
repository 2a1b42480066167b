/** The part of a drawing that is shown: to scale, zoomed and moved. */
import type { Signal } from "@preact/signals";
import type { Numbers, ShownDrawing } from "./figures";

/** Box around points [m]. */
export interface Extent {
  left: number;
  right: number;
  low: number;
  high: number;
}

/** Zoom, 1: the whole drawing; and how far its middle lies from the middle of the stage, in drawings. */
export interface View {
  zoom: number;
  x: number;
  y: number;
}

export const WHOLE: View = { zoom: 1, x: 0, y: 0 };
const MOST = 60;

/** Maps points [m] to pixels: px = x0 + x * scale, py = y0 - y * scale. */
export interface Map2D {
  scale: number;
  x0: number;
  y0: number;
}

/** Widens a box to hold points, x and y in turn; gaps are null or NaN. */
export function include(extent: Extent, points: Numbers | Float64Array): void {
  for (let k = 0; k + 1 < points.length; k += 2) {
    const [x, y] = [points[k], points[k + 1]];
    if (x == null || y == null) continue;
    if (x < extent.left) extent.left = x;
    if (x > extent.right) extent.right = x;
    if (y < extent.low) extent.low = y;
    if (y > extent.high) extent.high = y;
  }
}

/** The box around a drawing. */
export function extentOf(drawing: ShownDrawing): Extent {
  const far = Number.POSITIVE_INFINITY;
  const extent = { left: far, right: -far, low: far, high: -far };
  for (const stroke of drawing.strokes) include(extent, stroke.points);
  for (const dot of drawing.dots) include(extent, dot.at);
  return extent;
}

/** The map that shows a box as large as a stage allows, with a margin for names. */
export function mapOf(extent: Extent, view: View, width: number, height: number, margin = 30): Map2D {
  const box = extent.left <= extent.right ? extent : { left: 0, right: 1, low: 0, high: 1 };
  const [wide, high] = [Math.max(box.right - box.left, 1e-12), Math.max(box.high - box.low, 1e-12)];
  const fit = Math.min((width - 2 * margin) / wide, (height - 2 * margin - 14) / high);
  const scale = fit * view.zoom;
  const [middleX, middleY] = [(box.left + box.right) / 2, (box.low + box.high) / 2];
  return {
    scale,
    x0: width / 2 + view.x * width - middleX * scale,
    y0: (height - 14) / 2 + view.y * height + middleY * scale,
  };
}

/** A view zoomed by a factor about a point of the stage, given in shares of it from its middle. */
export function zoomed(view: View, by: number, x = 0, y = 0): View {
  const zoom = Math.min(Math.max(view.zoom * by, 1), MOST);
  const real = zoom / view.zoom;
  if (zoom === 1) return WHOLE;
  return { zoom, x: x - (x - view.x) * real, y: y - (y - view.y) * real };
}

const STEP = 0.1;

/** What a key does to a view; undefined for other keys. */
export function viewKeyed(key: string, view: View): View | undefined {
  if (key === "+" || key === "=") return zoomed(view, 1.4);
  if (key === "-") return zoomed(view, 1 / 1.4);
  if (key === "0") return WHOLE;
  const by = { ArrowLeft: [STEP, 0], ArrowRight: [-STEP, 0], ArrowUp: [0, STEP], ArrowDown: [0, -STEP] }[key];
  return by === undefined ? undefined : { ...view, x: view.x + (by[0] ?? 0), y: view.y + (by[1] ?? 0) };
}

/** Handlers that zoom and move a view by pointers, wheel and keys. */
export function viewHandlers(view: Signal<View>) {
  const pointers = new Map<number, { x: number; y: number }>();
  const shares = (event: MouseEvent, box: DOMRect) => ({
    x: (event.clientX - box.left) / box.width - 0.5,
    y: (event.clientY - box.top) / box.height - 0.5,
  });
  const boxOf = (event: Event) => (event.currentTarget as HTMLElement).getBoundingClientRect();
  return {
    onWheel(event: WheelEvent) {
      if (!(event.ctrlKey || event.metaKey)) return;
      event.preventDefault();
      const { x, y } = shares(event, boxOf(event));
      view.value = zoomed(view.peek(), 1.0016 ** -event.deltaY, x, y);
    },
    onDblClick(event: MouseEvent) {
      const { x, y } = shares(event, boxOf(event));
      view.value = zoomed(view.peek(), 2, x, y);
    },
    onPointerDown(event: PointerEvent) {
      if ((event.target as HTMLElement).closest("button")) return;
      pointers.set(event.pointerId, shares(event, boxOf(event)));
      if (view.peek().zoom > 1) (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
    },
    onPointerMove(event: PointerEvent) {
      const before = pointers.get(event.pointerId);
      if (before === undefined) return;
      const now = shares(event, boxOf(event));
      const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
      pointers.set(event.pointerId, now);
      if (other !== undefined) {
        const apart = (point: { x: number; y: number }) => Math.hypot(point.x - other.x, point.y - other.y) || 1e-3;
        view.value = zoomed(view.peek(), apart(now) / apart(before), other.x, other.y);
      } else if (view.peek().zoom > 1) {
        const { zoom, x, y } = view.peek();
        view.value = { zoom, x: x + now.x - before.x, y: y + now.y - before.y };
      }
    },
    onPointerUp: (event: PointerEvent) => pointers.delete(event.pointerId),
    onPointerCancel: (event: PointerEvent) => pointers.delete(event.pointerId),
    onKeyDown(event: KeyboardEvent) {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if ((event.target as HTMLElement).closest("button")) return;
      const to = viewKeyed(event.key, view.peek());
      if (to === undefined) return;
      event.preventDefault();
      view.value = to;
    },
  };
}
