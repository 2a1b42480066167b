import { type Signal, useSignal } from "@preact/signals";
import type { RefObject } from "preact";
import { useEffect, useRef } from "preact/hooks";
import {
  heldKnot,
  type Knot,
  knotAt,
  middleKnot,
  nearestKnot,
  panned,
  type Size,
  showing,
  type View,
  wholeView,
  zoomed,
} from "./geometry";
import type { CarpetModel } from "./model";
import { mirrored, placeAbout, turned } from "./placing";
import { areaEdits, editsOf, type Hand, isPoint, type Point, pinched, takesPart } from "./pointer";
import type { Renderer } from "./renderer";
import { lineKnots } from "./strokes";
import { brushSpans, imagesOf } from "./symmetry";

interface Stage {
  model: CarpetModel;
  canvas: RefObject<HTMLCanvasElement | null>;
  renderer: RefObject<Renderer | null>;
  view: Signal<View>;
  size: Signal<Size>;
  cursor: Signal<Knot | null>;
  hover: Signal<Knot | null>;
}

type Pair = readonly [Knot, Knot];

/** Factor of one step of the wheel, and knots of a step of the cursor with the shift key. */
const WHEEL = 1.0018;
const LEAP = 10;

/** What the pointers and keys do on the canvas. */
export function useHand(stage: Stage) {
  const { model, canvas, renderer, view, size, cursor, hover } = stage;
  const part = useSignal<Pair | null>(null);
  const line = useSignal<Pair | null>(null);
  const fingers = useRef(new Map<number, Point>());
  const stroke = useRef<Knot[] | null>(null);
  const anchor = useRef<Knot | null>(null);
  const panning = useRef(false);

  const grid = () => model.chart.peek()?.grid ?? null;
  const pointOf = (event: MouseEvent): Point => {
    const box = canvas.current?.getBoundingClientRect();
    return { x: event.clientX - (box?.left ?? 0), y: event.clientY - (box?.top ?? 0) };
  };

  // A wheel that zooms must not scroll the page: such a listener is not passive.
  useEffect(() => {
    const element = canvas.current;
    const wheel = (event: WheelEvent) => {
      const own = grid();
      if (own === null) return;
      event.preventDefault();
      const at = pointOf(event);
      const step = event.deltaMode === 1 ? 30 * event.deltaY : event.deltaY;
      if (event.shiftKey) view.value = panned(view.peek(), own, size.peek(), -event.deltaY - event.deltaX, 0);
      else view.value = zoomed(view.peek(), own, size.peek(), WHEEL ** -step, at.x, at.y);
    };
    element?.addEventListener("wheel", wheel, { passive: false });
    return () => element?.removeEventListener("wheel", wheel);
  }, [canvas.current]);

  /** Shows a stroke and its images on the screen at once. */
  const preview = (points: readonly Knot[]) => {
    const [last, before] = [points[points.length - 1], points[points.length - 2]];
    const [yarn, own] = [model.yarnIndex.peek(), grid()];
    if (last === undefined || own === null || yarn < 0) return;
    const path = lineKnots(before ?? last, last);
    const knots = imagesOf(path, model.symmetry.peek(), own).flat();
    renderer.current?.paint(
      knots.flatMap((knot) => brushSpans(knot, model.brush.peek(), own)),
      yarn,
    );
  };

  /** Places what is held about a knot; false: nothing is. */
  const drop = (knot: Knot): boolean => {
    const [placing, own] = [model.placing.peek(), grid()];
    if (placing === null || own === null) return false;
    model.place(placeAbout(knot, placing, own));
    return true;
  };

  /** Ends a stroke: its edits go to the recipe, a tile to the tool. */
  const finish = (points: readonly Knot[]) => {
    const own = grid();
    const [first, last] = [points[0], points[points.length - 1]];
    part.value = null;
    line.value = null;
    if (own === null || first === undefined || last === undefined) return;
    if (model.tool.peek() === "select") {
      model.selection.value = isPoint(first, last) ? null : [first, last];
      return;
    }
    if (model.tool.peek() === "repeat" && model.tile.peek() === null) {
      if (!isPoint(first, last)) model.tile.value = [first, last];
      return;
    }
    model.edit(editsOf(handOf(model), points, own));
  };

  const show = (points: readonly Knot[]) => {
    const tool = model.tool.peek();
    const [first, last] = [points[0], points[points.length - 1]];
    if (first === undefined || last === undefined) return;
    part.value = takesPart(tool) ? [first, last] : null;
    line.value = tool === "line" ? [first, last] : null;
  };

  const down = (event: PointerEvent) => {
    const own = grid();
    if (own === null) return;
    const at = pointOf(event);
    canvas.current?.setPointerCapture(event.pointerId);
    fingers.current.set(event.pointerId, at);
    if (fingers.current.size > 1) {
      stroke.current = null;
      part.value = null;
      line.value = null;
      panning.current = true;
      return;
    }
    const knot = nearestKnot(view.peek(), own, size.peek(), at.x, at.y);
    if (event.altKey) {
      model.takeYarn(knot);
      return;
    }
    panning.current = model.tool.peek() === "pan" || event.button !== 0;
    if (panning.current) return;
    if (drop(knot)) return;
    stroke.current = [knot];
    cursor.value = null;
    if (model.tool.peek() === "pencil") preview([knot]);
    show([knot]);
  };

  const move = (event: PointerEvent) => {
    const own = grid();
    if (own === null) return;
    const at = pointOf(event);
    const before = fingers.current.get(event.pointerId);
    if (event.pointerType !== "touch" || before !== undefined) {
      hover.value = knotAt(view.peek(), own, size.peek(), at.x, at.y);
    }
    if (before === undefined) return;
    const [one, two] = [...fingers.current.entries()];
    if (one !== undefined && two !== undefined) {
      const old = [one[1], two[1]] as const;
      fingers.current.set(event.pointerId, at);
      const now = [fingers.current.get(one[0]) ?? at, fingers.current.get(two[0]) ?? at] as const;
      view.value = pinched(view.peek(), own, size.peek(), old, now);
      return;
    }
    fingers.current.set(event.pointerId, at);
    if (panning.current) {
      view.value = panned(view.peek(), own, size.peek(), at.x - before.x, at.y - before.y);
      return;
    }
    const points = stroke.current;
    const knot = nearestKnot(view.peek(), own, size.peek(), at.x, at.y);
    const last = points?.[points.length - 1];
    if (points === null || last === undefined || isPoint(last, knot)) return;
    points.push(knot);
    if (model.tool.peek() === "pencil") preview(points);
    show(points);
  };

  const up = (event: PointerEvent) => {
    fingers.current.delete(event.pointerId);
    const points = stroke.current;
    stroke.current = null;
    if (event.type === "pointerup" && points !== null && !panning.current) finish(points);
    else {
      part.value = null;
      line.value = null;
    }
  };

  /** The key of a tool at the cursor: one knot, or the first and then the other end. */
  const press = (knot: Knot) => {
    const tool = model.tool.peek();
    if (tool === "pan" || drop(knot)) return;
    if (tool === "pencil" || tool === "fill") {
      if (tool === "pencil") preview([knot]);
      finish([knot]);
    } else if (anchor.current === null) {
      anchor.current = knot;
      show([knot, knot]);
    } else {
      finish([anchor.current, knot]);
      anchor.current = null;
    }
  };

  /** Keys of a selected part and of what is held; whether it was one. */
  const heldKey = (event: KeyboardEvent): boolean => {
    const placing = model.placing.peek();
    const command = event.ctrlKey || event.metaKey;
    if (command && (event.key === "c" || event.key === "x") && model.selection.peek() !== null)
      model.hold(event.key === "c" ? "copy" : "move");
    else if (placing !== null && !command && event.key === "r") model.placing.value = turned(placing);
    else if (placing !== null && !command && event.key === "m") model.placing.value = mirrored(placing);
    else if (placing !== null && event.key === "Escape") model.placing.value = null;
    else return false;
    event.preventDefault();
    return true;
  };

  const key = (event: KeyboardEvent) => {
    const own = grid();
    if (own === null || heldKey(event) || event.ctrlKey || event.metaKey || event.altKey) return;
    const { width, height } = size.peek();
    const step = event.shiftKey ? LEAP : 1;
    const moves: Record<string, readonly [number, number]> = {
      ArrowLeft: [-step, 0],
      ArrowRight: [step, 0],
      ArrowUp: [0, -step],
      ArrowDown: [0, step],
      Home: [-own.columns, 0],
      End: [own.columns, 0],
      PageUp: [0, -LEAP],
      PageDown: [0, LEAP],
    };
    const by = moves[event.key];
    const at = heldKnot(cursor.peek() ?? middleKnot(view.peek()), own);
    if (by !== undefined) {
      const fresh = cursor.peek() === null;
      const to = fresh ? at : heldKnot({ column: at.column + by[0], line: at.line + by[1] }, own);
      cursor.value = to;
      hover.value = null;
      view.value = showing(view.peek(), own, size.peek(), to);
      if (anchor.current !== null) show([anchor.current, to]);
    } else if (event.key === "Enter" || event.key === " ") press(at);
    else if (event.key === "p") model.takeYarn(at);
    else if (event.key === "Escape") {
      anchor.current = null;
      stroke.current = null;
      part.value = null;
      line.value = null;
      model.tile.value = null;
      model.selection.value = null;
      cursor.value = null;
    } else if (event.key === "+" || event.key === "=" || event.key === "-") {
      const factor = event.key === "-" ? 1 / 1.4 : 1.4;
      view.value = zoomed(view.peek(), own, size.peek(), factor, width / 2, height / 2);
      if (cursor.peek() !== null) view.value = showing(view.peek(), own, size.peek(), at);
    } else if (event.key === "0") view.value = wholeView(own, size.peek());
    else return;
    event.preventDefault();
  };

  const leave = () => {
    hover.value = null;
  };
  return { part, line, down, move, up, key, leave };
}

/** The listeners of a canvas. */
export function listenersOf({ down, move, up, key, leave }: ReturnType<typeof useHand>) {
  return {
    onPointerDown: down,
    onPointerMove: move,
    onPointerUp: up,
    onPointerCancel: up,
    onPointerLeave: leave,
    onKeyDown: key,
    onContextMenu: (event: Event) => event.preventDefault(),
  };
}

/** The edits of the tool in hand on the whole carpet go to the recipe. */
export function applyToWhole(model: CarpetModel): void {
  const chart = model.chart.peek();
  if (chart === null) return;
  model.edit(areaEdits(handOf(model), null, chart.grid));
  model.tile.value = null;
}

/** The tool in hand with all that it needs. */
function handOf(model: CarpetModel): Hand {
  return {
    tool: model.tool.peek(),
    ...model.drawing(),
    mirror: model.mirror.peek(),
    borderWidth: model.borderWidth.peek(),
    tile: model.tile.peek(),
  };
}
