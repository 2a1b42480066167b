/** The drawing of a linkage: bodies, joints, paths, arrows; where one draws and drags. */
import { useSignalEffect } from "@preact/signals";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { formatNumber, t } from "../../text";
import { formatQuantity } from "../../ui";
import { Arrows } from "./arrows";
import type { Editor } from "./editor";
import type { DrawnBody, DrawnJoint, Figure } from "./figure";
import { type Camera, gridStep, type Size, toScreen, type Vec } from "./geometry";
import { Loads } from "./loads";
import { GROUND } from "./mechanism";
import type { Pointer } from "./pointer";
import type { Tools } from "./tools";

interface Props {
  editor: Editor;
  tools: Tools;
  pointer: Pointer;
}

export function Canvas({ editor, tools, pointer }: Props) {
  const box = useRef<SVGSVGElement>(null);
  const [size, setSize] = useState<Size>({ width: 600, height: 400 });
  const fit = useRef(false);
  const measure = () => {
    const { clientWidth: width, clientHeight: height } = box.current ?? { clientWidth: 0, clientHeight: 0 };
    if (width > 0) pointer.size = { width, height };
  };
  useEffect(() => {
    const element = box.current;
    if (element === null) return undefined;
    const watch = new ResizeObserver(([entry]) => {
      const { width, height } = entry?.contentRect ?? { width: 600, height: 400 };
      if (width > 0 && height > 0) {
        pointer.size = { width, height };
        setSize({ width, height });
        if (fit.current && !pointer.hasPointed) pointer.fit();
      }
    });
    watch.observe(element);
    const wheel = (event: WheelEvent) => {
      event.preventDefault();
      pointer.wheel(position(event, element), event.deltaY);
    };
    element.addEventListener("wheel", wheel, { passive: false });
    return () => {
      watch.disconnect();
      element.removeEventListener("wheel", wheel);
    };
  }, []);
  useSignalEffect(() => {
    const answer = editor.answer.value;
    const figure = editor.figure.value;
    if (fit.current || pointer.hasPointed || answer === null || figure === null) return;
    fit.current = true;
    measure(); // the answer may come before the observer's first word on the size
    pointer.fit();
  });
  const figure = editor.figure.value;
  const camera = editor.camera.value;
  const shown = editor.shown.value;
  return (
    <svg
      ref={box}
      class={`linkage-canvas tool-${editor.tool.value}`}
      tabindex={0}
      role="application"
      aria-label={t("linkage.canvas")}
      aria-describedby="linkage-keys"
      data-round-trip={editor.roundTrip.value.toFixed(1)}
      onPointerDown={(event) => {
        measure();
        event.currentTarget.setPointerCapture(event.pointerId);
        const touch = event.pointerType === "touch";
        pointer.down(event.pointerId, position(event, event.currentTarget), touch, event.shiftKey, event.button);
      }}
      onPointerMove={(event) =>
        pointer.move(event.pointerId, position(event, event.currentTarget), event.pointerType === "touch")
      }
      onPointerUp={(event) =>
        pointer.up(event.pointerId, position(event, event.currentTarget), event.pointerType === "touch")
      }
      onPointerCancel={(event) =>
        pointer.up(event.pointerId, position(event, event.currentTarget), event.pointerType === "touch")
      }
      onContextMenu={(event) => event.preventDefault()}
    >
      {shown.grid && <Grid camera={camera} size={size} />}
      {figure !== null && (
        <>
          {shown.paths && <Paths editor={editor} camera={camera} size={size} />}
          <Drawing editor={editor} pointer={pointer} figure={figure} camera={camera} size={size} />
          <Loads editor={editor} figure={figure} camera={camera} size={size} />
          <Arrows editor={editor} figure={figure} camera={camera} size={size} />
        </>
      )}
      <Preview tools={tools} pointer={pointer} camera={camera} size={size} />
      <ScaleBar camera={camera} size={size} />
    </svg>
  );
}

function position(event: MouseEvent, element: Element): Vec {
  const { left, top } = element.getBoundingClientRect();
  return { x: event.clientX - left, y: event.clientY - top };
}

function Grid({ camera, size }: { camera: Camera; size: Size }) {
  const step = gridStep(camera.scale) * 5;
  const lines: string[] = [];
  const left = camera.centre.x - size.width / 2 / camera.scale;
  const low = camera.centre.y - size.height / 2 / camera.scale;
  for (let x = Math.ceil(left / step) * step; (x - left) * camera.scale < size.width; x += step) {
    lines.push(`M${((x - left) * camera.scale).toFixed(1)} 0V${size.height}`);
  }
  for (let y = Math.ceil(low / step) * step; (y - low) * camera.scale < size.height; y += step) {
    lines.push(`M0 ${(size.height - (y - low) * camera.scale).toFixed(1)}H${size.width}`);
  }
  return <path class="linkage-grid" d={lines.join("")} />;
}

/** Paths of the points: those that are no joints strongly, joints faintly. */
function Paths({ editor, camera, size }: { editor: Editor; camera: Camera; size: Size }) {
  const motion = editor.answer.value?.motion;
  const names = editor.answer.value?.joints;
  const paths = useMemo(() => {
    const joints = new Set(names?.map((joint) => joint.name));
    return Object.entries(motion?.points ?? {}).flatMap(([body, points]) =>
      Object.entries(points).map(([point, { x, y }]) => {
        let open = true;
        const d = x
          .map((value, index) => {
            const other = y[index];
            if (value == null || other == null) {
              open = true;
              return "";
            }
            const part = `${open ? "M" : "L"}${value} ${other}`;
            open = false;
            return part;
          })
          .join("");
        return { key: `${body}.${point}`, d, joint: joints.has(point) };
      }),
    );
  }, [motion, names]);
  const { x, y } = toScreen(camera, size, { x: 0, y: 0 });
  const chosen = editor.selection.value.points;
  return (
    <g transform={`translate(${x} ${y}) scale(${camera.scale} ${-camera.scale})`}>
      {paths.map((path) => (
        <path
          key={path.key}
          class={`linkage-path${path.joint ? " joint" : ""}${chosen.includes(path.key) ? " chosen" : ""}`}
          d={path.d}
          vector-effect="non-scaling-stroke"
        />
      ))}
    </g>
  );
}

interface DrawingProps {
  editor: Editor;
  pointer: Pointer;
  figure: Figure;
  camera: Camera;
  size: Size;
}

function Drawing({ editor, pointer, figure, camera, size }: DrawingProps) {
  const at = (point: Vec) => toScreen(camera, size, point);
  const { bodies, joints, points } = editor.selection.value;
  const { names } = editor.shown.value;
  const groups = editor.answer.value?.structure.groups ?? [];
  const groupOf = new Map(groups.flatMap((group, index) => group.bodies.map((body) => [body, index] as const)));
  const moving = figure.bodies.filter((body) => body.name !== GROUND);
  return (
    <g class={figure.closes ? "" : "linkage-open"}>
      <Couplings editor={editor} figure={figure} at={at} scale={camera.scale} />
      {figure.joints
        .filter((joint) => joint.kind === "slide")
        .map((joint) => (
          <SlideShape key={joint.name} joint={joint} at={at} />
        ))}
      {moving.map((body) => (
        <BodyShape
          key={body.name}
          body={body}
          at={at}
          chosen={bodies.includes(body.name)}
          group={groupOf.get(body.name)}
          named={names}
        />
      ))}
      {figure.points
        .filter((point) => point.joint === undefined)
        .map((point) => {
          const { x, y } = at(point.at);
          const id = `${point.body}.${point.name}`;
          return (
            <g
              key={id}
              class={`linkage-point${points.includes(id) ? " chosen" : ""}${point.body === GROUND ? " ground" : ""}`}
            >
              <path d={`M${x} ${y - 5}l5 5-5 5-5-5z`} />
              {names && (
                <text x={x + 8} y={y - 7}>
                  {point.name}
                </text>
              )}
            </g>
          );
        })}
      {figure.joints.map((joint) => (
        <JointShape
          key={joint.name}
          pointer={pointer}
          joint={joint}
          at={at}
          chosen={joints.includes(joint.name)}
          named={names}
        />
      ))}
    </g>
  );
}

interface BodyProps {
  body: DrawnBody;
  at: (point: Vec) => Vec;
  chosen: boolean;
  group: number | undefined;
  named: boolean;
}

function BodyShape({ body, at, chosen, group, named }: BodyProps) {
  const corners = body.outline.map(at);
  const [first] = corners;
  if (first === undefined) return null;
  const colour = group === undefined ? "loose" : `group-${group % 8}`;
  const middle = {
    x: corners.reduce((sum, one) => sum + one.x, 0) / corners.length,
    y: corners.reduce((sum, one) => sum + one.y, 0) / corners.length,
  };
  const d = `M${corners.map((one) => `${one.x.toFixed(2)} ${one.y.toFixed(2)}`).join("L")}${corners.length > 2 ? "Z" : ""}`;
  return (
    <g
      class={`linkage-body ${colour}${chosen ? " chosen" : ""}${body.solved ? "" : " unsolved"}`}
      data-body={body.name}
    >
      {corners.length === 1 ? <path class="block" d={`M${first.x - 11} ${first.y - 8}h22v16h-22z`} /> : <path d={d} />}
      {named && corners.length > 1 && (
        <text x={middle.x + 6} y={middle.y - 8}>
          {body.name}
        </text>
      )}
    </g>
  );
}

function SlideShape({ joint, at }: { joint: DrawnJoint; at: (point: Vec) => Vec }) {
  const [from, to] = [at(joint.at), at(joint.block)];
  const [dx, dy] = [Math.cos(joint.line), -Math.sin(joint.line)];
  const apart = (to.x - from.x) * dx + (to.y - from.y) * dy;
  const [low, high] = [Math.min(0, apart) - 46, Math.max(0, apart) + 46];
  const turn = (-joint.line * 180) / Math.PI;
  return (
    <g class={`linkage-slide${joint.grounded ? " ground" : ""}`}>
      <path d={`M${from.x + low * dx} ${from.y + low * dy}L${from.x + high * dx} ${from.y + high * dy}`} />
      <rect x={-14} y={-9} width={28} height={18} transform={`translate(${to.x} ${to.y}) rotate(${turn})`} />
    </g>
  );
}

interface JointProps {
  pointer: Pointer;
  joint: DrawnJoint;
  at: (point: Vec) => Vec;
  chosen: boolean;
  named: boolean;
}

function JointShape({ pointer, joint, at, chosen, named }: JointProps) {
  const { x, y } = at(joint.at);
  const kind = t(joint.kind === "slide" ? "linkage.slideOf" : joint.grounded ? "linkage.pivotOf" : "linkage.pinOf", {
    name: joint.name,
    bodies: joint.bodies.join(", "),
  });
  const where = `${formatQuantity(joint.at.x, "mm")}, ${formatQuantity(joint.at.y, "mm")}`;
  return (
    <g
      class={`linkage-joint ${joint.kind}${chosen ? " chosen" : ""}${joint.driven ? " driven" : ""}`}
      transform={`translate(${x.toFixed(2)} ${y.toFixed(2)})`}
      role="button"
      tabindex={0}
      aria-label={`${kind}; ${where}${joint.driven ? `; ${t("linkage.driven")}` : ""}`}
      aria-pressed={chosen}
      data-joint={joint.name}
      onFocus={() => pointer.focusJoint(joint.name, joint.at)}
    >
      <circle class="reach" r={13} />
      {joint.grounded && joint.kind === "pin" && (
        <path class="foot" d="M0 0l-10 17h20zM-13 17h26M-10 17l-4 5M-2 17l-4 5M6 17l-4 5" />
      )}
      {joint.kind === "pin" ? <circle class="pin" r={5.5} /> : <path class="pin" d="M-4-4h8v8h-8z" />}
      {joint.driven && <path class="drive" d="M-12-9a15 15 0 0 1 24 0M12-9l1-7M12-9l-7-1" />}
      {named && (
        <text x={9} y={-9}>
          {joint.name}
        </text>
      )}
    </g>
  );
}

function Couplings({
  editor,
  figure,
  at,
  scale,
}: {
  editor: Editor;
  figure: Figure;
  at: (p: Vec) => Vec;
  scale: number;
}) {
  const centre = (body: string, point: string) =>
    figure.bodies.find((one) => one.name === body)?.points.find((one) => one.name === point)?.at;
  return (
    <>
      {(editor.answer.value?.couplings ?? []).map((coupling) => {
        const a = centre(...coupling.first);
        const b = centre(...coupling.second);
        if (a === undefined || b === undefined || coupling.kind === "rack") return null;
        const apart = Math.hypot(b.x - a.x, b.y - a.y);
        const { ratio, kind } = coupling;
        const size = Math.abs(ratio);
        const second =
          kind === "belt" ? apart * 0.25 : ratio < 0 ? apart / (1 + size) : apart / Math.max(Math.abs(1 - size), 0.05);
        const [p, q] = [at(a), at(b)];
        return (
          <g key={coupling.name} class="linkage-gears">
            <circle cx={p.x} cy={p.y} r={size * second * scale} />
            <circle cx={q.x} cy={q.y} r={second * scale} />
            {kind === "belt" && <path d={`M${p.x} ${p.y}L${q.x} ${q.y}`} />}
            <text x={(p.x + q.x) / 2} y={(p.y + q.y) / 2 + 18}>
              {`${coupling.name} ${formatNumber(ratio)}`}
            </text>
          </g>
        );
      })}
    </>
  );
}

/** What a click would draw, the frame of a selection, the cross of the keys. */
function Preview({ tools, pointer, camera, size }: { tools: Tools; pointer: Pointer; camera: Camera; size: Size }) {
  const { spots, next } = tools.draft.value;
  const frame = pointer.frame.value;
  const cross = pointer.cross.value;
  const at = (point: Vec) => toScreen(camera, size, point);
  const line = [...spots.map((spot) => spot.at), ...(next ? [next.at] : [])].map(at);
  const end = next ? at(next.at) : null;
  const last = spots.at(-1);
  const note = next && last ? formatQuantity(Math.hypot(next.at.x - last.at.x, next.at.y - last.at.y), "mm") : "";
  return (
    <g class="linkage-preview">
      {line.length > 1 && <path d={`M${line.map((one) => `${one.x} ${one.y}`).join("L")}`} />}
      {spots.map((spot, index) => {
        const { x, y } = at(spot.at);
        return <circle key={index} cx={x} cy={y} r={4} />;
      })}
      {end && <circle class={`snap-${next?.to}`} cx={end.x} cy={end.y} r={next?.to === "point" ? 10 : 5} />}
      {end && note !== "" && (
        <text x={end.x + 12} y={end.y - 10}>
          {note}
        </text>
      )}
      {cross && (
        <path class="cross" d={`M${at(cross).x - 14} ${at(cross).y}h28M${at(cross).x} ${at(cross).y - 14}v28`} />
      )}
      {frame && <FrameShape from={at(frame.from)} to={at(frame.to)} />}
    </g>
  );
}

function FrameShape({ from, to }: { from: Vec; to: Vec }) {
  return (
    <rect
      x={Math.min(from.x, to.x)}
      y={Math.min(from.y, to.y)}
      width={Math.abs(to.x - from.x)}
      height={Math.abs(to.y - from.y)}
    />
  );
}

function ScaleBar({ camera, size }: { camera: Camera; size: Size }) {
  const step = gridStep(camera.scale) * 5;
  const wide = step * camera.scale;
  return (
    <g class="linkage-scale">
      <path d={`M14 ${size.height - 12}v-5v5h${wide.toFixed(1)}v-5`} />
      <text x={14 + wide + 6} y={size.height - 10}>
        {formatQuantity(step, step < 1 ? "mm" : "m")}
      </text>
    </g>
  );
}
