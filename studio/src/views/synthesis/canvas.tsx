import type { ComponentChildren, RefObject } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { t } from "../../text";
import { useSize, Zoom } from "../../ui";
import { type At, type Camera, fitted, gridLines, type Size, toPlane, toScreen, zoomed } from "./camera";
import {
  dragged,
  type Handle,
  handleAt,
  handlesOf,
  nearest,
  nudged,
  type RegionKind,
  type Scene,
  snappedToPlane,
} from "./handles";
import { rectangle, type TaskPoint } from "./task";

interface CanvasProps {
  label: string;
  scene: Scene;
  /** Everything that is in sight when the drawing is fitted. */
  content: readonly At[];
  /** Name of a handle, for the keyboard and screen readers. */
  nameOf: (handle: Handle) => string;
  /** Units of the axes as they are shown, and their factors. */
  axes: { x: (value: number) => string; y: (value: number) => string };
  /** Each axis has its own scale. */
  stretched?: boolean;
  /** A region that is drawn with the next drag; null: points are clicked. */
  drawing: RegionKind | null;
  canAdd: boolean;
  /** What a press on the empty plane makes: its direction is dragged; null: a point that is clicked. */
  poseAt?: ((at: At) => TaskPoint) | null;
  chosen: number;
  onChoose: (index: number) => void;
  onScene: (scene: Scene, settled: boolean) => void;
  onAdd: (at: At) => void;
  onRemove: (handle: Handle) => void;
  /** Drawn below and above the handles. */
  behind: (camera: Camera) => ComponentChildren;
}

interface Drag {
  handle: Handle | null;
  from: At;
  camera: Camera;
  moved: boolean;
  /** The scene as it was dragged last. */
  scene: Scene;
  /** The plane is moved, whatever lies there. */
  pans: boolean;
}

/** Distance from a click to a drag [px]. */
const SLACK = 4;

/** A plane with points that are clicked, dragged, or moved by arrow keys. */
export function Canvas(props: CanvasProps) {
  const { scene, onScene } = props;
  const svg = useRef<SVGSVGElement>(null);
  const size = useSize(svg);
  const drag = useRef<Drag | null>(null);
  const [isUnderMouse, setUnderMouse] = useState(false);
  const [camera, setCamera] = useCamera(props, size, isUnderMouse, drag);
  const at = (event: PointerEvent | WheelEvent): At => {
    const box = svg.current?.getBoundingClientRect();
    return { x: event.clientX - (box?.left ?? 0), y: event.clientY - (box?.top ?? 0) };
  };
  const down = (event: PointerEvent) => {
    if (event.button > 1) return;
    const from = at(event);
    const pans = event.button === 1 || event.shiftKey;
    const reach = event.pointerType === "mouse" ? 13 : 22;
    const handle = props.drawing || pans ? null : nearest(scene, camera, from, reach);
    drag.current = { handle, from, camera, moved: false, scene, pans };
    svg.current?.setPointerCapture(event.pointerId);
    if (handle && handle.kind !== "corner") props.onChoose(handle.index);
  };
  const move = (event: PointerEvent) => {
    const now = drag.current;
    if (now === null) return;
    const to = at(event);
    if (!now.moved && Math.hypot(to.x - now.from.x, to.y - now.from.y) < SLACK) return;
    now.moved = true;
    if (!now.handle && !now.pans && !props.drawing && props.canAdd && props.poseAt) {
      const index = scene.points.length;
      now.handle = { kind: "angle", index };
      now.scene = { ...scene, points: [...scene.points, props.poseAt(snappedToPlane(camera, now.from))] };
      props.onChoose(index);
    }
    if (now.handle) now.scene = dragged(now.scene, camera, now.handle, to);
    else if (props.drawing && !now.pans) now.scene = withRegion(scene, props.drawing, camera, now.from, to);
    if (now.handle || (props.drawing && !now.pans)) onScene(now.scene, false);
    else setCamera({ ...now.camera, ox: now.camera.ox + to.x - now.from.x, oy: now.camera.oy + to.y - now.from.y });
  };
  const up = (event: PointerEvent) => {
    const now = drag.current;
    drag.current = null;
    if (now === null) return;
    if (now.moved && (now.handle || (props.drawing && !now.pans))) onScene(now.scene, true);
    else if (!now.moved && !now.handle && !now.pans && !props.drawing && props.canAdd && event.type === "pointerup")
      props.onAdd(snappedToPlane(camera, now.from));
  };
  const wheel = (event: WheelEvent) => {
    event.preventDefault();
    setCamera(zoomed(camera, Math.exp(-event.deltaY * 0.0015), at(event)));
  };
  useEffect(() => {
    const own = svg.current;
    own?.addEventListener("wheel", wheel, { passive: false });
    return () => own?.removeEventListener("wheel", wheel);
  });
  const middle = { x: size.width / 2, y: size.height / 2 };
  return (
    <div class="synthesis-canvas">
      <svg
        ref={svg}
        role="group"
        aria-label={props.label}
        class={props.drawing ? "drawing" : ""}
        onPointerEnter={(event) => setUnderMouse(event.pointerType === "mouse")}
        onPointerLeave={() => setUnderMouse(false)}
        onPointerDown={down}
        onPointerMove={move}
        onPointerUp={up}
        onPointerCancel={up}
      >
        <Grid camera={camera} size={size} axes={props.axes} />
        <Regions scene={scene} camera={camera} />
        {props.behind(camera)}
        <Handles {...props} camera={camera} />
      </svg>
      <Zoom
        onZoom={(factor) => setCamera(zoomed(camera, factor, middle))}
        onFit={() => setCamera(fitted(props.content, size, 44, props.stretched))}
      />
    </div>
  );
}

function withRegion(scene: Scene, kind: RegionKind, camera: Camera, from: At, to: At): Scene {
  const made = dragged(
    { points: [toPlane(camera, from), toPlane(camera, to)], regions: {} },
    camera,
    { kind: "point", index: 0 },
    from,
  );
  const ends = dragged(made, camera, { kind: "point", index: 1 }, to).points;
  const [one, other] = [ends[0] ?? { x: 0, y: 0 }, ends[1] ?? { x: 0, y: 0 }];
  return { ...scene, regions: { ...scene.regions, [kind]: rectangle(one, other) } };
}

/**
 * The camera: fitted anew where the content leaves the drawing, or fills little of it, but never during a drag, and not
 * under a mouse, so that the plane stands still while points are clicked.
 */
function useCamera(props: CanvasProps, size: Size, isBusy: boolean, drag: RefObject<Drag | null>) {
  const { content, scene, stretched = false } = props;
  const [camera, setCamera] = useState<Camera>(() => fitted(content, size, 44, stretched));
  const lastSize = useRef(size);
  useEffect(() => {
    const resized = lastSize.current !== size;
    if (drag.current !== null || (isBusy && !resized)) return;
    lastSize.current = size;
    const isBare = content.length === scene.points.length;
    if (resized || !inSight(camera, content, size, isBare ? 0 : 0.4)) setCamera(fitted(content, size, 44, stretched));
  }, [content, size, stretched, isBusy]);
  return [camera, setCamera] as const;
}

function inSight(camera: Camera, content: readonly At[], size: Size, least: number): boolean {
  if (content.length === 0) return true;
  const all = content.map((one) => toScreen(camera, one));
  const [xs, ys] = [all.map((one) => one.x), all.map((one) => one.y)];
  const [left, right, high, low] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const filled = Math.max((right - left) / size.width, (low - high) / size.height);
  return left >= 0 && high >= 0 && right <= size.width && low <= size.height && filled >= least;
}

function Grid({ camera, size, axes }: { camera: Camera; size: Size; axes: CanvasProps["axes"] }) {
  const low = toPlane(camera, { x: 0, y: size.height });
  const high = toPlane(camera, { x: size.width, y: 0 });
  const columns = gridLines(low.x, high.x, Math.max(2, size.width / 90));
  const rows = gridLines(low.y, high.y, Math.max(2, size.height / 70));
  return (
    <g class="grid">
      {columns.map((x) => {
        const at = toScreen(camera, { x, y: 0 }).x;
        return (
          <g key={x}>
            <line class={x === 0 ? "axis" : ""} x1={at} x2={at} y1={0} y2={size.height} />
            <text x={at + 3} y={size.height - 4}>
              {axes.x(x)}
            </text>
          </g>
        );
      })}
      {rows.map((y) => {
        const at = toScreen(camera, { x: 0, y }).y;
        return (
          <g key={y}>
            <line class={y === 0 ? "axis" : ""} x1={0} x2={size.width} y1={at} y2={at} />
            <text x={4} y={at - 3}>
              {axes.y(y)}
            </text>
          </g>
        );
      })}
    </g>
  );
}

function Regions({ scene, camera }: { scene: Scene; camera: Camera }) {
  return (
    <>
      {(Object.keys(scene.regions) as RegionKind[]).map((kind) => {
        const corners = (scene.regions[kind] ?? []).map((one) => toScreen(camera, one));
        const first = corners.reduce((a, b) => (b.x + b.y < a.x + a.y ? b : a), corners[0] ?? { x: 0, y: 0 });
        return (
          <g key={kind} class={`region ${kind}`}>
            <polygon points={corners.map((one) => `${one.x},${one.y}`).join(" ")} />
            <text x={first.x + 8} y={first.y + 16}>
              {t(kind === "pivots" ? "synthesis.pivotRegion" : "synthesis.keepOut")}
            </text>
          </g>
        );
      })}
    </>
  );
}

function Handles(props: CanvasProps & { camera: Camera }) {
  const { scene, camera, onScene } = props;
  const press = (handle: Handle) => (event: KeyboardEvent) => {
    if (event.key === "Delete" || event.key === "Backspace") {
      event.preventDefault();
      props.onRemove(handle);
      return;
    }
    const next = nudged(scene, camera, handle, event.key, event.shiftKey);
    if (next === null) return;
    event.preventDefault();
    onScene(next, true);
  };
  return (
    <>
      {handlesOf(scene)
        .reverse()
        .map((handle) => {
          const at = handleAt(scene, camera, handle);
          if (at === null) return null;
          const key = handle.kind === "corner" ? `${handle.region}${handle.index}` : `${handle.kind}${handle.index}`;
          const own = handle.kind !== "corner" && handle.index === props.chosen;
          const from = handle.kind === "angle" ? handleAt(scene, camera, { kind: "point", index: handle.index }) : null;
          return (
            <g
              key={key}
              class={`handle ${handle.kind} ${own ? "chosen" : ""}`}
              tabindex={0}
              role="button"
              aria-label={props.nameOf(handle)}
              onKeyDown={press(handle)}
              onFocus={() => handle.kind !== "corner" && props.onChoose(handle.index)}
            >
              {from && <line x1={from.x} y1={from.y} x2={at.x} y2={at.y} />}
              <circle class="reach" cx={at.x} cy={at.y} r={13} />
              {handle.kind === "corner" ? (
                <rect x={at.x - 5} y={at.y - 5} width={10} height={10} />
              ) : (
                <circle class="dot" cx={at.x} cy={at.y} r={handle.kind === "angle" ? 5 : 7} />
              )}
              {handle.kind === "point" && (
                <text x={at.x + 10} y={at.y - 9}>
                  {handle.index + 1}
                </text>
              )}
            </g>
          );
        })}
    </>
  );
}
