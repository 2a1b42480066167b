import { useSignal, useSignalEffect } from "@preact/signals";
import { useRef } from "preact/hooks";
import { t } from "../../text";
import { Button, Zoom } from "../../ui";
import { BorderHandles } from "./border-handles";
import { Compare, CompareLine } from "./compare";
import {
  closeTo,
  heldKnot,
  heldView,
  type Knot,
  middleKnot,
  type View,
  weaverNumbers,
  wholeView,
  zoomed,
} from "./geometry";
import { Marks } from "./marks";
import type { CarpetModel } from "./model";
import { listenersOf, useHand } from "./use-hand";
import { useRenderer } from "./use-renderer";

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
              hover={hover.value}
              hand={hand}
            />
          )}
        </div>
        {chart !== null && <CompareLine model={model} />}
        {chart !== null && <BorderHandles model={model} grid={chart.grid} view={view.value} size={size.value} />}
        <Zoom
          onZoom={zoom}
          onFit={() => {
            if (chart !== null) view.value = wholeView(chart.grid, size.peek());
          }}
        >
          <Button
            size="small"
            onClick={() => {
              if (chart !== null)
                view.value = closeTo(cursor.peek() ?? middleKnot(view.peek()), chart.grid, size.peek());
            }}
          >
            {t("carpet.zoomKnots")}
          </Button>
        </Zoom>
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

function NoWebGl() {
  return (
    <div class="ui-callout warn carpet-missing" role="alert">
      <strong>{t("carpet.noWebGl")}</strong>
      <p>{t("carpet.noWebGlHelp")}</p>
    </div>
  );
}
