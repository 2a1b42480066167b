import { useRef } from "preact/hooks";
import type { ShownRelation, ShownTrack } from "../../api/messages";
import { formatNumber, t } from "../../text";
import { formatQuantity, useSize } from "../../ui";
import { type Curve, pathOf, type Range, rangeOf, type Shown, type TrackCurves, unitOf, withinTurn } from "./curves";
import { DEGREE, type Grip, levelStep, type Span, TURN } from "./model";

interface LanesProps {
  shown: Shown;
  /** The cyclogram before it was solved, drawn dashed. */
  before: Shown | null;
  curve: Curve;
  cursor: number;
  locked: boolean;
  onCursor: (angle: number) => void;
  onSpan: (track: ShownTrack, motion: string, grip: Grip, by: number) => void;
  onLevel: (track: ShownTrack, motion: string, level: number) => void;
  onEnd: () => void;
  /** The motion whose values are shown beside the lanes. */
  chosen: { track: string; motion: string };
  onChoose: (motion: { track: string; motion: string }) => void;
}

/** Height of a lane, least and most, of its head, and of the axis below all [px]. */
const LANES = [104, 300] as const;
const HEAD = 34;
const AXIS = 22;
const SIDE = 10;

interface Scale {
  width: number;
  /** Height of a lane [px]. */
  lane: number;
  x: (angle: number) => number;
  angle: (x: number) => number;
}

/** The scale for a width and a number of lanes, which fill half of the window. */
function scaleOf(width: number, lanes: number): Scale {
  const room = Math.max(width - 2 * SIDE, 50);
  const lane = Math.min(Math.max(innerHeight / 2 / lanes, LANES[0]), LANES[1]);
  return { width, lane, x: (angle) => SIDE + (room * angle) / TURN, angle: (x) => ((x - SIDE) / room) * TURN };
}

/** y of a value in a lane [px]. */
function levelScale(lane: number, range: Range, height: number) {
  const [top, bottom] = [lane * height + HEAD, (lane + 1) * height - 8];
  const room = bottom - top;
  return {
    y: (value: number) => bottom - (room * (value - range.low)) / (range.high - range.low),
    value: (y: number) => range.low + ((bottom - y) / room) * (range.high - range.low),
  };
}

interface Drag {
  track: ShownTrack;
  motion: string;
  grip: Grip | "level";
  from: { x: number; y: number };
  lane: number;
  range: Range;
}

/** The tracks over the master angle, one lane each: motions that are dragged, relations as arrows, exclusions shaded. */
export function Lanes(props: LanesProps) {
  const { shown, before, curve } = props;
  const { tracks, relations } = shown.about;
  const svg = useRef<SVGSVGElement>(null);
  const size = useSize(svg, { width: 900, height: 500 });
  const scale = scaleOf(size.width, tracks.length);
  const drag = useRef<Drag | null>(null);
  const height = tracks.length * scale.lane + AXIS;
  const at = (event: PointerEvent) => {
    const box = svg.current?.getBoundingClientRect();
    return { x: event.clientX - (box?.left ?? 0), y: event.clientY - (box?.top ?? 0) };
  };
  const move = (event: PointerEvent) => {
    const to = at(event);
    const now = drag.current;
    if (now === null) {
      if (event.pointerType === "mouse" || event.buttons > 0)
        props.onCursor(Math.min(Math.max(scale.angle(to.x), 0), TURN));
      return;
    }
    if (now.grip === "level")
      props.onLevel(now.track, now.motion, levelScale(now.lane, now.range, scale.lane).value(to.y));
    else props.onSpan(now.track, now.motion, now.grip, scale.angle(to.x) - scale.angle(now.from.x));
  };
  const up = () => {
    if (drag.current !== null) props.onEnd();
    drag.current = null;
  };
  const take =
    (lane: number, track: ShownTrack, motion: string, grip: Drag["grip"], range: Range) => (event: PointerEvent) => {
      if (event.button !== 0 || props.locked) return;
      event.stopPropagation();
      props.onChoose({ track: track.name, motion });
      drag.current = { track, motion, grip, from: at(event), lane, range };
      svg.current?.setPointerCapture(event.pointerId);
    };
  return (
    <svg
      ref={svg}
      class="cyclogram-lanes"
      style={{ height: `${height}px` }}
      role="group"
      aria-label={t("cyclogram.lanes")}
      onPointerMove={move}
      onPointerDown={(event) => props.onCursor(Math.min(Math.max(scale.angle(at(event).x), 0), TURN))}
      onPointerUp={up}
      onPointerCancel={up}
    >
      <Hatch />
      <Axis scale={scale} lanes={tracks.length} />
      {tracks.map((track, lane) => (
        <Lane
          key={track.name}
          lane={lane}
          track={track}
          curves={shown.curves[lane]}
          earlier={before?.curves[before.about.tracks.findIndex((one) => one.name === track.name)]}
          scale={scale}
          take={take}
          {...props}
        />
      ))}
      {curve === "position" &&
        relations.map((one, index) => <Arrow key={index} one={one} shown={shown} scale={scale} />)}
      <line
        class="cursor"
        x1={scale.x(props.cursor)}
        x2={scale.x(props.cursor)}
        y1={0}
        y2={height - AXIS}
        pointer-events="none"
      />
    </svg>
  );
}

function Hatch() {
  return (
    <defs>
      <pattern id="cyclogram-hatch" width={7} height={7} patternUnits="userSpaceOnUse" patternTransform="rotate(45)">
        <line x1={0} y1={0} x2={0} y2={7} class="hatch" />
      </pattern>
      <marker id="cyclogram-arrow" viewBox="0 0 8 8" refX={7} refY={4} markerWidth={7} markerHeight={7} orient="auto">
        <path d="M0 0L8 4L0 8Z" class="arrow-head" />
      </marker>
      <marker
        id="cyclogram-arrow-bad"
        viewBox="0 0 8 8"
        refX={7}
        refY={4}
        markerWidth={8}
        markerHeight={8}
        orient="auto"
      >
        <path d="M0 0L8 4L0 8Z" class="arrow-head bad" />
      </marker>
    </defs>
  );
}

function Axis({ scale, lanes }: { scale: Scale; lanes: number }) {
  const step = scale.width < 500 ? 90 : 30;
  const marks = Array.from({ length: 360 / step + 1 }, (_, index) => index * step);
  return (
    <g class="axis">
      {marks.map((mark) => {
        const x = scale.x(mark * DEGREE);
        return (
          <g key={mark}>
            <line x1={x} x2={x} y1={0} y2={lanes * scale.lane} />
            <text
              x={x}
              y={lanes * scale.lane + 16}
              text-anchor={mark === 0 ? "start" : mark === 360 ? "end" : "middle"}
            >
              {mark}°
            </text>
          </g>
        );
      })}
    </g>
  );
}

interface LaneProps extends LanesProps {
  lane: number;
  track: ShownTrack;
  curves: TrackCurves | undefined;
  earlier: TrackCurves | undefined;
  scale: Scale;
  take: (
    lane: number,
    track: ShownTrack,
    motion: string,
    grip: Drag["grip"],
    range: Range,
  ) => (event: PointerEvent) => void;
}

function Lane(props: LaneProps) {
  const { lane, track, curves, earlier, scale, curve, shown } = props;
  if (curves === undefined) return null;
  const range = joined(rangeOf(curves[curve], curve), earlier && rangeOf(earlier[curve], curve));
  const level = levelScale(lane, range, scale.lane);
  const top = lane * scale.lane;
  const unit = unitOf(track.shown_unit, curve);
  const pressLevel = (part: ShownTrack["motions"][number]) => (event: KeyboardEvent) => {
    const by = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (by === undefined || props.locked) return;
    event.preventDefault();
    props.onLevel(track, part.name, part.finish + by * (event.shiftKey ? 10 : 1) * levelStep(track));
    props.onEnd();
  };
  return (
    <g class="lane">
      <line class="lane-line" x1={0} x2={scale.width} y1={top} y2={top} />
      <Shades lane={lane} track={track.name} shown={shown} scale={scale} />
      {curve !== "position" && <line class="zero" x1={scale.x(0)} x2={scale.x(TURN)} y1={level.y(0)} y2={level.y(0)} />}
      <text class="lane-name" x={SIDE} y={top + 14}>
        {track.name}
        {track.locked ? ` · ${t("cyclogram.locked")}` : ""}
      </text>
      <text class="lane-range" x={scale.width - SIDE} y={top + 14} text-anchor="end">
        {formatQuantity(range.low, unit, 3)} … {formatQuantity(range.high, unit, 3)}
      </text>
      {earlier && <path class="curve before" d={pathOf(earlier, curve, scale.x, level.y)} />}
      <path class={`curve curve-${lane % 8}`} d={pathOf(curves, curve, scale.x, level.y)} />
      {track.motions.map((part) => (
        <g key={part.name}>
          <Blocks {...props} motion={part.name} span={part} range={range} />
          {curve === "position" && (
            <g
              class="level"
              tabindex={0}
              role="button"
              aria-label={t("cyclogram.levelAfter", {
                name: `${track.name}, ${part.name}`,
                level: formatQuantity(part.finish, track.shown_unit),
              })}
              onPointerDown={props.take(lane, track, part.name, "level", range)}
              onKeyDown={pressLevel(part)}
            >
              <title>{t("cyclogram.levelHint")}</title>
              <circle class="reach" cx={scale.x(part.end % TURN || part.end)} cy={level.y(part.finish)} r={12} />
              <circle cx={scale.x(part.end % TURN || part.end)} cy={level.y(part.finish)} r={5.5} />
            </g>
          )}
        </g>
      ))}
      {track.events.map((event) => (
        <g key={event.name} class="event">
          <path d={`M${scale.x(event.angle)} ${top + scale.lane - 9}l-4 8h8z`} />
          <title>{`${event.name}: ${formatQuantity(event.angle, "deg")}`}</title>
        </g>
      ))}
    </g>
  );
}

function joined(one: Range, other: Range | undefined): Range {
  return other === undefined ? one : { low: Math.min(one.low, other.low), high: Math.max(one.high, other.high) };
}

interface BlockProps
  extends Pick<LaneProps, "lane" | "track" | "scale" | "take" | "onSpan" | "onEnd" | "locked" | "chosen" | "onChoose"> {
  motion: string;
  span: Span;
  range: Range;
}

/** The bar of a motion: its middle moves it, its ends change it; arrow keys do the same. */
function Blocks(props: BlockProps) {
  const { lane, track, scale, motion, span, range, take, onSpan, onEnd, locked } = props;
  const chosen = props.chosen.track === track.name && props.chosen.motion === motion;
  const choose = () => props.onChoose({ track: track.name, motion });
  const y = lane * scale.lane + 18;
  const pieces = withinTurn([[span.start, span.end]]);
  const press = (grip: Grip) => (event: KeyboardEvent) => {
    const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (by === undefined || locked) return;
    event.preventDefault();
    onSpan(track, motion, grip, by * (event.shiftKey ? 10 : 1) * DEGREE);
    onEnd();
  };
  const name = `${track.name}, ${motion}`;
  return (
    <>
      {pieces.map(([from, to], index) => {
        const [left, right] = [scale.x(from), scale.x(to)];
        const width = Math.max(right - left, 2);
        return (
          <g key={index} class="block">
            <rect
              class={`bar ${chosen ? "chosen" : ""}`}
              onFocus={choose}
              x={left}
              y={y}
              width={width}
              height={13}
              rx={2}
              tabindex={index === 0 ? 0 : -1}
              role="button"
              aria-label={t("cyclogram.moveMotion", { name, from: degrees(span.start), to: degrees(span.end) })}
              onPointerDown={take(lane, track, motion, "all", range)}
              onKeyDown={press("all")}
            />
            {width > 34 && (
              <text x={left + width / 2} y={y + 10.5} text-anchor="middle" pointer-events="none">
                {shortened(motion, width)}
              </text>
            )}
            {index === 0 && (
              <End
                name={t("cyclogram.startOf", { name, at: degrees(span.start) })}
                x={left}
                y={y}
                onTake={take(lane, track, motion, "start", range)}
                onKey={press("start")}
              />
            )}
            {index === pieces.length - 1 && (
              <End
                name={t("cyclogram.endOf", { name, at: degrees(span.end) })}
                x={right}
                y={y}
                onTake={take(lane, track, motion, "end", range)}
                onKey={press("end")}
              />
            )}
          </g>
        );
      })}
    </>
  );
}

interface EndProps {
  name: string;
  x: number;
  y: number;
  onTake: (event: PointerEvent) => void;
  onKey: (event: KeyboardEvent) => void;
}

function End({ name, x, y, onTake, onKey }: EndProps) {
  return (
    <g class="end" tabindex={0} role="button" aria-label={name} onPointerDown={onTake} onKeyDown={onKey}>
      <rect class="reach" x={x - 8} y={y - 6} width={16} height={25} />
      <line x1={x} x2={x} y1={y - 2} y2={y + 15} />
    </g>
  );
}

function shortened(text: string, width: number): string {
  const most = Math.floor(width / 6.5);
  return text.length > most ? `${text.slice(0, Math.max(most - 1, 1))}…` : text;
}

function degrees(angle: number): string {
  return `${formatNumber(angle / DEGREE, 5)}°`;
}

/** The stays of a track in zones of exclusions; where both are present it is hatched, with a text. */
function Shades({ lane, track, shown, scale }: { lane: number; track: string; shown: Shown; scale: Scale }) {
  const top = lane * scale.lane + HEAD;
  const height = scale.lane - HEAD - 2;
  const rect = (key: string, [from, to]: [number, number], kind: string) => (
    <rect
      key={key}
      class={kind}
      x={scale.x(from)}
      y={top}
      width={Math.max(scale.x(to) - scale.x(from), 1.5)}
      height={height}
    />
  );
  return (
    <>
      {shown.about.exclusions.flatMap((one, index) => {
        const sides = [one.first, one.second].filter((side) => side.track === track);
        if (sides.length === 0) return [];
        const overlaps = withinTurn(one.overlaps);
        return [
          ...sides.flatMap((side, at) =>
            withinTurn(side.windows).map((span, part) =>
              rect(`${index}-${at}-${part}`, span, one.ok ? "shade" : "shade near"),
            ),
          ),
          ...overlaps.map((span, part) => (
            <g key={`o${index}-${part}`}>
              {rect("bad", span, "shade bad")}
              <text class="shade-text" x={scale.x((span[0] + span[1]) / 2)} y={top + height - 5} text-anchor="middle">
                {t("cyclogram.overlap")}
              </text>
            </g>
          )),
        ];
      })}
    </>
  );
}

/** A relation as an arrow from the first instant to the one that follows it. */
function Arrow({ one, shown, scale }: { one: ShownRelation; shown: Shown; scale: Scale }) {
  const lane = (name: string) => shown.about.tracks.findIndex((track) => track.name === name);
  const [from, to] = [lane(one.first.track), lane(one.then.track)];
  if (from < 0 || to < 0 || one.turns !== 0) return null;
  const [x1, x2] = [scale.x(one.first.angle % TURN), scale.x(one.then.angle % TURN)];
  const y = (at: number) => at * scale.lane + 24;
  const bow = from === to ? `C${x1} ${y(from) - 20} ${x2} ${y(to) - 20} ${x2} ${y(to)}` : `L${x2} ${y(to)}`;
  return (
    <g class={`relation ${one.ok ? "" : "bad"}`}>
      <path d={`M${x1} ${y(from)}${bow}`} marker-end={`url(#cyclogram-arrow${one.ok ? "" : "-bad"})`} />
      {!one.ok && (
        <text x={(x1 + x2) / 2 + 6} y={(y(from) + y(to)) / 2 + 4}>
          {t("cyclogram.missing", { angle: degrees(-one.margin) })}
        </text>
      )}
    </g>
  );
}
