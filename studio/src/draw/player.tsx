import { useSignal } from "@preact/signals";
import { useEffect, useMemo, useState } from "preact/hooks";
import { formatNumber, t } from "../text";
import { formatQuantity, IconButton, parseUnit, Slider } from "../ui";
import { useCanvas } from "./canvas";
import { type Cursor, greatestOf, isAngle, keyStep, moveTo, quiet, useCursor, within } from "./cursor";
import { namesOf, paintDrawing } from "./drawing";
import type { ShownAnimation } from "./figures";
import { between, frameAt, phaseAt, rangeOf, reachOf, shapeAt, shareAt, stepsOf } from "./motion";
import { type Named, paintNames } from "./names";
import { paintScaleBar, Stage } from "./stage";
import { byRole, paintDot, paintStroke } from "./strokes";
import { type Extent, include, type Map2D, mapOf, type View, WHOLE } from "./viewport";

interface PlayerProps {
  animation: ShownAnimation;
  /** Another state, pale behind it. */
  ghost?: ShownAnimation | null | undefined;
  title: string;
  height?: number | undefined;
  /** The box that is shown [m]; without it all positions that are reached. */
  extent?: Extent | undefined;
  /** Begins to move by itself, unless the system asks for less motion. */
  autoplay?: boolean;
}

/** Seconds of a run, from slow to quick. */
const RUNS = [16, 8, 4, 2, 1] as const;

/** A machine in motion: played, or turned by its slider, which is the cursor of all figures over the same drive. */
export function Player({ animation, ghost, title, height = 320, extent, autoplay = false }: PlayerProps) {
  const cursor = useCursor(animation.drive.label);
  const range = useMemo(() => rangeOf(animation), [animation]);
  const box = useMemo(() => {
    const box = extent ?? reachOf(animation);
    const pale = ghost && extent === undefined ? reachOf(ghost) : box;
    include(box, [pale.left, pale.low, pale.right, pale.high]);
    return box;
  }, [animation, ghost, extent]);
  const view = useSignal<View>(WHOLE);
  const angle = isAngle(animation.drive.unit);
  const start = animation.at[animation.start] ?? range.low;
  const inside = () =>
    within(cursor.at.value ?? start, range.low, range.high, angle) ?? clamp(cursor.at.value ?? start, range);
  const still = useCanvas(
    (context, width, high) => {
      const map = mapOf(box, view.peek(), width, high);
      paintDrawing(context, { ...animation.still, dots: [] }, map);
      paintScaleBar(context, map, parseUnit(animation.still.unit)?.factor ?? 1, animation.still.unit, width, high);
    },
    [animation, box],
    [view],
  );
  const behind = useCanvas(
    (context, width, high) => {
      const map = mapOf(box, view.peek(), width, high);
      for (const shape of ghost ? byRole(ghost.shapes) : []) {
        if (ghost) paintStroke(context, shape, shapeAt(ghost, shape, frameAt(ghost, inside()), map));
      }
    },
    [ghost, box],
    [view, cursor.at],
  );
  const moving = useCanvas(
    (context, width, high) => {
      const map = mapOf(box, view.peek(), width, high);
      paintFrame(context, animation, map, frameAt(animation, inside()), width, high - 18);
    },
    [animation, box],
    [view, cursor.at],
  );
  return (
    <div class="fig-player">
      <Stage label={title} height={height} view={view}>
        <canvas ref={still} />
        <canvas class="fig-ghost" ref={behind} />
        <canvas ref={moving} />
      </Stage>
      <Controls animation={animation} cursor={cursor} range={range} at={inside()} autoplay={autoplay} />
      <Readings animation={animation} at={inside()} />
    </div>
  );
}

function clamp(value: number, { low, high }: { low: number; high: number }): number {
  return Math.min(Math.max(value, low), high);
}

interface ControlsProps {
  animation: ShownAnimation;
  cursor: Cursor;
  range: { low: number; high: number };
  at: number;
  autoplay: boolean;
}

function Controls({ animation, cursor, range, at, autoplay }: ControlsProps) {
  const [me] = useState(() => ({}));
  const [seconds, setSeconds] = useState<number>(8);
  const playing = cursor.player.value === me;
  useEffect(() => {
    const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (autoplay && !calm && cursor.player.peek() === null) cursor.player.value = me;
    return () => {
      if (cursor.player.peek() === me) cursor.player.value = null;
    };
  }, [cursor, autoplay]);
  useEffect(() => (playing ? run(animation, cursor, range, at, seconds) : undefined), [playing, seconds, animation]);
  const { period } = animation;
  const real = period !== null && period > 0.05 ? period : null;
  return (
    <div class="fig-controls">
      <IconButton
        icon={playing ? "pause" : "play"}
        kind="plain"
        label={playing ? t("figure.pause") : t("figure.play")}
        onClick={() => {
          cursor.player.value = playing ? null : me;
        }}
      />
      <Slider
        bare
        label={animation.drive.label}
        value={at}
        min={range.low}
        max={range.high}
        step={keyStep(range.low, range.high, animation.drive.unit) / 4}
        text={formatQuantity(at, animation.drive.unit)}
        onInput={(to) => moveTo(cursor, to)}
      />
      <output>{formatQuantity(at, animation.drive.unit)}</output>
      <select
        class="ui-input"
        aria-label={t("figure.speed")}
        value={String(seconds)}
        onChange={(event) => setSeconds(Number(event.currentTarget.value))}
      >
        {RUNS.map((one) => (
          <option key={one} value={String(one)}>
            {t("figure.perRun", { seconds: one })}
          </option>
        ))}
        {real !== null && !RUNS.some((one) => one === real) && (
          <option value={String(real)}>
            {t("figure.realSpeed")} ({formatNumber(real, 3)} s)
          </option>
        )}
      </select>
    </div>
  );
}

/** Moves the cursor on from where it is, until it is stopped. */
function run(
  animation: ShownAnimation,
  cursor: Cursor,
  range: { low: number; high: number },
  from: number,
  seconds: number,
): () => void {
  let phase = phaseAt(animation, (from - range.low) / (range.high - range.low));
  let before = performance.now();
  let request = requestAnimationFrame(tick);
  function tick(now: number): void {
    phase = (phase + Math.min(Math.max(now - before, 0), 100) / (1000 * seconds)) % 1;
    before = now;
    cursor.at.value = range.low + (range.high - range.low) * shareAt(animation, phase);
    request = requestAnimationFrame(tick);
  }
  return () => cancelAnimationFrame(request);
}

function Readings({ animation, at }: { animation: ShownAnimation; at: number }) {
  if (animation.readings.length === 0) return null;
  const frame = Math.min(frameAt(animation, at), stepsOf(animation));
  return (
    <dl class="fig-readings">
      {animation.readings.map((reading) => (
        <div key={reading.label}>
          <dt>{reading.label}</dt>
          <dd>
            {formatQuantity(
              quiet(between(reading.values, frame, animation.at.length, 1, 0), greatestOf([reading.values])),
              reading.unit,
            )}
          </dd>
        </div>
      ))}
    </dl>
  );
}

/** Paints what moves, the pivots over it, and all names. */
function paintFrame(
  context: CanvasRenderingContext2D,
  animation: ShownAnimation,
  map: Map2D,
  frame: number,
  width: number,
  height: number,
): void {
  const names: Named[] = [];
  const seen = new Set<string>();
  const frames = animation.at.length;
  for (const shape of byRole(animation.shapes)) {
    const points = shapeAt(animation, shape, frame, map);
    paintStroke(context, shape, points);
    const middle: [number, number] = [
      ((points[0] ?? 0) + (points[2] ?? 0)) / 2,
      ((points[1] ?? 0) + (points[3] ?? 0)) / 2,
    ];
    if (shape.label === "" || seen.has(shape.label)) continue;
    seen.add(shape.label);
    names.push({ text: shape.label, anchors: [middle], bold: false, look: shape.look, clear: 9 });
  }
  for (const dot of animation.still.dots) {
    paintDot(context, dot.role, map.x0 + dot.at[0] * map.scale, map.y0 - dot.at[1] * map.scale);
  }
  for (const dot of animation.points) {
    const at = (track: number, of: number) => between(animation.tracks[track] ?? [], frame, frames, 2, of);
    const [x, y] = [map.x0 + at(dot.track, 0) * map.scale, map.y0 - at(dot.track, 1) * map.scale];
    const along: [number, number] =
      dot.ahead < 0 ? [1, 0] : [at(dot.ahead, 0) - at(dot.track, 0), at(dot.track, 1) - at(dot.ahead, 1)];
    paintDot(context, dot.role, x, y, along);
    if (dot.label) names.unshift({ text: dot.label, anchors: [[x, y]], bold: true, look: -1, clear: 8 });
  }
  paintNames(context, [...names, ...namesOf(animation.still, map, seen)], width, height);
}
