/** Pointer, wheel and keys of the canvas: drag of joints and points, pan, pinch, selection by a frame. */
import { signal } from "@preact/signals";
import type { Editor } from "./editor";
import type { Figure } from "./figure";
import { fromScreen, gridStep, minus, plus, type Size, times, toScreen, type Vec, vec, zoomed } from "./geometry";
import { removeAll, removePoint } from "./mechanism";
import type { Tools } from "./tools";

/** Movement from which a press is a drag [px]. */
const SLOP = 3;

type Press =
  | { kind: "joint"; name: string; begun: boolean }
  | { kind: "point"; body: string; name: string; begun: boolean }
  | { kind: "pan"; camera: Vec; begun: boolean }
  | { kind: "frame"; begun: boolean }
  | { kind: "tool"; begun: boolean };

export interface Frame {
  readonly from: Vec;
  readonly to: Vec;
}

export class Pointer {
  readonly frame = signal<Frame | null>(null);
  /** Position of the keys' cross in the world; null while the pointer is used. */
  readonly cross = signal<Vec | null>(null);
  size: Size = { width: 600, height: 400 };
  #press: Press | null = null;
  #from: Vec = vec(0, 0);
  #fingers = new Map<number, Vec>();

  constructor(
    readonly editor: Editor,
    readonly tools: Tools,
  ) {}

  world(screen: Vec): Vec {
    return fromScreen(this.editor.camera.peek(), this.size, screen);
  }

  down(id: number, screen: Vec, touch: boolean, shift: boolean, button: number): void {
    this.cross.value = null;
    this.#fingers.set(id, screen);
    if (this.#fingers.size > 1) {
      this.#drop();
      return;
    }
    this.#from = screen;
    const { editor, tools } = this;
    const pan: Press = { kind: "pan", camera: editor.camera.peek().centre, begun: false };
    if (button === 1 || button === 2) this.#press = pan;
    else if (editor.tool.peek() !== "select") this.#press = { kind: "tool", begun: false };
    else {
      const hit = tools.hit(this.world(screen), touch);
      if (hit?.kind === "joint") this.#press = { kind: "joint", name: hit.name, begun: false };
      else if (hit?.kind === "point") this.#press = { kind: "point", body: hit.body, name: hit.name, begun: false };
      else this.#press = shift && hit === undefined ? { kind: "frame", begun: false } : pan;
      this.#choose(hit, shift);
    }
  }

  move(id: number, screen: Vec, touch: boolean): void {
    const before = this.#fingers.get(id);
    if (before !== undefined) this.#fingers.set(id, screen);
    if (this.#fingers.size === 2 && before !== undefined) {
      this.#pinch(id, before, screen);
      return;
    }
    const press = this.#press;
    if (press === null) {
      if (this.#fingers.size === 0) this.tools.hover(this.world(screen), touch);
      return;
    }
    if (!press.begun && Math.hypot(screen.x - this.#from.x, screen.y - this.#from.y) < SLOP) return;
    const { editor, tools } = this;
    if (!press.begun) {
      press.begun = true;
      if (press.kind === "joint") editor.beginDrag(press.name);
      if (press.kind === "tool") tools.put(this.world(this.#from), touch);
    }
    if (press.kind === "joint") editor.drag(tools.snapped(this.world(screen), touch, jointSpot(press.name)).at);
    else if (press.kind === "tool") tools.hover(this.world(screen), touch);
    else if (press.kind === "pan") {
      const { scale } = editor.camera.peek();
      const by = times(minus(screen, this.#from), 1 / scale);
      editor.camera.value = { scale, centre: plus(press.camera, vec(-by.x, by.y)) };
    } else if (press.kind === "frame") this.frame.value = { from: this.world(this.#from), to: this.world(screen) };
    else if (press.kind === "point")
      this.tools.draft.value = { spots: [], next: tools.snapped(this.world(screen), touch) };
  }

  up(id: number, screen: Vec, touch: boolean): void {
    this.#fingers.delete(id);
    const press = this.#press;
    this.#press = null;
    if (press === null) return;
    const { editor, tools } = this;
    const at = this.world(screen);
    if (press.kind === "joint" && press.begun) editor.endDrag();
    else if (press.kind === "point" && press.begun) {
      tools.draft.value = { spots: [], next: null };
      if (!tools.join(press.body, press.name, at)) {
        editor.movePoint(press.body, press.name, tools.snapped(at, touch, `point\n${press.body}\n${press.name}`).at);
      }
    } else if (press.kind === "tool") {
      const drawn = tools.draft.peek().spots.length;
      if (!press.begun || drawn > 0) tools.put(at, touch);
    } else if (press.kind === "frame") this.#chooseFrame();
  }

  /** Gives up what the pointer does. */
  #drop(): void {
    if (this.#press?.kind === "joint" && this.#press.begun) this.editor.cancelDrag();
    this.#press = null;
    this.frame.value = null;
  }

  wheel(screen: Vec, by: number): void {
    const { camera } = this.editor;
    camera.value = zoomed(camera.peek(), this.size, Math.exp(-by * 0.0015), screen);
  }

  zoom(by: number): void {
    const { camera } = this.editor;
    camera.value = zoomed(camera.peek(), this.size, by, vec(this.size.width / 2, this.size.height / 2));
  }

  #pinch(id: number, before: Vec, now: Vec): void {
    const other = [...this.#fingers].find(([finger]) => finger !== id)?.[1];
    if (other === undefined) return;
    const by =
      Math.hypot(now.x - other.x, now.y - other.y) / Math.max(Math.hypot(before.x - other.x, before.y - other.y), 1);
    const { camera } = this.editor;
    camera.value = zoomed(camera.peek(), this.size, by, times(plus(now, other), 0.5));
  }

  #choose(hit: ReturnType<Tools["hit"]>, more: boolean): void {
    const { editor } = this;
    const old = editor.selection.peek();
    const toggled = (list: readonly string[], name: string) =>
      list.includes(name) ? list.filter((one) => one !== name) : [...list, name];
    if (hit === undefined) {
      if (!more) editor.select({});
    } else if (hit.kind === "body") {
      if (more) editor.select({ ...old, bodies: toggled(old.bodies, hit.name) });
      else editor.select({ bodies: [hit.name] });
    } else if (hit.kind === "joint") {
      if (more) editor.select({ ...old, joints: toggled(old.joints, hit.name) });
      else editor.select({ joints: [hit.name] });
    } else {
      const name = `${hit.body}.${hit.name}`;
      if (more) editor.select({ ...old, points: toggled(old.points, name) });
      else editor.select({ points: [name] });
    }
  }

  #chooseFrame(): void {
    const frame = this.frame.peek();
    const figure = this.editor.figure.peek();
    this.frame.value = null;
    if (frame === null || figure === null) return;
    this.editor.select(inFrame(figure, frame));
  }

  /** Keys of the canvas; returns whether the key was used. */
  key(key: string, shift: boolean): boolean {
    const { editor, tools } = this;
    const step = STEPS[key];
    if (key === "Escape") {
      if (editor.isDragging.peek()) editor.cancelDrag();
      else if (editor.tool.peek() !== "select") tools.cancel();
      else editor.select({});
      this.cross.value = null;
      return true;
    }
    if (key === "Delete" || key === "Backspace") return deleteSelection(editor);
    if (key === "+" || key === "=") this.zoom(1.25);
    else if (key === "-") this.zoom(0.8);
    else if (editor.tool.peek() === "select") return step !== undefined && this.#nudge(step, shift);
    else if (step !== undefined) {
      const grid = gridStep(editor.camera.peek().scale) * (shift ? 10 : 1);
      const from = this.cross.peek() ?? editor.camera.peek().centre;
      const at = plus(from, times(step, grid));
      this.cross.value = this.cross.peek() === null ? tools.snapped(from).at : at;
      tools.hover(this.cross.value);
    } else if (key === "Enter" || key === " ") tools.put(this.cross.peek() ?? editor.camera.peek().centre);
    else return false;
    return true;
  }

  /** Moves what is chosen by a step of the grid, or the view. */
  #nudge(step: Vec, shift: boolean): boolean {
    const { editor } = this;
    const camera = editor.camera.peek();
    const by = times(step, gridStep(camera.scale) * (shift ? 10 : 1));
    const { joints, points } = editor.selection.peek();
    const figure = editor.figure.peek();
    const joint = figure?.joints.find((one) => one.name === joints[0]);
    const point = figure?.points.find((one) => `${one.body}.${one.name}` === points[0]);
    if (joint) editor.moveJoint(joint.name, plus(joint.at, by));
    else if (point) editor.movePoint(point.body, point.name, plus(point.at, by));
    else editor.camera.value = { ...camera, centre: plus(camera.centre, times(step, 40 / camera.scale)) };
    return true;
  }

  screen(at: Vec): Vec {
    return toScreen(this.editor.camera.peek(), this.size, at);
  }
}

const STEPS: Record<string, Vec | undefined> = {
  ArrowLeft: vec(-1, 0),
  ArrowRight: vec(1, 0),
  ArrowUp: vec(0, 1),
  ArrowDown: vec(0, -1),
};

function jointSpot(name: string): string {
  return `joint\n${name}\n`;
}

/** What lies whole in a frame. */
export function inFrame(figure: Figure, frame: Frame) {
  const [left, right] = [Math.min(frame.from.x, frame.to.x), Math.max(frame.from.x, frame.to.x)];
  const [low, high] = [Math.min(frame.from.y, frame.to.y), Math.max(frame.from.y, frame.to.y)];
  const inside = (at: Vec) => at.x >= left && at.x <= right && at.y >= low && at.y <= high;
  return {
    bodies: figure.bodies
      .filter((body) => body.name !== "ground" && body.outline.length > 0 && body.outline.every(inside))
      .map((body) => body.name),
    joints: figure.joints.filter((joint) => inside(joint.at)).map((joint) => joint.name),
    points: [],
  };
}

/** Removes what is chosen; returns whether something was. */
export function deleteSelection(editor: Editor): boolean {
  const { bodies, joints, points } = editor.selection.peek();
  if (bodies.length + joints.length + points.length === 0) return false;
  editor.edit((data) => {
    removeAll(data, { bodies: [...bodies], joints: [...joints] });
    for (const point of points) {
      const [body = "", name = ""] = point.split(".");
      removePoint(data, body, name);
    }
  });
  editor.select({});
  return true;
}
