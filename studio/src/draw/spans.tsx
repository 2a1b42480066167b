/** Charts of lanes as SVG: Gantt charts and stacked bars. */
import { useId } from "preact/hooks";
import { formatNumber, t } from "../text";
import { formatQuantity, fromSi, parseUnit, Table } from "../ui";
import type { ShownBars, ShownGantt } from "./figures";
import { Patch } from "./legend";
import { cssColour } from "./looks";
import { withUnit } from "./plot";
import { spanOf, tickLabels, ticks } from "./ticks";
import { useWidth } from "./width";

const ROW = 26;
const BAR = 18;
const FOOT = 22;

interface Frame {
  left: number;
  right: number;
  rows: number;
  ticks: number[];
  x: (inUnit: number) => number;
}

function frameOf(names: readonly string[], low: number, high: number, unit: string, width: number): Frame {
  const left = Math.min(Math.max(...names.map((name) => name.length), 4) * 6.6 + 10, width * 0.36);
  const right = width - 12;
  const made = ticks({ low, high }, unit, Math.max(2, (right - left) / 80));
  return {
    left,
    right,
    rows: names.length,
    ticks: made,
    x: (value) => left + ((value - low) / (high - low)) * (right - left),
  };
}

function Axes({ frame, names, label }: { frame: Frame; names: readonly string[]; label: string }) {
  const bottom = frame.rows * ROW;
  const texts = tickLabels(frame.ticks);
  const room = Math.floor((frame.left - 8) / 6.4);
  return (
    <>
      {frame.ticks.map((tick, at) => (
        <g key={tick}>
          <line class="grid" x1={frame.x(tick)} x2={frame.x(tick)} y1={0} y2={bottom} />
          <text x={frame.x(tick)} y={bottom + 14} text-anchor="middle">
            {texts[at]}
          </text>
        </g>
      ))}
      {names.map((name, row) => (
        <text key={row} class="name" x={frame.left - 8} y={(row + 0.5) * ROW + 4} text-anchor="end">
          {name.length > room ? `${name.slice(0, room - 1)}…` : name}
        </text>
      ))}
      <text x={frame.right} y={bottom + 28} text-anchor="end">
        {label}
      </text>
    </>
  );
}

function Kinds({
  kinds,
  looks,
  used,
  pale,
}: {
  kinds: string[];
  looks: number[];
  used: Set<number | null>;
  pale: number;
}) {
  return (
    <ul class="fig-legend">
      {kinds.map(
        (kind, k) =>
          used.has(k) && (
            <li key={kind}>
              <Patch look={looks[k] ?? k} pale={k < pale} />
              <span>{kind}</span>
            </li>
          ),
      )}
    </ul>
  );
}

/** What lanes are busy with over time. */
export function Gantt({ gantt, title }: { gantt: ShownGantt; title: string }) {
  const [box, width] = useWidth();
  const factor = parseUnit(gantt.x.unit)?.factor ?? 1;
  const span = spanOf(gantt.lanes.flatMap((lane) => [lane.starts, lane.ends]));
  const names = gantt.lanes.map((lane) => lane.name);
  const frame = frameOf(names, Math.min(span.low, 0) / factor, span.high / factor, gantt.x.unit, width);
  const used = new Set(gantt.lanes.flatMap((lane) => lane.kinds));
  return (
    <div ref={box}>
      <svg
        class="fig-svg"
        viewBox={`0 0 ${width} ${names.length * ROW + FOOT + 10}`}
        role="img"
        aria-label={`${title}. ${spokenGantt(gantt)}`}
      >
        <Axes frame={frame} names={names} label={withUnit(gantt.x.label, gantt.x.unit)} />
        {gantt.lanes.map((lane, row) =>
          gantt.kinds.map((_, kind) => {
            const path = spansPath(lane, kind, (si) => frame.x(si / factor), row * ROW + (ROW - BAR) / 2);
            const look = gantt.looks[kind] ?? kind;
            return (
              path && (
                <path
                  key={`${row} ${kind}`}
                  d={path}
                  fill={cssColour(look)}
                  fill-opacity={kind < gantt.pale ? 0.35 : 1}
                />
              )
            );
          }),
        )}
      </svg>
      <Kinds kinds={gantt.kinds} looks={gantt.looks} used={used} pale={gantt.pale} />
    </div>
  );
}

function spansPath(lane: ShownGantt["lanes"][number], kind: number, x: (si: number) => number, y: number): string {
  let path = "";
  lane.kinds.forEach((one, k) => {
    const [start, end] = [lane.starts[k], lane.ends[k]];
    if (one !== kind || start == null || end == null) return;
    const from = x(start);
    path += `M${from.toFixed(1)} ${y}h${Math.max(x(end) - from, 0.6).toFixed(1)}v${BAR}H${from.toFixed(1)}z`;
  });
  return path;
}

function spokenGantt(gantt: ShownGantt): string {
  return gantt.lanes
    .map((lane) => {
      const sums = gantt.kinds.map((kind, number) => {
        const total = lane.kinds.reduce<number>(
          (sum, one, k) => (one === number ? sum + (lane.ends[k] ?? 0) - (lane.starts[k] ?? 0) : sum),
          0,
        );
        return total > 0 ? `${kind} ${formatQuantity(total, gantt.x.unit, 3)}` : "";
      });
      return `${lane.name}: ${sums.filter(Boolean).join(", ")}`;
    })
    .join(". ");
}

/** Horizontal bars of parts side by side; below them the numbers as a table. */
export function StackedBars({ bars, title }: { bars: ShownBars; title: string }) {
  const [box, width] = useWidth();
  const id = useId();
  const factor = parseUnit(bars.x.unit)?.factor ?? 1;
  const totals = bars.values.map((row) => row.reduce((sum: number, value) => sum + (value ?? 0), 0));
  const high = Math.max(...totals, 1e-12) / factor;
  const frame = frameOf(bars.bars, 0, high, bars.x.unit, width);
  const used = new Set(
    bars.kinds.map((_, kind) => kind).filter((kind) => bars.values.some((row) => (row[kind] ?? 0) > 0)),
  );
  const columns = [
    { heading: "" },
    ...bars.kinds.map((heading) => ({ heading, unit: bars.x.unit })),
    { heading: t("figure.total"), unit: bars.x.unit },
  ];
  const rows = bars.bars.map((name, row) => [name, ...(bars.values[row] ?? []), totals[row] ?? 0]);
  return (
    <div ref={box}>
      <svg
        class="fig-svg"
        viewBox={`0 0 ${width} ${bars.bars.length * ROW + FOOT + 10}`}
        role="img"
        aria-label={title}
        aria-describedby={id}
      >
        <Axes frame={frame} names={bars.bars} label={withUnit(bars.x.label, bars.x.unit)} />
        {bars.values.map((row, at) => {
          let from = 0;
          return row.map((value, kind) => {
            const wide = (value ?? 0) / factor;
            from += wide;
            if (!(wide > 0)) return null;
            const x = frame.x(from - wide);
            return (
              <rect
                key={`${at} ${kind}`}
                x={x}
                y={at * ROW + (ROW - BAR) / 2}
                width={Math.max(frame.x(from) - x - 0.6, 0.5)}
                height={BAR}
                fill={cssColour(bars.looks[kind] ?? kind)}
              >
                <title>{`${bars.kinds[kind] ?? ""} ${formatNumber(fromSi(value ?? 0, bars.x.unit))}`}</title>
              </rect>
            );
          });
        })}
      </svg>
      <Kinds kinds={bars.kinds} looks={bars.looks} used={used} pale={0} />
      <details class="ui-details" id={id}>
        <summary>{t("figure.values")}</summary>
        <Table label={title} columns={columns} rows={rows} />
      </details>
    </div>
  );
}
