/** Forces and masses of the file, with their values; a force is turned and scaled by its tip. */
import { useSignal } from "@preact/signals";
import { formatQuantity, readQuantity } from "../../ui";
import { arrowPath } from "./arrows";
import type { Editor } from "./editor";
import type { Figure } from "./figure";
import {
  type Camera,
  direction,
  distance,
  type Pose,
  type Size,
  STILL,
  toScreen,
  toWorld,
  type Vec,
  vec,
} from "./geometry";
import { type MechanismData, setForce } from "./mechanism";

/** Length of the greatest force on the screen [px]. */
const LONGEST = 84;
const DEGREE = Math.PI / 180;

type Entry = number | string;

interface Load {
  readonly name: string;
  readonly at: Vec;
  /** Its magnitude [N], and its direction in the world [rad]. */
  readonly size: number;
  readonly turn: number;
  /** Angle of the frame in which its direction is given [rad]. */
  readonly frame: number;
}

/** A quantity of the file [SI]. */
function si(entry: Entry | undefined, unit: string): number {
  const read = readQuantity(String(entry ?? 0), unit);
  return typeof entry === "number" ? entry : "si" in read ? read.si : 0;
}

/** A point of a body in the world, by its name or its coordinates. */
function placed(figure: Figure, body: string, point: string | readonly [Entry, Entry]): Vec | undefined {
  if (typeof point === "string")
    return figure.bodies.find((one) => one.name === body)?.points.find((one) => one.name === point)?.at;
  return toWorld(figure.poses[body] ?? STILL, vec(si(point[0], "mm"), si(point[1], "mm")));
}

/** The forces of constant size. */
export function forcesOf(data: MechanismData, figure: Figure): Load[] {
  return Object.entries((data["loads"] ?? {}) as Record<string, Record<string, unknown>>).flatMap(([name, load]) => {
    const [body, point] = (load["on"] ?? []) as string[];
    const at = body === undefined || point === undefined ? undefined : placed(figure, body, point);
    if (load["force"] === undefined || load["table"] !== undefined || at === undefined) return [];
    const pose: Pose = figure.poses[body ?? ""] ?? STILL;
    const frame = load["frame"] === "body" ? pose.angle : 0;
    const force = load["force"] as Entry | readonly [Entry, Entry];
    const [x, y] = Array.isArray(force) ? [si(force[0], "N"), si(force[1], "N")] : [si(force as Entry, "N"), 0];
    const turn = Math.atan2(y, x) + si(load["direction"] as Entry, "deg") + frame;
    return [{ name, at, size: Math.hypot(x, y), turn, frame }];
  });
}

/** The mass of each body that has one, and where its centre is. */
function massesOf(data: MechanismData, figure: Figure): { body: string; at: Vec; mass: number }[] {
  return Object.entries(data.bodies ?? {}).flatMap(([body, table]) => {
    const { mass, centre, length } = table as Record<string, unknown>;
    const half = si(length as Entry, "mm") / 2;
    const at = placed(figure, body, (centre as string | [Entry, Entry]) ?? [half, 0]);
    return mass === undefined || at === undefined ? [] : [{ body, at, mass: si(mass as Entry, "kg") }];
  });
}

interface Props {
  editor: Editor;
  figure: Figure;
  camera: Camera;
  size: Size;
}

export function Loads({ editor, figure, camera, size }: Props) {
  const data = editor.document.data.value;
  const held = useSignal<{ name: string; tip: Vec } | null>(null);
  if (data === null) return null;
  const forces = forcesOf(data, figure);
  const most = Math.max(...forces.map((one) => one.size));
  return (
    <g class="linkage-loads">
      {massesOf(data, figure).map(({ body, at, mass }) => {
        const { x, y } = toScreen(camera, size, at);
        return (
          <g key={body} transform={`translate(${x} ${y})`} pointer-events="none">
            <path d="M0 0V-7A7 7 0 0 1 7 0zM0 0V7A7 7 0 0 1 -7 0z" />
            <circle r={7} />
            <text x={10} y={18}>
              {formatQuantity(mass, "kg", 3)}
            </text>
          </g>
        );
      })}
      {forces.map((load) => {
        const at = toScreen(camera, size, load.at);
        const by = (LONGEST * load.size) / most;
        const rest = vec(at.x + by * Math.cos(load.turn), at.y - by * Math.sin(load.turn));
        const tip = held.value?.name === load.name ? held.value.tip : rest;
        const turn = Math.round(-direction(at, tip) / DEGREE) * DEGREE;
        const force = (most * distance(at, tip)) / LONGEST;
        return (
          <g key={load.name} class="force">
            <path d={arrowPath(at, tip)} />
            <text x={tip.x + 10} y={tip.y - 8}>
              {`${formatQuantity(force, "N", 3)}, ${formatQuantity(turn, "deg", 3)}`}
            </text>
            <circle
              class="grip"
              data-load={load.name}
              cx={tip.x}
              cy={tip.y}
              r={12}
              onPointerDown={(event) => {
                event.stopPropagation();
                event.currentTarget.setPointerCapture(event.pointerId);
                held.value = { name: load.name, tip };
              }}
              onPointerMove={(event) => {
                if (held.peek()?.name !== load.name) return;
                event.stopPropagation();
                const box = event.currentTarget.ownerSVGElement?.getBoundingClientRect();
                held.value = {
                  name: load.name,
                  tip: vec(event.clientX - (box?.x ?? 0), event.clientY - (box?.y ?? 0)),
                };
              }}
              onPointerUp={(event) => {
                event.stopPropagation();
                if (held.peek() !== null && force > 0)
                  editor.edit((copy) => setForce(copy, load.name, force, turn - load.frame));
                held.value = null;
              }}
            />
          </g>
        );
      })}
    </g>
  );
}
