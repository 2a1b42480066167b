import { useMemo, useRef } from "preact/hooks";
import { t } from "../text";
import { formatQuantity, shownUnit } from "../ui";
import { useCanvas } from "./canvas";
import { greatestOf, isAngle, keyed, moveTo, quiet, useCursor, valueAt, within } from "./cursor";
import type { ShownPlot } from "./figures";
import { Swatch } from "./legend";
import { fromX, type Layout, paintCursor, paintPlot, type Ranges, rangesOf, shownValue } from "./plot-paint";

interface PlotProps {
  plot: ShownPlot;
  title: string;
  /** Height of the curves [px]. */
  height?: number | undefined;
  /** Ranges that are kept while the data change; without them those of the data. */
  ranges?: Ranges | undefined;
}

/** Curves over one axis. The pointer and the arrow keys move the cursor that all figures over this quantity share. */
export function Plot({ plot, title, height = 210, ranges }: PlotProps) {
  const own = useMemo(() => rangesOf(plot), [plot]);
  const shown = ranges ?? own;
  const cursor = useCursor(plot.x.label);
  const layout = useRef<Layout | null>(null);
  const base = useCanvas(
    (context, width, high) => {
      layout.current = paintPlot(context, plot, shown, width, high);
    },
    [plot, shown],
  );
  const angle = isAngle(plot.x.unit);
  const whole = useMemo(() => plot.series.every((curve) => curve.x.every((x) => Number.isInteger(x))), [plot]);
  const inside = (value: number | null) => (value === null ? null : within(value, shown.x.low, shown.x.high, angle));
  const over = useCanvas(
    (context, width, high) => {
      const at = inside(cursor.at.peek());
      if (at === null) return;
      layout.current ??= paintPlot(context, plot, shown, width, high);
      paintCursor(context, plot, layout.current, at);
    },
    [plot, shown],
    [cursor.at],
  );
  const point = (event: PointerEvent) => {
    if (layout.current === null) return;
    const box = (event.currentTarget as HTMLElement).getBoundingClientRect();
    const to = fromX(layout.current, event.clientX - box.left);
    moveTo(cursor, whole ? Math.round(to) : to);
  };
  const at = inside(cursor.at.value);
  const reading = at === null ? "" : formatQuantity(at, plot.x.unit);
  const greatest = useMemo(() => greatestOf(plot.series.map((curve) => curve.y)), [plot]);
  const values = plot.series.map((curve) => {
    const value = at === null ? null : valueAt(curve.x, curve.y, at);
    return value === null ? null : quiet(value, greatest);
  });
  const spoken = plot.series.map(
    (curve, k) => `${curve.label} ${shownValue(values[k] ?? null, plot.y.unit)} ${shownUnit(plot.y.unit)}`,
  );
  return (
    <div class="fig-plot">
      <div class="fig-axis-names">
        <span>{withUnit(plot.y.label, plot.y.unit)}</span>
      </div>
      <div
        class="fig-field"
        style={{ height: `${height}px` }}
        role="slider"
        tabIndex={0}
        aria-label={title}
        aria-description={t("figure.plotKeys")}
        aria-valuemin={shown.x.low}
        aria-valuemax={shown.x.high}
        aria-valuenow={at ?? shown.x.low}
        aria-valuetext={at === null ? plot.x.label : `${plot.x.label} ${reading}: ${spoken.join(", ")}`}
        onPointerDown={(event) => {
          event.currentTarget.setPointerCapture(event.pointerId);
          point(event);
        }}
        onPointerMove={(event) => {
          const dragged = event.currentTarget.hasPointerCapture(event.pointerId);
          if (dragged || (event.pointerType === "mouse" && cursor.player.peek() === null)) point(event);
        }}
        onKeyDown={(event) => {
          const to = keyed(event, inside(cursor.at.peek()) ?? shown.x.low, shown.x.low, shown.x.high, plot.x.unit);
          if (to !== undefined) moveTo(cursor, to);
        }}
      >
        <canvas ref={base} />
        <canvas ref={over} />
      </div>
      <div class="fig-axis-names fig-lower">
        <span>{withUnit(plot.x.label, plot.x.unit)}</span>
      </div>
      <PlotLegend plot={plot} at={at} values={values} reading={reading} />
    </div>
  );
}

interface LegendProps {
  plot: ShownPlot;
  at: number | null;
  values: (number | null)[];
  reading: string;
}

function PlotLegend({ plot, at, values, reading }: LegendProps) {
  const several = plot.series.length > 1;
  return (
    <ul class="fig-legend">
      {at !== null && <li class="fig-at">{t("figure.at", { at: reading })}</li>}
      {plot.series.map((curve, k) => (
        <li key={k}>
          <Swatch look={curve.look} dashed={curve.dashed} marked={several} />
          <span>{curve.label || plot.y.label}</span>
          {at !== null && <b>{values[k] == null ? "–" : formatQuantity(values[k], plot.y.unit)}</b>}
        </li>
      ))}
    </ul>
  );
}

/** A label with its unit in brackets. */
export function withUnit(label: string, unit: string): string {
  const printed = shownUnit(unit);
  return printed === "" ? label : `${label} [${printed}]`;
}
