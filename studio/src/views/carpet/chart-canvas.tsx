import { useSignal, useSignalEffect } from "@preact/signals";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { t } from "../../text";
import { Button, IconButton } from "../../ui";
import { Compare, CompareLine } from "./compare";
import {
  canvasPoint,
  closeTo,
  type Grid,
  heldKnot,
  heldView,
  type Knot,
  middleKnot,
  type Size,
  type View,
  weaverNumbers,
  wholeView,
  zoomed,
} from "./geometry";
import type { CarpetModel } from "./model";
import { Renderer } from "./renderer";
import { handOf, useHand } from "./use-hand";

const ZOOM = 1.4;

/** The chart: zoom from the whole carpet to single knots, tools, row and knot under the pointer or the cursor. */
export function ChartCanvas({ model }: { model: CarpetModel }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const renderer = useRef<Renderer | null>(null);
  const view = useSignal<View>({ x: 0, y: 0, scale: 0 });
  const size = useSignal<Size>({ width: 1, height: 1 });
  const cursor = useSignal<Knot | null>(null);
  const hover = useSignal<Knot | null>(null);
  const [missing, setMissing] = useState(false);
  const [restored, setRestored] = useState(0);
  const shape = useRef("");
  /** The view of the whole carpet, which stays whole while the page changes its size. */
  const whole = useRef<View | null>(null);

  useLayoutEffect(() => {
    const element = canvas.current;
    if (element === null) return undefined;
    renderer.current = Renderer.of(element);
    if (renderer.current === null) {
      setMissing(true);
      return undefined;
    }
    const lost = (event: Event) => event.preventDefault();
    const back = () => setRestored((count) => count + 1);
    element.addEventListener("webglcontextlost", lost);
    element.addEventListener("webglcontextrestored", back);
    const watch = new ResizeObserver(() => {
      const ratio = Math.min(devicePixelRatio, 2);
      const [width, height] = [Math.max(1, element.clientWidth), Math.max(1, element.clientHeight)];
      size.value = { width, height };
      renderer.current?.resize(Math.round(width * ratio), Math.round(height * ratio));
    });
    watch.observe(element);
    return () => {
      watch.disconnect();
      element.removeEventListener("webglcontextlost", lost);
      element.removeEventListener("webglcontextrestored", back);
      renderer.current?.end();
      renderer.current = null;
    };
  }, [restored]);

  useSignalEffect(() => {
    const chart = model.chart.value;
    const held = size.value;
    if (chart === null || renderer.current === null || held.width < 2) return;
    const { rows, columns, aspect } = chart.grid;
    const key = `${rows} ${columns} ${aspect.toFixed(4)}`;
    const old = view.peek();
    const was = whole.current;
    whole.current = wholeView(chart.grid, held);
    const isWhole = was !== null && Math.abs(old.scale / was.scale - 1) < 1e-6;
    if (shape.current !== key || old.scale === 0 || isWhole) view.value = whole.current;
    else view.value = heldView(old, chart.grid, held);
    shape.current = key;
  });
  useSignalEffect(() => {
    const chart = model.chart.value;
    if (chart === null) return;
    renderer.current?.setYarns(chart.about.yarns);
    renderer.current?.setChart(chart.grid, chart.knots);
  });
  // A row that is looked up is shown with the cursor on it.
  useSignalEffect(() => {
    const [row, chart] = [model.sought.value, model.chart.peek()];
    if (row === null || chart === null) return;
    model.sought.value = null;
    const { columns, rows } = chart.grid;
    cursor.value = heldKnot({ column: Math.floor(columns / 2), line: rows - row }, chart.grid);
    hover.value = null;
    view.value = closeTo(cursor.value, chart.grid, size.peek());
  });
  useSignalEffect(() => {
    const source = model.source.value;
    if (source !== null) renderer.current?.setSource(source.width, source.height, source.pixels);
  });
  useSignalEffect(() => {
    const seen = view.value;
    if (seen.scale > 0 && size.value.width > 1)
      renderer.current?.show({ view: seen, split: model.split.value, left: model.left.value });
  });
  // What was sent to a lost context is sent again.
  useEffect(() => {
    if (restored === 0) return;
    const [chart, source] = [model.chart.peek(), model.source.peek()];
    if (chart !== null) {
      renderer.current?.setYarns(chart.about.yarns);
      renderer.current?.setChart(chart.grid, chart.knots);
    }
    if (source !== null) renderer.current?.setSource(source.width, source.height, source.pixels);
    renderer.current?.show({ view: view.peek(), split: model.split.peek(), left: model.left.peek() });
  }, [restored]);

  const hand = useHand({ model, canvas, renderer, view, size, cursor, hover });
  const chart = model.chart.value;
  const zoom = (factor: number) => {
    const { width, height } = size.peek();
    if (chart !== null) view.value = zoomed(view.peek(), chart.grid, size.peek(), factor, width / 2, height / 2);
  };
  if (missing) return <NoWebGl />;
  return (
    <div class="carpet-stage">
      <div class="carpet-sheet">
        <div
          class={`carpet-surface ${model.tool.value}`}
          tabIndex={0}
          role="application"
          aria-label={t("carpet.canvas")}
          aria-describedby="carpet-keys"
          {...handOf(hand)}
        >
          <canvas ref={canvas} />
          {chart !== null && (
            <Marks
              model={model}
              grid={chart.grid}
              view={view.value}
              size={size.value}
              cursor={cursor.value}
              hand={hand}
            />
          )}
        </div>
        {chart !== null && <CompareLine model={model} />}
        <div class="carpet-zoom">
          <IconButton icon="plus" label={t("ui.zoomIn")} onClick={() => zoom(ZOOM)} />
          <IconButton icon="minus" label={t("ui.zoomOut")} onClick={() => zoom(1 / ZOOM)} />
          <IconButton
            icon="fit"
            label={t("ui.zoomFit")}
            onClick={() => {
              if (chart !== null) view.value = wholeView(chart.grid, size.peek());
            }}
          />
          <Button
            size="small"
            onClick={() => {
              if (chart !== null)
                view.value = closeTo(cursor.peek() ?? middleKnot(view.peek()), chart.grid, size.peek());
            }}
          >
            {t("carpet.zoomKnots")}
          </Button>
        </div>
      </div>
      <p class="carpet-status" role="status">
        <KnotText model={model} knot={hover.value ?? cursor.value} />
      </p>
      <Compare model={model} />
      <p class="visually-hidden" id="carpet-keys">
        {t("carpet.keys")}
      </p>
    </div>
  );
}

function KnotText({ model, knot }: { model: CarpetModel; knot: Knot | null }) {
  const chart = model.chart.value;
  if (chart === null) return <span>{model.busy.value ? t("carpet.making") : t("carpet.noChart")}</span>;
  if (knot === null) {
    const { rows, columns } = chart.grid;
    return <span>{t("carpet.grid", { rows, columns })}</span>;
  }
  const yarn = model.yarnAt(knot);
  const { row, knot: number } = weaverNumbers(knot, chart.grid);
  return (
    <>
      <span class="carpet-swatch" style={{ background: yarn?.srgb ?? "transparent" }} aria-hidden="true" />
      <span>{t("carpet.atKnot", { row, knot: number, yarn: yarn?.name ?? "", symbol: yarn?.symbol ?? "" })}</span>
    </>
  );
}

interface MarksProps {
  model: CarpetModel;
  grid: Grid;
  view: View;
  size: Size;
  cursor: Knot | null;
  hand: ReturnType<typeof useHand>;
}

/** Cursor, tile and the part that is dragged, as lines over the chart. */
function Marks({ model, grid, view, size, cursor, hand }: MarksProps) {
  const part = hand.part.value;
  const tile = model.tool.value === "repeat" ? model.tile.value : null;
  const box = (first: Knot, last: Knot) => {
    const [left, right] = [Math.min(first.column, last.column), Math.max(first.column, last.column) + 1];
    const [top, bottom] = [Math.min(first.line, last.line), Math.max(first.line, last.line) + 1];
    const from = canvasPoint(view, grid, size, left, top);
    const to = canvasPoint(view, grid, size, right, bottom);
    return { x: from.x, y: from.y, width: to.x - from.x, height: to.y - from.y };
  };
  const line = hand.line.value;
  const ends = line?.map((knot) => canvasPoint(view, grid, size, knot.column + 0.5, knot.line + 0.5));
  return (
    <svg class="carpet-marks" aria-hidden="true">
      {tile !== null && <rect class="tile" {...box(tile[0], tile[1])} />}
      {part !== null && <rect class="part" {...box(part[0], part[1])} />}
      {ends?.[0] && ends[1] && <line class="part" x1={ends[0].x} y1={ends[0].y} x2={ends[1].x} y2={ends[1].y} />}
      {cursor !== null && (
        <>
          <rect
            class="row"
            {...box({ column: 0, line: cursor.line }, { column: grid.columns - 1, line: cursor.line })}
          />
          <rect class="cursor" {...box(cursor, cursor)} />
        </>
      )}
    </svg>
  );
}

function NoWebGl() {
  return (
    <div class="ui-callout warn carpet-missing" role="alert">
      <strong>{t("carpet.noWebGl")}</strong>
      <p>{t("carpet.noWebGlHelp")}</p>
    </div>
  );
}
