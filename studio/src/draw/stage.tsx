import type { Signal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useMemo } from "preact/hooks";
import { t } from "../text";
import { shownUnit, Zoom } from "../ui";
import { FONT } from "./canvas";
import { colours } from "./looks";
import { roundStep, tickLabels } from "./ticks";
import { type Map2D, type View, viewHandlers, WHOLE, zoomed } from "./viewport";

interface StageProps {
  label: string;
  height: number;
  view: Signal<View>;
  /** Canvases, one over the other. */
  children: ComponentChildren;
}

/** The stage of a drawing: zoomed by buttons, keys, Ctrl and the wheel, or two fingers; moved by a drag or arrow keys. */
export function Stage({ label, height, view, children }: StageProps) {
  const handlers = useMemo(() => viewHandlers(view), [view]);
  const whole = view.value.zoom === 1 && view.value.x === 0 && view.value.y === 0;
  return (
    <div class={`fig-stage${whole ? "" : " zoomed"}`} style={{ height: `${height}px` }}>
      <div
        class="fig-view"
        role="application"
        tabIndex={0}
        aria-label={label}
        aria-description={t("figure.drawingKeys")}
        {...handlers}
      >
        {children}
      </div>
      <Zoom
        onZoom={(factor) => {
          view.value = zoomed(view.peek(), factor);
        }}
        onFit={() => {
          view.value = WHOLE;
        }}
        whole={whole}
        least={view.value.zoom === 1}
      />
    </div>
  );
}

/** A bar of a round length at the lower left. */
export function paintScaleBar(
  context: CanvasRenderingContext2D,
  map: Map2D,
  factor: number,
  unit: string,
  width: number,
  height: number,
): void {
  const aim = (0.2 * width) / map.scale / factor;
  const decade = 10 ** Math.floor(Math.log10(aim));
  const length = [5, 2, 1].map((step) => step * decade).find((step) => step <= aim * 1.0001) ?? roundStep(aim);
  const shades = colours();
  const [left, low, right] = [10.5, height - 10.5, 10.5 + length * factor * map.scale];
  context.strokeStyle = shades.ink;
  context.lineWidth = 1;
  context.setLineDash([]);
  context.beginPath();
  context.moveTo(left, low - 4);
  context.lineTo(left, low + 4);
  context.moveTo(left, low);
  context.lineTo(right, low);
  context.moveTo(right, low - 4);
  context.lineTo(right, low + 4);
  context.stroke();
  context.font = `11px ${FONT}`;
  context.textAlign = "left";
  context.textBaseline = "middle";
  context.fillStyle = shades.muted;
  context.fillText(`${tickLabels([length])[0] ?? ""} ${shownUnit(unit)}`, right + 7, low);
}
