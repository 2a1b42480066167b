/** What the tools of the drawing do with clicks: spots are collected in a draft until a part of the mechanism is whole. */
import { signal } from "@preact/signals";
import { t } from "../../text";
import { toast } from "../../ui";
import type { Editor, Tool } from "./editor";
import { bodiesAt, bodyDistance, type Figure, type Hit, hitAt } from "./figure";
import { direction, distance, gridStep, plus, type Snap, snap, times, toLocal, type Vec, vec } from "./geometry";
import {
  addBody,
  addForce,
  addGears,
  addMass,
  addPin,
  addPivot,
  addSlide,
  addTracer,
  attach,
  freePointName,
  GROUND,
  jointsOf,
  type Spot,
  setPoint,
  toggleDrive,
} from "./mechanism";

/** Spots so far, and where the pointer would put the next one. */
export interface Draft {
  readonly spots: readonly Spot[];
  readonly next: Snap | null;
}

const EMPTY: Draft = { spots: [], next: null };

/** Reach of the pointer on the screen [px]: a finger needs more. */
export const REACH = 12;
export const TOUCH_REACH = 24;

/** What was typed of the line to the next spot: its length [m] and direction [rad]. */
export interface TypedLine {
  readonly length: number | null;
  readonly angle: number | null;
}

const FREE: TypedLine = { length: null, angle: null };

/** Distance below which positions are the same [m]. */
const SAME = 1e-7;

export class Tools {
  readonly draft = signal<Draft>(EMPTY);
  readonly typed = signal<TypedLine>(FREE);

  /** Takes the last refusal away, once another spot is put. */
  #takeAway: () => void = () => undefined;

  constructor(readonly editor: Editor) {}

  /** Distance within which something is hit [m]. */
  reach(touch = false): number {
    return (touch ? TOUCH_REACH : REACH) / this.editor.camera.peek().scale;
  }

  choose(tool: Tool): void {
    this.editor.tool.value = tool;
    this.#forget();
  }

  /** Forgets the draft; without one the tool goes back to selecting. */
  cancel(): void {
    if (this.draft.peek().spots.length === 0) this.editor.tool.value = "select";
    this.#forget();
  }

  #forget(): void {
    this.draft.value = EMPTY;
    this.typed.value = FREE;
  }

  hit(at: Vec, touch = false): Hit {
    const figure = this.editor.figure.peek();
    return figure === null ? undefined : hitAt(figure, at, this.reach(touch));
  }

  /** Where a pointer would put a spot. */
  snapped(at: Vec, touch = false, besides?: string): Snap {
    const figure = this.editor.figure.peek();
    const grid = this.editor.shown.peek().grid ? gridStep(this.editor.camera.peek().scale) : 0;
    const points = figure === null ? [] : spotsOf(figure).filter((spot) => spot.name !== besides);
    const from = this.draft.peek().spots.at(-1)?.at;
    const { length, angle } = this.typed.peek();
    if (from && (length !== null || angle !== null)) {
      const held = onLine(from, at, length, angle);
      return snap(held, { grid: 0, reach: SAME, points });
    }
    return snap(at, { grid, reach: this.reach(touch), points, from });
  }

  /** Shows where the next spot would be. */
  hover(at: Vec, touch = false): void {
    if (this.editor.tool.peek() === "select") return;
    this.draft.value = { ...this.draft.peek(), next: this.snapped(at, touch) };
  }

  /** Puts a spot: a click, Enter, or typed coordinates. */
  put(at: Vec, touch = false): void {
    this.putSpot(this.spot(this.snapped(at, touch)), at, touch);
  }

  /** Puts a spot exactly where it was typed. */
  putAt(at: Vec): void {
    const near = this.snapped(at);
    this.putSpot(distance(near.at, at) < SAME ? this.spot(near) : { at }, at, false);
  }

  /** Puts a spot at the typed length and direction from the last one; what is not typed is as the pointer shows it. */
  putLine(): void {
    const { spots, next } = this.draft.peek();
    const from = spots.at(-1)?.at;
    const { length, angle } = this.typed.peek();
    if (from && (length !== null || angle !== null)) {
      this.putAt(onLine(from, next?.at ?? plus(from, vec(1, 0)), length, angle));
    }
  }

  private putSpot(spot: Spot, at: Vec, touch: boolean): void {
    this.#takeAway();
    const tool = this.editor.tool.peek();
    const spots = [...this.draft.peek().spots, spot];
    this.typed.value = FREE;
    const needed = { link: 2, body: 3, slide: 2, gears: 2 }[tool as string] ?? 1;
    if (!this.fits(tool, spot, spots.length)) return;
    if (spots.length < needed) {
      this.draft.value = { spots, next: null };
      return;
    }
    this.draft.value = EMPTY;
    this.finish(tool, spots, at, touch);
  }

  /** Whether a spot can be used; reports why not. */
  private fits(tool: Tool, spot: Spot, count: number): boolean {
    const onPin = spot.joint !== undefined || spot.point !== undefined;
    if ((tool === "gears" || tool === "drive") && spot.joint === undefined) return this.refuse("needsJoint");
    if ((tool === "force" || (tool === "slide" && count === 1)) && !onPin) return this.refuse("needsPoint");
    return true;
  }

  private refuse(why: "needsJoint" | "needsPoint" | "needsBodies" | "needsBody" | "needsGears"): false {
    this.#takeAway = toast(t(`linkage.${why}`), "warn");
    return false;
  }

  private finish(tool: Tool, spots: readonly Spot[], at: Vec, touch: boolean): void {
    const { editor } = this;
    const figure = editor.figure.peek();
    const poses = figure?.poses ?? {};
    const [first, last] = [spots[0] as Spot, spots.at(-1) as Spot];
    const under = figure === null ? [] : bodiesAt(figure, at, this.reach(touch));
    if (tool === "link" || tool === "body") {
      if (spots.some((spot, index) => spots.some((other, later) => later > index && same(spot, other)))) return;
      editor.edit((data) => editor.select({ bodies: [addBody(data, spots, poses)] }));
    } else if (tool === "pin") {
      if (under.length < 2) this.refuse("needsBodies");
      else editor.edit((data) => editor.select({ joints: [addPin(data, last.at, under, poses)] }));
    } else if (tool === "pivot") {
      editor.edit((data) => editor.select({ joints: [pivot(data, last, under, poses)] }));
    } else if (tool === "slide") {
      const guide = under.find((body) => body !== first.body && !joined(editor, first, body)) ?? GROUND;
      editor.edit((data) => {
        editor.select({ joints: [addSlide(data, first, guide, direction(first.at, last.at), poses)] });
      });
    } else if (tool === "gears") {
      let made: string | undefined;
      editor.edit((data) => {
        made = addGears(data, first.joint ?? "", last.joint ?? "", poses);
      });
      if (made === undefined) this.refuse("needsGears");
    } else if (tool === "drive") {
      editor.edit((data) => void toggleDrive(data, last.joint ?? ""));
      editor.select({ joints: [last.joint ?? ""] });
    } else this.finishPoint(tool, last, at, under);
  }

  private finishPoint(tool: Tool, spot: Spot, at: Vec, under: readonly string[]): void {
    const { editor } = this;
    const poses = editor.figure.peek()?.poses ?? {};
    const body = under[0] ?? this.#plane(at);
    if (tool === "force") {
      const members =
        spot.joint === undefined ? [] : editor.figure.peek()?.joints.find((one) => one.name === spot.joint);
      const names = Array.isArray(members) ? [] : (members?.bodies ?? []);
      const on = spot.body ?? names.find((name) => name !== GROUND);
      const point = spot.point ?? spot.joint;
      if (on !== undefined && point !== undefined) editor.edit((data) => void addForce(data, on, point));
    } else if (body === undefined) this.refuse("needsBody");
    else if (tool === "mass") {
      editor.edit((data) => addMass(data, body, spot.at, poses));
      editor.select({ bodies: [body] });
    } else if (tool === "point") {
      const where = spot.joint === undefined && spot.point === undefined ? spot.at : at;
      editor.edit((data) => editor.select({ points: [`${body}.${addTracer(data, body, where, poses)}`] }));
    }
  }

  /** The link in whose plane a position beside all links is: the chosen one, else the nearest. */
  #plane(at: Vec): string | undefined {
    const { bodies } = this.editor.selection.peek();
    const moving = (this.editor.figure.peek()?.bodies ?? []).filter((one) => one.name !== GROUND);
    const chosen = moving.find((one) => bodies.length === 1 && one.name === bodies[0]);
    const nearest = moving.sort((one, other) => bodyDistance(one, at) - bodyDistance(other, at))[0];
    return (chosen ?? nearest)?.name;
  }

  /** What lies where a pointer snapped to. */
  private spot(found: Snap): Spot {
    if (found.to !== "point" || found.name === undefined) return { at: found.at };
    const [kind = "", name = "", point = ""] = found.name.split("\n");
    return kind === "joint" ? { at: found.at, joint: name } : { at: found.at, body: name, point };
  }

  /** Joins a free point to what it was dropped on. */
  join(body: string, point: string, at: Vec): boolean {
    const near = this.snapped(at, false, spotName("point", body, point));
    const spot = this.spot(near);
    if (spot.joint === undefined && spot.point === undefined) return false;
    if (spot.body === body || (spot.joint !== undefined && jointsOf(this.editor.data, body).includes(spot.joint)))
      return false;
    const poses = this.editor.figure.peek()?.poses ?? {};
    this.editor.edit((data) => {
      delete data.bodies?.[body]?.points?.[point];
      attach(data, body, spot, poses);
    });
    return true;
  }
}

function pivot(
  data: Parameters<typeof addPivot>[0],
  spot: Spot,
  under: readonly string[],
  poses: Parameters<typeof addPivot>[2],
): string {
  const [body] = under;
  if (spot.joint === undefined && spot.point === undefined && body !== undefined) {
    return addPin(data, spot.at, [GROUND, body], poses);
  }
  if (spot.joint === undefined && spot.point === undefined) {
    const name = freePointName(data);
    setPoint(data, GROUND, name, toLocal({ x: 0, y: 0, angle: 0 }, spot.at));
    return name;
  }
  return addPivot(data, spot, poses);
}

/** The position of a typed length and direction from a start; what is not typed follows the pointer. */
function onLine(from: Vec, to: Vec, length: number | null, angle: number | null): Vec {
  const turn = Math.PI / 4;
  const free = direction(from, to);
  const nearest = Math.round(free / turn) * turn;
  const held = angle ?? (Math.abs(free - nearest) < 0.06 ? nearest : free);
  const along = length ?? Math.max((to.x - from.x) * Math.cos(held) + (to.y - from.y) * Math.sin(held), 0);
  return plus(from, times(vec(Math.cos(held), Math.sin(held)), along));
}

function same(a: Spot, b: Spot): boolean {
  return distance(a.at, b.at) < SAME;
}

function joined(editor: Editor, spot: Spot, body: string): boolean {
  return spot.joint !== undefined && jointsOf(editor.data, body).includes(spot.joint);
}

function spotName(kind: "joint" | "point", body: string, point = ""): string {
  return [kind, body, point].join("\n");
}

/** The points that attract: joints, and points that are none. */
function spotsOf(figure: Figure): { name: string; at: Vec }[] {
  return [
    ...figure.joints
      .filter((one) => one.kind === "pin")
      .map((one) => ({ name: spotName("joint", one.name), at: one.at })),
    ...figure.points
      .filter((point) => point.joint === undefined)
      .map((point) => ({ name: spotName("point", point.body, point.name), at: point.at })),
  ];
}
