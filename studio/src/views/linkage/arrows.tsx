/** Velocities, accelerations and forces as arrows, each with its scale. */
import type { MotionAnswer } from "../../api/messages";
import { t } from "../../text";
import { formatQuantity } from "../../ui";
import type { Editor } from "./editor";
import { between, type Figure, nearestSolved, type Sample, sampleAt, wrapped } from "./figure";
import { type Camera, type Size, toScreen, type Vec, vec } from "./geometry";

interface Series {
  x: readonly (number | null)[];
  y: readonly (number | null)[];
}

interface Arrow {
  readonly key: string;
  readonly at: Vec;
  readonly to: Vec;
  /** Its magnitude [SI]. */
  readonly value: number;
}

/** Length on the screen of the greatest arrow of a motion [px]. */
const LONGEST = 110;

/** Share of the greatest one from which an arrow has its value beside it. */
const LEAST_NAMED = 0.02;

interface Props {
  editor: Editor;
  figure: Figure;
  camera: Camera;
  size: Size;
}

export function Arrows({ editor, figure, camera, size }: Props) {
  const motion = editor.answer.value?.motion;
  const { velocities, accelerations, forces } = editor.shown.value;
  if (!motion) return null;
  const sample = nearestSolved(motion, sampleAt(motion.values, wrapped(motion, editor.value.value)));
  if (sample === undefined) return null;
  const kinds = [
    { kind: "velocity", on: velocities, unit: "m/s", series: rates(motion, "velocity") },
    { kind: "acceleration", on: accelerations, unit: "m/s^2", series: rates(motion, "acceleration") },
    { kind: "force", on: forces, unit: "N", series: forceSeries(motion) },
  ] as const;
  const drawn = kinds.filter((one) => one.on && one.series.length > 0);
  return (
    <>
      {drawn.map(({ kind, unit, series }, row) => {
        const most = greatest(series.map(([, one]) => one));
        const by = most > 0 ? LONGEST / most : 0;
        const arrows = series.flatMap(([key, one]) => arrow(key, position(figure, key), one, sample, by, camera, size));
        return (
          <g key={kind} class={`linkage-arrows ${kind}`}>
            {arrows.map((one) => (
              <path key={one.key} d={arrowPath(one.at, one.to)} />
            ))}
            {arrows
              .filter((one) => one.value > most * LEAST_NAMED)
              .map((one) => (
                <text key={one.key} x={one.to.x + 6} y={one.to.y + 14}>
                  {formatQuantity(one.value, unit, 3)}
                  {kind === "force" && onBody(figure, one.key)}
                </text>
              ))}
            <g class="legend" transform={`translate(${size.width - 150} ${22 + row * 22})`}>
              <path d={arrowPath(vec(0, 0), vec(LONGEST / 2, 0))} />
              <text x={LONGEST / 2 + 8} y={4}>
                {formatQuantity(most / 2, unit, 2)}
              </text>
              <title>{t(`linkage.${kind}Scale`)}</title>
            </g>
          </g>
        );
      })}
    </>
  );
}

function rates(motion: MotionAnswer, kind: "velocity" | "acceleration"): [string, Series][] {
  return Object.entries(motion.rates).flatMap(([body, points]) =>
    Object.entries(points).map(([point, rate]): [string, Series] => [`${body}.${point}`, rate[kind]]),
  );
}

function forceSeries(motion: MotionAnswer): [string, Series][] {
  return Object.entries(motion.forces?.joints ?? {});
}

/** Where an arrow begins: at the joint of that name, or the body's point. */
function position(figure: Figure, key: string): Vec | undefined {
  const [body, point] = key.split(".");
  const own = figure.bodies.find((one) => one.name === body)?.points.find((one) => one.name === point)?.at;
  return own ?? figure.joints.find((one) => one.name === key || key.startsWith(`${one.name}.`))?.block;
}

/** The body on which the force of a joint acts: the second one of a pin. */
function onBody(figure: Figure, key: string): string {
  const bodies = figure.joints.find((one) => one.name === key)?.bodies ?? [];
  return bodies.length === 2 ? ` → ${bodies[1]}` : "";
}

function arrow(
  key: string,
  from: Vec | undefined,
  series: Series,
  sample: Sample,
  by: number,
  camera: Camera,
  size: Size,
): Arrow[] {
  const [x, y] = [between(series.x, sample), between(series.y, sample)];
  if (from === undefined || x === null || y === null) return [];
  const at = toScreen(camera, size, from);
  return [{ key, at, to: vec(at.x + x * by, at.y - y * by), value: Math.hypot(x, y) }];
}

/** The greatest length of vectors over all samples. */
export function greatest(series: readonly Series[]): number {
  let most = 0;
  for (const { x, y } of series) {
    x.forEach((value, index) => {
      most = Math.max(most, Math.hypot(value ?? 0, y[index] ?? 0));
    });
  }
  return most;
}

/** An arrow with a head; nothing for one that is shorter than its head. */
export function arrowPath(from: Vec, to: Vec): string {
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  const length = Math.hypot(dx, dy);
  if (length < 3) return "";
  const [ux, uy] = [dx / length, dy / length];
  const head = Math.min(8, length / 2);
  const left = `${to.x - head * ux - 0.45 * head * uy} ${to.y - head * uy + 0.45 * head * ux}`;
  const right = `${to.x - head * ux + 0.45 * head * uy} ${to.y - head * uy - 0.45 * head * ux}`;
  return `M${from.x} ${from.y}L${to.x} ${to.y}M${left}L${to.x} ${to.y}L${right}`;
}
