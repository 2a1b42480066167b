import { useMemo, useState } from "preact/hooks";
import { t } from "../text";
import { Button, formatQuantity, Table } from "../ui";
import { greatestOf, keyed, moveTo, quiet, useCursor, valueAt, within } from "./cursor";
import type { Numbers, ShownLane, ShownTiming } from "./figures";
import { cssColour } from "./looks";
import { shownValue } from "./plot-paint";
import { useWidth } from "./width";

const TURN = 2 * Math.PI;
const STROKE = 34;
const LANE = 58;
const TOP = 18;
const FOOT = 22;

interface Frame {
  left: number;
  width: number;
  x: (angle: number) => number;
}

/** A cyclogram: lanes over one turn of the master shaft. Pointer and arrow keys move the shared cursor. */
export function Timing({ timing, title }: { timing: ShownTiming; title: string }) {
  const [box, width] = useWidth();
  const cursor = useCursor(timing.drive.label);
  const at = cursor.at.value === null ? null : within(cursor.at.value, 0, TURN, true);
  const names = timing.lanes.flatMap((lane) => [lane.name, lane.actuator]);
  const left = Math.min(Math.max(...names.map((name) => name.length), 6) * 6.6 + 14, width * 0.36);
  const frame: Frame = { left, width: width - left - 14, x: (angle) => left + (angle / TURN) * (width - left - 14) };
  const bottom = TOP + timing.lanes.length * LANE;
  const [order, setOrder] = useState(0);
  const known = timing.lanes.some((lane) => lane.motion.length > 0);
  const shown = useMemo(
    () => <Lanes timing={timing} frame={frame} bottom={bottom} order={order} />,
    [timing, width, order],
  );
  const point = (event: PointerEvent) => {
    const rectangle = (event.currentTarget as Element).getBoundingClientRect();
    const share = ((event.clientX - rectangle.left) / rectangle.width) * width;
    moveTo(cursor, Math.min(Math.max((share - left) / frame.width, 0), 1) * TURN);
  };
  const reading = at === null ? "" : formatQuantity(at, timing.drive.unit);
  return (
    <div ref={box}>
      <div
        role="slider"
        class="fig-field"
        tabIndex={0}
        aria-label={title}
        aria-description={t("figure.plotKeys")}
        aria-valuemin={0}
        aria-valuemax={TURN}
        aria-valuenow={at ?? 0}
        aria-valuetext={at === null ? timing.drive.label : `${timing.drive.label} ${reading}: ${spoken(timing, at)}`}
        onPointerDown={(event) => {
          event.currentTarget.setPointerCapture(event.pointerId);
          point(event);
        }}
        onPointerMove={(event) => {
          const dragged = event.currentTarget.hasPointerCapture(event.pointerId);
          if (dragged || (event.pointerType === "mouse" && cursor.player.peek() === null)) point(event);
        }}
        onKeyDown={(event) => {
          const to = keyed(event, at ?? 0, 0, TURN, timing.drive.unit);
          if (to !== undefined) moveTo(cursor, to);
        }}
      >
        <svg class="fig-svg" viewBox={`0 0 ${width} ${bottom + FOOT}`} aria-hidden="true">
          {shown}
          {at !== null && <line class="cursor" x1={frame.x(at)} x2={frame.x(at)} y1={TOP - 6} y2={bottom} />}
        </svg>
      </div>
      <p class="fig-legend">
        <span class="fig-at">{at === null ? "" : t("figure.at", { at: reading })}</span>
      </p>
      {known && <Orders order={order} onChange={setOrder} />}
      {known && <Motions timing={timing} at={at ?? 0} />}
    </div>
  );
}

const RATES = [
  ["position", ""],
  ["velocity", "/s"],
  ["acceleration", "/s^2"],
] as const;

/** What the curves of the lanes show. */
function Orders({ order, onChange }: { order: number; onChange: (order: number) => void }) {
  return (
    <div class="fig-orders" role="group" aria-label={t("figure.curves")}>
      {RATES.map(([name], of) => (
        <Button key={name} size="small" pressed={of === order} onClick={() => onChange(of)}>
          {t(`figure.${name}`)}
        </Button>
      ))}
    </div>
  );
}

/** What each track does at an angle. */
function Motions({ timing, at }: { timing: ShownTiming; at: number }) {
  const columns = [
    { heading: t("figure.track") },
    { heading: t("figure.motion") },
    ...RATES.map(([name]) => ({ heading: t(`figure.${name}`) })),
  ];
  const rows = timing.lanes.map((lane) => {
    const move = lane.moves.find(({ start, end }) => at >= start && at < end);
    const values = RATES.map(([, per], of) => {
      const curve = lane.motion[of];
      const value = curve === undefined ? null : valueAt(lane.angle, curve, at);
      return value === null ? "" : formatQuantity(quiet(value, greatestOf([curve ?? []])), `${lane.unit}${per}`);
    });
    return [lane.name, move === undefined ? t("figure.dwell") : `${move.name} · ${move.law}`, ...values];
  });
  return <Table label={timing.drive.label} columns={columns} rows={rows} />;
}

/** The heights of a lane's curve, 0 to 1: its position, or a derivative about the middle. */
function heights(lane: ShownLane, order: number): Numbers {
  const rates = order === 0 ? undefined : lane.motion[order];
  if (rates === undefined) return lane.position;
  const most = greatestOf([rates]) || 1;
  return rates.map((rate) => (rate === null ? null : 0.5 + (0.5 * rate) / most));
}

function spoken(timing: ShownTiming, at: number): string {
  return timing.lanes
    .map((lane) => `${lane.name} ${shownValue(valueAt(lane.angle, lane.position, at), "%")} %`)
    .join(", ");
}

interface LanesProps {
  timing: ShownTiming;
  frame: Frame;
  bottom: number;
  order: number;
}

function Lanes({ timing, frame, bottom, order }: LanesProps) {
  const angles = Array.from({ length: 9 }, (_, k) => (k / 8) * TURN).filter((_, k) => frame.width > 420 || k % 2 === 0);
  return (
    <>
      {angles.map((angle) => (
        <g key={angle}>
          <line class="grid" x1={frame.x(angle)} x2={frame.x(angle)} y1={TOP} y2={bottom} />
          <text x={frame.x(angle)} y={bottom + 14} text-anchor="middle">
            {formatQuantity(angle, timing.drive.unit)}
          </text>
          <text x={frame.x(angle)} y={TOP - 7} text-anchor="middle">
            {formatQuantity((angle / TURN) * timing.period, "s", 3)}
          </text>
        </g>
      ))}
      {timing.lanes.map((lane, row) => (
        <LaneShown key={lane.name} lane={lane} order={order} floor={TOP + (row + 1) * LANE - 12} frame={frame} />
      ))}
      {timing.links.map((link, k) => {
        const at = ([lane, angle]: [number, number]) =>
          `${frame.x(angle).toFixed(1)} ${TOP + (lane + 1) * LANE - 12 - STROKE / 2}`;
        return (
          <path
            key={k}
            d={`M${at(link.first)}L${at(link.then)}`}
            class={link.ok ? "event" : "bad"}
            stroke-width={1.3}
            fill="none"
          >
            <title>{link.label}</title>
          </path>
        );
      })}
    </>
  );
}

interface LaneProps {
  lane: ShownLane;
  order: number;
  floor: number;
  frame: Frame;
}

function LaneShown({ lane, order, floor, frame }: LaneProps) {
  const shares = heights(lane, order);
  const points = lane.angle
    .map((angle, k) => [angle, shares[k]])
    .filter((point): point is [number, number] => point[0] != null && point[1] != null)
    .map(([angle, position]) => `${frame.x(angle).toFixed(1)} ${(floor - STROKE * position).toFixed(1)}`);
  const path = points.length > 0 ? `M${points.join("L")}` : "";
  const ends = { first: points[0]?.split(" ")[0], last: points.at(-1)?.split(" ")[0] };
  return (
    <g>
      {lane.shades.map((shade, k) => (
        <rect
          key={k}
          x={frame.x(Math.max(shade.start, 0))}
          width={Math.max(frame.x(Math.min(shade.end, TURN)) - frame.x(Math.max(shade.start, 0)), 1)}
          y={floor - STROKE}
          height={STROKE}
          fill={shade.bad ? "var(--fig-bad)" : "var(--fig-steel)"}
          fill-opacity={0.22}
        >
          <title>{shade.label}</title>
        </rect>
      ))}
      <line class="axis" x1={frame.left} x2={frame.left + frame.width} y1={floor} y2={floor} />
      {path && order === 0 && (
        <path
          d={`${path}L${ends.last} ${floor}L${ends.first} ${floor}Z`}
          fill={cssColour(lane.look)}
          fill-opacity={0.16}
        />
      )}
      <path d={path} fill="none" stroke={cssColour(lane.look)} stroke-width={2} />
      <Events lane={lane} floor={floor} frame={frame} />
      <text class="name" x={frame.left - 8} y={floor - STROKE / 2} text-anchor="end">
        {lane.name}
      </text>
      <text x={frame.left - 8} y={floor - STROKE / 2 + 14} text-anchor="end">
        {lane.actuator}
      </text>
    </g>
  );
}

function Events({ lane, floor, frame }: { lane: ShownLane; floor: number; frame: Frame }) {
  let free = 0;
  return (
    <>
      {[...lane.events]
        .sort((a, b) => a.x - b.x)
        .map((event) => {
          const x = frame.x(event.x);
          const half = event.label.length * 2.9;
          const middle = Math.min(Math.max(x, frame.left + half), frame.left + frame.width - half + 8);
          const fits = middle - half > free;
          if (fits) free = middle + half + 4;
          return (
            <g key={`${event.x} ${event.label}`}>
              <line class="event" x1={x} x2={x} y1={floor} y2={floor - STROKE - 2}>
                <title>{event.label}</title>
              </line>
              {fits && (
                <text x={middle} y={floor - STROKE - 4} text-anchor="middle">
                  {event.label}
                </text>
              )}
            </g>
          );
        })}
    </>
  );
}
