import { useEffect } from "preact/hooks";
import { t } from "../../text";
import { canvasPoint } from "./geometry";
import type { CarpetModel } from "./model";
import { useRenderer } from "./use-renderer";

/** Height of a knot [px]. */
const SCALE = 22;

interface SurroundingsProps {
  model: CarpetModel;
  /** Row from the lower edge. */
  row: number;
  /** First column of the run, from 0 at the left, and its cells. */
  first: number;
  cells: number;
}

/** The chart around the run that is tied: the rows below it are woven, those above it are to come. */
export function Surroundings({ model, row, first, cells }: SurroundingsProps) {
  const { canvas, renderer, size, restored, missing } = useRenderer(model);
  const grid = model.chart.value?.grid;
  const line = (grid?.rows ?? 1) - row;
  const { width, height } = size.value;
  const view = { x: first + cells / 2, y: line + 0.5, scale: SCALE };
  useEffect(() => {
    if (width > 1) renderer.current?.show({ view, split: 1, left: "chart" });
  }, [view.x, view.y, width, height, restored.value]);
  if (missing || grid === undefined) return null;
  const from = canvasPoint(view, grid, size.value, first, line);
  return (
    <div class="carpet-surroundings" role="img" aria-label={t("carpet.surroundings")}>
      <canvas ref={canvas} />
      <svg class="carpet-marks" aria-hidden="true">
        <rect class="row" x={-9} y={from.y} width={width + 18} height={SCALE} />
        <rect x={from.x} y={from.y} width={cells * SCALE * grid.aspect} height={SCALE} />
      </svg>
    </div>
  );
}
