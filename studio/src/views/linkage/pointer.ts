/** Pointer, wheel and keys of the canvas: drag of joints and points, pan, pinch, selection by a frame. */
import { signal } from "@preact/signals";
import type { Editor } from "./editor";
import { extent, type Figure } from "./figure";
import {
  fitted,
  fromScreen,
  gridStep,
  minus,
  plus,
  type Size,
  STILL,
  tidy,
  times,
  toLocal,
  toScreen,
  type Vec,
  vec,
  zoomed,
} from "./geometry";
import { removeAll, removePoint } from "./mechanism";
import type { Tools } from "./tools";

/** Movement from which a press is a drag [px]. */
const SLOP = 3;

type Press =
  | { kind: "joint"; name: string; begun: boolean }
  | { kind: "point"; body: string; name: string; begun: boolean }
  /** grip: where it is held, in its own frame; bodies: those that move as a whole; several: were chosen before. */
  | { kind: "body"; name: string; grip: Vec; bodies: readonly string[]; several: boolean; begun: boolean }
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
  /** Whether the user has pointed at the drawing, which must stay where it is from then on. */
  hasPointed = false;
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
    this.hasPointed = true;
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
      const at = this.world(screen);
      const hit = tools.hit(at, touch);
      if (hit?.kind === "joint") this.#press = { kind: "joint", name: hit.name, begun: false };
      else if (hit?.kind === "point") this.#press = { kind: "point", body: hit.body, name: hit.name, begun: false };
      else this.#press = shift ? { kind: "frame", begun: false } : pan;
      if (hit?.kind === "body") this.#grip(hit.name, at, shift);
      else this.#choose(hit, shift);
    }
  }

  /** Takes hold of a body; several that are chosen stay so until it is clear that they are not moved. */
  #grip(name: string, at: Vec, more: boolean): void {
    const { editor } = this;
    const { bodies } = editor.selection.peek();
    const several = !more && bodies.length > 1 && bodies.includes(name);
    if (!several) this.#choose({ kind: "body", name }, more);
    const grip = toLocal(editor.figure.peek()?.poses[name] ?? STILL, at);
    this.#press = { kind: "body", name, grip, bodies: editor.movable(name), several, begun: false };
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
    this.#drag(press, screen, touch);
  }

  #drag(press: Press, screen: Vec, touch: boolean): void {
    const { editor, tools } = this;
    if (press.kind === "joint") editor.drag(tools.snapped(this.world(screen), touch, jointSpot(press.name)).at);
    else if (press.kind === "tool") tools.hover(this.world(screen), touch);
    else if (press.kind === "pan") {
      const { scale } = editor.camera.peek();
      const by = times(minus(screen, this.#from), 1 / scale);
      editor.camera.value = { scale, centre: plus(press.camera, vec(-by.x, by.y)) };
    } else if (press.kind === "frame") this.frame.value = { from: this.world(this.#from), to: this.world(screen) };
    else if (press.kind === "point")
      this.tools.draft.value = { spots: [], next: tools.snapped(this.world(screen), touch) };
    else if (press.bodies.length > 0) editor.shift.value = { bodies: press.bodies, by: this.#shift(screen) };
    else {
      editor.isPlaying.value = false;
      editor.turnTowards(press.name, press.grip, this.world(screen));
    }
  }

  /** How far the pointer went since it was pressed, in steps of the grid where that is shown. */
  #shift(screen: Vec): Vec {
    const { camera, shown } = this.editor;
    const by = minus(this.world(screen), this.world(this.#from));
    const grid = gridStep(camera.peek().scale);
    return shown.peek().grid ? vec(tidy(by.x, grid), tidy(by.y, grid)) : by;
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
    else if (press.kind === "body" && press.begun) this.#endShift();
    else if (press.kind === "body" && press.several) editor.select({ bodies: [press.name] });
  }

  #endShift(): void {
    const shift = this.editor.shift.peek();
    this.editor.shift.value = null;
    if (shift !== null) this.editor.moveBodies(shift.bodies, shift.by);
  }

  /** A joint has the focus of the keys: it is chosen, or the cross of a tool goes to it. */
  focusJoint(name: string, at: Vec): void {
    if (this.#fingers.size > 0) return;
    if (this.editor.tool.peek() === "select") {
      this.editor.select({ joints: [name] });
      return;
    }
    this.cross.value = at;
    this.tools.hover(at);
  }

  /** Gives up what the pointer does. */
  #drop(): void {
    if (this.#press?.kind === "joint" && this.#press.begun) this.editor.cancelDrag();
    this.#press = null;
    this.frame.value = null;
    this.editor.shift.value = null;
  }

  /** Shows everything. */
  fit(): void {
    const { answer, figure, camera } = this.editor;
    const [found, drawn] = [answer.peek(), figure.peek()];
    if (found && drawn) camera.value = fitted(extent(found, drawn), this.size);
  }

  wheel(screen: Vec, by: number): void {
    this.hasPointed = true;
    const { camera } = this.editor;
    camera.value = zoomed(camera.peek(), this.size, Math.exp(-by * 0.0015), screen);
  }

  zoom(by: number): void {
    this.hasPointed = true;
    const { camera } = this.editor;
    camera.value = zoomed(camera.peek(), this.size, by, vec(this.size.width / 2, this.size.height / 2));
  }

  #pinch(id: number, before: Vec, now: Vec): void {
    const other = [...this.#fingers].find(([finger]) => finger !== id)?.[1];
    if (other === undefined) return;
    const by =
      Math.hypot(now.x - other.x, now.y - other.y) / Math.max(Math.hypot(before.x - other.x, before.y - other.y), 1);
    const { camera } = this.editor;
    const { scale, centre } = zoomed(camera.peek(), this.size, by, times(plus(now, other), 0.5));
    const went = times(minus(now, before), 0.5 / scale);
    camera.value = { scale, centre: plus(centre, vec(-went.x, went.y)) };
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
    if (key === "Home") this.fit();
    else if (key === "Escape") {
      if (this.#press?.begun) this.#drop();
      else if (editor.tool.peek() !== "select") tools.cancel();
      else editor.select({});
      this.cross.value = null;
    } else if (key === "Delete" || key === "Backspace") return deleteSelection(editor);
    else if (key === "+" || key === "=") this.zoom(1.25);
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
    const { bodies, joints, points } = editor.selection.peek();
    const figure = editor.figure.peek();
    const moved = bodies[0] === undefined ? [] : editor.movable(bodies[0]);
    const joint = figure?.joints.find((one) => one.name === joints[0]);
    const point = figure?.points.find((one) => `${one.body}.${one.name}` === points[0]);
    if (moved.length > 0) editor.moveBodies(moved, by);
    else if (joint) editor.moveJoint(joint.name, plus(joint.at, by));
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
