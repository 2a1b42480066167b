import { useSignal } from "@preact/signals";
import { useMemo } from "preact/hooks";
import { parseUnit } from "../ui";
import { useCanvas } from "./canvas";
import type { ShownDrawing } from "./figures";
import { type Named, paintNames } from "./names";
import { paintScaleBar, Stage } from "./stage";
import { byRole, paintDot, paintStroke, placed } from "./strokes";
import { type Extent, extentOf, type Map2D, mapOf, type View, WHOLE } from "./viewport";

interface DrawingProps {
  drawing: ShownDrawing;
  title: string;
  height?: number | undefined;
  /** The box that is shown [m]; without it that of the drawing. */
  extent?: Extent;
}

/** A drawing to scale. */
export function Drawing({ drawing, title, height = 300, extent }: DrawingProps) {
  const box = useMemo(() => extent ?? extentOf(drawing), [drawing, extent]);
  const view = useSignal<View>(WHOLE);
  const canvas = useCanvas(
    (context, width, high) => {
      const map = mapOf(box, view.peek(), width, high);
      paintDrawing(context, drawing, map);
      paintNames(context, namesOf(drawing, map), width, high - 18);
      paintScaleBar(context, map, parseUnit(drawing.unit)?.factor ?? 1, drawing.unit, width, high);
    },
    [drawing, box],
    [view],
  );
  return (
    <Stage label={title} height={height} view={view}>
      <canvas ref={canvas} />
    </Stage>
  );
}

/** Paints strokes and dots, without names. */
export function paintDrawing(context: CanvasRenderingContext2D, drawing: ShownDrawing, map: Map2D): void {
  for (const stroke of byRole(drawing.strokes)) paintStroke(context, stroke, placed(stroke.points, map));
  for (const dot of drawing.dots) {
    paintDot(context, dot.role, map.x0 + dot.at[0] * map.scale, map.y0 - dot.at[1] * map.scale);
  }
}

/** Names of dots, and of strokes once each; `seen`: names that are shown already. */
export function namesOf(drawing: ShownDrawing, map: Map2D, seen = new Set<string>()): Named[] {
  const made: Named[] = [];
  for (const dot of drawing.dots) {
    if (dot.label === "") continue;
    const at: [number, number] = [map.x0 + dot.at[0] * map.scale, map.y0 - dot.at[1] * map.scale];
    made.push({ text: dot.label, anchors: [at], bold: true, look: -1, clear: 8 });
  }
  for (const stroke of drawing.strokes) {
    if (stroke.label === "" || stroke.role === "dimension" || seen.has(stroke.label)) continue;
    seen.add(stroke.label);
    const anchors = anchorsOf(placed(stroke.points, map));
    made.push({ text: stroke.label, anchors, bold: false, look: stroke.look, clear: stroke.role === "link" ? 9 : 5 });
  }
  return made;
}

const SHARES = [0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0, 1];

/** Points along a line, its middle first. */
export function anchorsOf(points: Float64Array): [number, number][] {
  const along = [0];
  for (let k = 2; k + 1 < points.length; k += 2) {
    const step = Math.hypot((points[k] ?? 0) - (points[k - 2] ?? 0), (points[k + 1] ?? 0) - (points[k - 1] ?? 0));
    along.push((along.at(-1) ?? 0) + (Number.isNaN(step) ? 0 : step));
  }
  const whole = along.at(-1) ?? 0;
  return SHARES.map((share) => {
    const after = Math.max(
      along.findIndex((length) => length >= share * whole),
      1,
    );
    const [from, to] = [along[after - 1] ?? 0, along[after] ?? 0];
    const part = to > from ? (share * whole - from) / (to - from) : 0;
    const mix = (k: number) =>
      (points[2 * after - 2 + k] ?? Number.NaN) * (1 - part) + (points[2 * after + k] ?? Number.NaN) * part;
    return [mix(0), mix(1)];
  });
}
