import { useSignal, useSignalEffect } from "@preact/signals";
import { useRef } from "preact/hooks";
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
import { drawsLive } from "./pointer";
import { speckPath } from "./specks";
import { listenersOf, useHand } from "./use-hand";
import { useRenderer } from "./use-renderer";

const ZOOM = 1.4;

/** The chart: zoom from the whole carpet to single knots, tools, row and knot under the pointer or the cursor. */
export function ChartCanvas({ model }: { model: CarpetModel }) {
  const { canvas, renderer, size, restored, missing } = useRenderer(model);
  const view = useSignal<View>({ x: 0, y: 0, scale: 0 });
  const cursor = useSignal<Knot | null>(null);
  const hover = useSignal<Knot | null>(null);
  const shape = useRef("");
  /** The view of the whole carpet, which stays whole while the page changes its size. */
  const whole = useRef<View | null>(null);

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
    restored.value;
    const source = model.source.value;
    if (source !== null) renderer.current?.setSource(source.width, source.height, source.pixels);
  });
  useSignalEffect(() => {
    restored.value;
    const seen = view.value;
    if (seen.scale > 0 && size.value.width > 1)
      renderer.current?.show({ view: seen, split: model.split.value, left: model.left.value });
  });
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
          {...listenersOf(hand)}
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
  const specks = model.specks.value;
  const tile = model.tool.value === "repeat" ? model.tile.value : null;
  const box = (first: Knot, last: Knot) => {
    const [left, right] = [Math.min(first.column, last.column), Math.max(first.column, last.column) + 1];
    const [top, bottom] = [Math.min(first.line, last.line), Math.max(first.line, last.line) + 1];
    const from = canvasPoint(view, grid, size, left, top);
    const to = canvasPoint(view, grid, size, right, bottom);
    return { x: from.x, y: from.y, width: to.x - from.x, height: to.y - from.y };
  };
  const line = hand.line.value;
  const axes = drawsLive(model.tool.value) ? model.symmetry.value : "none";
  const middle = canvasPoint(view, grid, size, grid.columns / 2, grid.rows / 2);
  const ends = line?.map((knot) => canvasPoint(view, grid, size, knot.column + 0.5, knot.line + 0.5));
  return (
    <svg class="carpet-marks" aria-hidden="true">
      {specks !== null && model.specksShown.value && <path class="specks" d={speckPath(specks, grid, view, size)} />}
      {(axes === "across" || axes === "both") && (
        <line class="axis" x1={middle.x} y1={0} x2={middle.x} y2={size.height} />
      )}
      {(axes === "along" || axes === "both") && (
        <line class="axis" x1={0} y1={middle.y} x2={size.width} y2={middle.y} />
      )}
      {axes === "turned" && <circle class="axis" cx={middle.x} cy={middle.y} r={8} />}
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
