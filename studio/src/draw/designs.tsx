/** Designs of a study: parallel coordinates with a brush on each axis, and each pair of columns as a scatter. */
import type { ComponentChildren } from "preact";
import { useMemo, useRef, useState } from "preact/hooks";
import { t } from "../text";
import { Button, formatQuantity, parseUnit } from "../ui";
import { FONT, useCanvas } from "./canvas";
import type { ShownCloud } from "./figures";
import { Patch } from "./legend";
import { colourOf, colours } from "./looks";
import { withUnit } from "./plot";
import { type Span, spanOf, tickLabels, ticks } from "./ticks";

const [SIDE, TOP, FOOT] = [64, 34, 10];
const GRASP = 18;
const MOST_COLUMNS = 6;
const SMALL = `11px ${FONT}`;

/** Ranges of columns [SI] by their number: a design outside of one is left out. */
type Brushes = ReadonlyMap<number, Span>;

interface Field {
  width: number;
  height: number;
}

const axisX = (field: Field, column: number, count: number) =>
  SIDE + (column * (field.width - 2 * SIDE)) / Math.max(count - 1, 1);
const axisY = (field: Field, span: Span, value: number) =>
  field.height - FOOT - ((value - span.low) / (span.high - span.low)) * (field.height - TOP - FOOT);

interface DesignsProps {
  cloud: ShownCloud;
  title: string;
  height?: number;
  /** What can be done with a design that is chosen, by its number in the figure. */
  children?: (design: number) => ComponentChildren;
}

/** The designs of a study; a press on one gives the command that makes it. */
export function Designs({ cloud, title, height = 300, children }: DesignsProps) {
  const spans = useMemo(() => cloud.values.map((row) => spanOf([row])), [cloud]);
  const [brushes, setBrushes] = useState<Brushes>(new Map());
  const [hidden, setHidden] = useState<ReadonlySet<number>>(new Set());
  const [chosen, setChosen] = useState<number | null>(null);
  const kept = useMemo(() => keptOf(cloud, brushes, hidden), [cloud, brushes, hidden]);
  const step = (by: number) => {
    const at = chosen === null ? (by > 0 ? -1 : 0) : kept.indexOf(chosen);
    setChosen(kept[(at + by + kept.length) % kept.length] ?? null);
  };
  return (
    <div
      role="application"
      tabIndex={0}
      aria-label={title}
      aria-description={t("figure.designKeys")}
      onKeyDown={(event) => {
        if (event.target !== event.currentTarget) return;
        if (event.key === "ArrowRight" || event.key === "ArrowLeft") step(event.key === "ArrowRight" ? 1 : -1);
        else if (event.key === "Escape") setBrushes(new Map());
        else return;
        event.preventDefault();
      }}
    >
      <p class="ui-help">{t("figure.designHelp")}</p>
      <Parallel {...{ cloud, spans, brushes, setBrushes, kept, chosen, setChosen, height }} />
      <ul class="fig-legend">
        <li class="fig-at">{t("figure.designsKept", { kept: kept.length, all: cloud.kind.length })}</li>
        {cloud.kinds.map(
          (kind, k) =>
            cloud.kind.includes(k) && (
              <li key={kind}>
                <Button
                  size="small"
                  kind="quiet"
                  pressed={!hidden.has(k)}
                  onClick={() => {
                    const next = new Set(hidden);
                    if (!next.delete(k)) next.add(k);
                    setHidden(next);
                  }}
                >
                  <Patch look={cloud.looks[k] ?? k} pale={hidden.has(k)} />
                  {`${kind} (${cloud.kind.filter((one) => one === k).length})`}
                </Button>
              </li>
            ),
        )}
      </ul>
      {chosen !== null && <Chosen cloud={cloud} design={chosen} />}
      {chosen !== null && children?.(chosen)}
      <Scatters {...{ cloud, spans, kept, chosen, setChosen }} />
    </div>
  );
}

/** The designs that no brush and no kind leaves out. */
export function keptOf(cloud: ShownCloud, brushes: Brushes, hidden: ReadonlySet<number>): number[] {
  const inside = (design: number) =>
    [...brushes].every(([column, { low, high }]) => {
      const value = cloud.values[column]?.[design];
      return value != null && value >= low && value <= high;
    });
  return cloud.kind.flatMap((kind, design) => (kind !== null && !hidden.has(kind) && inside(design) ? [design] : []));
}

interface Shown {
  cloud: ShownCloud;
  spans: Span[];
  kept: number[];
  chosen: number | null;
  setChosen: (design: number) => void;
}

interface ParallelProps extends Shown {
  brushes: Brushes;
  setBrushes: (brushes: Brushes) => void;
  height: number;
}

function Parallel({ cloud, spans, brushes, setBrushes, kept, chosen, setChosen, height }: ParallelProps) {
  const field = useRef<Field>({ width: 600, height });
  const grasped = useRef<{ column: number; from: number } | null>(null);
  const count = cloud.columns.length;
  const canvas = useCanvas(
    (context, width, high) => {
      field.current = { width, height: high };
      paintLines(context, field.current, cloud, spans, kept, chosen);
      cloud.columns.forEach((_, column) => {
        paintAxis(context, field.current, cloud, spans, column, brushes.get(column));
      });
    },
    [cloud, kept, chosen, brushes],
  );
  const placeOf = (event: PointerEvent) => {
    const box = (event.currentTarget as Element).getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  const valueAtHeight = (column: number, y: number) => {
    const { low, high } = spans[column] ?? { low: 0, high: 1 };
    const share = (field.current.height - FOOT - y) / (field.current.height - TOP - FOOT);
    return low + Math.min(Math.max(share, 0), 1) * (high - low);
  };
  return (
    <div
      class="fig-field"
      style={{ height: `${height}px`, touchAction: "none" }}
      onPointerDown={(event) => {
        const { x, y } = placeOf(event);
        const near = cloud.columns.findIndex((_, k) => Math.abs(axisX(field.current, k, count) - x) < GRASP);
        if (near < 0) {
          const found = nearestLine(field.current, cloud, spans, kept, x, y);
          if (found !== null) setChosen(found);
          return;
        }
        event.currentTarget.setPointerCapture(event.pointerId);
        grasped.current = { column: near, from: valueAtHeight(near, y) };
        const next = new Map(brushes);
        next.delete(near);
        setBrushes(next);
      }}
      onPointerMove={(event) => {
        if (grasped.current === null) return;
        const { column, from } = grasped.current;
        const to = valueAtHeight(column, placeOf(event).y);
        setBrushes(new Map(brushes).set(column, { low: Math.min(from, to), high: Math.max(from, to) }));
      }}
      onPointerUp={() => {
        grasped.current = null;
      }}
    >
      <canvas ref={canvas} />
    </div>
  );
}

function paintLines(
  context: CanvasRenderingContext2D,
  field: Field,
  cloud: ShownCloud,
  spans: Span[],
  kept: number[],
  chosen: number | null,
): void {
  const shades = colours();
  const inside = new Set(kept);
  const stroke = (design: number) => {
    context.beginPath();
    cloud.values.forEach((row, column) => {
      const [x, value] = [axisX(field, column, cloud.columns.length), row[design]];
      const y = axisY(field, spans[column] as Span, value ?? Number.NaN);
      if (value == null) return;
      if (column > 0 && cloud.values[column - 1]?.[design] != null) context.lineTo(x, y);
      else context.moveTo(x, y);
    });
    context.stroke();
  };
  context.lineWidth = 1;
  context.strokeStyle = shades.grid;
  cloud.kind.forEach((_, design) => {
    if (!inside.has(design)) stroke(design);
  });
  for (const design of painted(cloud, kept)) {
    const kind = cloud.kind[design] ?? 0;
    context.strokeStyle = colourOf(cloud.looks[kind] ?? kind);
    context.globalAlpha = kind === 0 ? 1 : 0.45;
    context.lineWidth = kind === 0 ? 1.8 : 1;
    stroke(design);
  }
  context.globalAlpha = 1;
  if (chosen === null) return;
  [context.strokeStyle, context.lineWidth] = [shades.ink, 3];
  stroke(chosen);
}

/** Designs in the order in which they are painted: the first kind last, over all others. */
function painted(cloud: ShownCloud, kept: number[]): number[] {
  return [...kept].sort((a, b) => (cloud.kind[b] ?? 0) - (cloud.kind[a] ?? 0));
}

function paintAxis(
  context: CanvasRenderingContext2D,
  field: Field,
  cloud: ShownCloud,
  spans: Span[],
  column: number,
  brush: Span | undefined,
): void {
  const shades = colours();
  const [axis, span] = [cloud.columns[column], spans[column]];
  if (axis === undefined || span === undefined) return;
  const x = Math.round(axisX(field, column, cloud.columns.length)) + 0.5;
  [context.strokeStyle, context.lineWidth] = [shades.axis, 1];
  context.beginPath();
  context.moveTo(x, TOP);
  context.lineTo(x, field.height - FOOT);
  context.stroke();
  if (brush !== undefined) {
    const [above, below] = [axisY(field, span, brush.high), axisY(field, span, brush.low)];
    context.fillStyle = shades.accent;
    context.globalAlpha = 0.3;
    context.fillRect(x - 7, above, 14, Math.max(below - above, 2));
    context.globalAlpha = 1;
  }
  context.font = SMALL;
  context.textAlign = "left";
  context.textBaseline = "middle";
  const factor = parseUnit(axis.unit)?.factor ?? 1;
  const made = ticks({ low: span.low / factor, high: span.high / factor }, axis.unit, 5);
  tickLabels(made).forEach((label, k) => {
    const y = axisY(field, span, (made[k] ?? 0) * factor);
    context.fillStyle = shades.paper;
    context.globalAlpha = 0.75;
    context.fillRect(x + 3, y - 6, context.measureText(label).width + 2, 12);
    context.globalAlpha = 1;
    context.fillStyle = shades.muted;
    context.fillText(label, x + 4, y);
  });
  context.fillStyle = shades.ink;
  context.textAlign = "center";
  const room = (2 * (field.width - 2 * SIDE)) / Math.max(cloud.columns.length - 1, 1) - 8;
  const name = withUnit(axis.label, axis.unit);
  const half = Math.min(context.measureText(name).width, room) / 2 + 2;
  const middle = Math.min(Math.max(x, half), field.width - half);
  context.fillText(name, middle, column % 2 === 0 ? 8 : 22, Math.max(room, 60));
}

/** The design whose line is nearest to a place, at most 12 px away. */
function nearestLine(
  field: Field,
  cloud: ShownCloud,
  spans: Span[],
  kept: number[],
  x: number,
  y: number,
): number | null {
  const gap = (field.width - 2 * SIDE) / Math.max(cloud.columns.length - 1, 1);
  const left = Math.min(Math.max(Math.floor((x - SIDE) / gap), 0), cloud.columns.length - 2);
  const share = (x - SIDE) / gap - left;
  const away = (design: number) => {
    const [from, to] = [cloud.values[left]?.[design], cloud.values[left + 1]?.[design]];
    if (from == null || to == null) return Number.POSITIVE_INFINITY;
    const [first, then] = [axisY(field, spans[left] as Span, from), axisY(field, spans[left + 1] as Span, to)];
    return Math.abs(first + share * (then - first) - y);
  };
  return nearest(kept, away, 12);
}

function nearest(kept: number[], away: (design: number) => number, most: number): number | null {
  let [found, least]: [number | null, number] = [null, most];
  for (const design of kept) {
    const far = away(design);
    if (far < least) [found, least] = [design, far];
  }
  return found;
}

function Chosen({ cloud, design }: { cloud: ShownCloud; design: number }) {
  return (
    <div aria-live="polite">
      <dl class="fig-readings">
        {cloud.columns.map((axis, column) => (
          <div key={axis.label}>
            <dt>{axis.label}</dt>
            <dd>{formatQuantity(cloud.values[column]?.[design] ?? Number.NaN, axis.unit)}</dd>
          </div>
        ))}
        <div>
          <dd>{cloud.kinds[cloud.kind[design] ?? 0]}</dd>
        </div>
      </dl>
      <pre class="fig-command">{cloud.commands[design]}</pre>
    </div>
  );
}

/** Every pair of the last columns, which the results are among. */
function Scatters({ cloud, spans, kept, chosen, setChosen }: Shown) {
  const first = Math.max(cloud.columns.length - MOST_COLUMNS, 0);
  const pairs = cloud.columns.flatMap((_, y) =>
    cloud.columns.flatMap((_, x) => (x >= first && x < y ? [[x, y] as const] : [])),
  );
  return (
    <div class="fig-scatters">
      {pairs.map(([x, y]) => (
        <Scatter key={`${x} ${y}`} {...{ cloud, spans, kept, chosen, setChosen, x, y }} />
      ))}
    </div>
  );
}

function Scatter({ cloud, spans, kept, chosen, setChosen, x, y }: Shown & { x: number; y: number }) {
  const field = useRef<Field>({ width: 150, height: 150 });
  const at = (design: number): [number, number] | null => {
    const [a, b] = [cloud.values[x]?.[design], cloud.values[y]?.[design]];
    if (a == null || b == null) return null;
    const { width, height } = field.current;
    const [across, up] = [spans[x] as Span, spans[y] as Span];
    const share = (value: number, span: Span) => (value - span.low) / (span.high - span.low);
    return [6 + share(a, across) * (width - 12), height - 6 - share(b, up) * (height - 12)];
  };
  const canvas = useCanvas(
    (context, width, height) => {
      field.current = { width, height };
      const dot = (design: number, radius: number) => {
        const place = at(design);
        if (place === null) return;
        context.beginPath();
        context.arc(...place, radius, 0, 2 * Math.PI);
        context.fill();
      };
      for (const design of painted(cloud, kept)) {
        const kind = cloud.kind[design] ?? 0;
        context.fillStyle = colourOf(cloud.looks[kind] ?? kind);
        dot(design, kind === 0 ? 3 : 1.8);
      }
      context.fillStyle = colours().ink;
      if (chosen !== null) dot(chosen, 4.5);
    },
    [cloud, kept, chosen, x, y],
  );
  const names = [cloud.columns[y]?.label ?? "", cloud.columns[x]?.label ?? ""] as const;
  return (
    <div>
      <div
        class="fig-field fig-scatter"
        onPointerDown={(event) => {
          const box = event.currentTarget.getBoundingClientRect();
          const [px, py] = [event.clientX - box.left, event.clientY - box.top];
          const away = (design: number) => {
            const place = at(design);
            return place === null ? Number.POSITIVE_INFINITY : Math.hypot(place[0] - px, place[1] - py);
          };
          const found = nearest(kept, away, 14);
          if (found !== null) setChosen(found);
        }}
      >
        <canvas ref={canvas} />
      </div>
      <p class="ui-help">{t("figure.over", { y: names[0], x: names[1] })}</p>
    </div>
  );
}
