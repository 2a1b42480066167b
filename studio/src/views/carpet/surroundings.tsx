import { useSignal, useSignalEffect } from "@preact/signals";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { t } from "../../text";
import { canvasPoint, type Size } from "./geometry";
import type { CarpetModel } from "./model";
import { Renderer } from "./renderer";

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
  const canvas = useRef<HTMLCanvasElement>(null);
  const renderer = useRef<Renderer | null>(null);
  const size = useSignal<Size>({ width: 1, height: 1 });
  const [missing, setMissing] = useState(false);
  useLayoutEffect(() => {
    const element = canvas.current;
    if (element === null) return undefined;
    renderer.current = Renderer.of(element);
    setMissing(renderer.current === null);
    const watch = new ResizeObserver(() => {
      const [width, height] = [Math.max(1, element.clientWidth), Math.max(1, element.clientHeight)];
      const ratio = Math.min(devicePixelRatio, 2);
      size.value = { width, height };
      renderer.current?.resize(Math.round(width * ratio), Math.round(height * ratio));
    });
    watch.observe(element);
    return () => {
      watch.disconnect();
      renderer.current?.end();
      renderer.current = null;
    };
  }, []);
  useSignalEffect(() => {
    const chart = model.chart.value;
    if (chart === null) return;
    renderer.current?.setYarns(chart.about.yarns);
    renderer.current?.setChart(chart.grid, chart.knots);
  });
  const grid = model.chart.value?.grid;
  const line = (grid?.rows ?? 1) - row;
  const { width, height } = size.value;
  const view = { x: first + cells / 2, y: line + 0.5, scale: SCALE };
  useEffect(() => {
    if (width > 1) renderer.current?.show({ view, split: 1, left: "chart" });
  }, [view.x, view.y, width, height]);
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
