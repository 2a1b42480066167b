import { t } from "../../text";
import { bordersOf, draggedWidth, reachesOf } from "./borders";
import { canvasPoint, chartPoint, type Grid, type Size, type View } from "./geometry";
import type { CarpetModel } from "./model";

interface HandlesProps {
  model: CarpetModel;
  grid: Grid;
  view: View;
  size: Size;
}

/** The inner edges of the borders, at the left of the chart: dragged, or moved by the arrow keys. */
export function BorderHandles({ model, grid, view, size }: HandlesProps) {
  const borders = bordersOf(model.recipe.value);
  if (model.tool.value !== "border") return null;
  const widen = (number: number, column: number) => {
    const width = draggedWidth(borders, number, column, grid);
    if (width !== borders[number]?.width)
      model.set({ border: borders.map((border, index) => (index === number ? { ...border, width } : border)) });
  };
  const reaches = reachesOf(borders);
  return (
    <>
      {reaches.map(({ begin, width }, number) => {
        // One below the other: thin borders lie near together.
        const line = (grid.rows * (number + 1)) / (reaches.length + 1);
        const { x, y } = canvasPoint(view, grid, size, begin + width, line);
        const drag = (event: PointerEvent) => {
          const handle = event.currentTarget as HTMLElement;
          const box = handle.parentElement?.getBoundingClientRect();
          if (box === undefined || !handle.hasPointerCapture(event.pointerId)) return;
          widen(number, chartPoint(view, grid, size, event.clientX - box.left, event.clientY - box.top).x);
        };
        const key = (event: KeyboardEvent) => {
          const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
          if (step === undefined) return;
          event.preventDefault();
          widen(number, begin + width + step);
        };
        return (
          <button
            key={number}
            type="button"
            class="carpet-handle carpet-border-handle"
            style={{ left: `${x}px`, top: `${y}px` }}
            aria-label={t("carpet.dragBorder", { number: number + 1, count: width })}
            onPointerDown={(event) => event.currentTarget.setPointerCapture(event.pointerId)}
            onPointerMove={drag}
            onKeyDown={key}
          >
            {number + 1}
          </button>
        );
      })}
    </>
  );
}
