/** A four-bar as lines on the screen, at a phase of its motion. */
import type { ShownFourBar, ShownMotion } from "../../api/messages";
import { type At, type Camera, toScreen } from "./camera";

export interface Pins {
  a0: At;
  b0: At;
  a: At;
  b: At;
  p: At | null;
}

const at = (row: readonly number[], index: number): At => ({ x: row[2 * index] ?? 0, y: row[2 * index + 1] ?? 0 });

/** Number of positions of a motion. */
export function lengthOf(motion: ShownMotion): number {
  return motion.a.length / 2;
}

/** Position in a motion at a phase from 0 to 1: a closed one goes round, another one there and back. */
export function indexAt(motion: ShownMotion, phase: number): number {
  const count = lengthOf(motion);
  if (motion.closed) return (phase % 1) * count;
  const share = phase % 1;
  return (share < 0.5 ? 2 * share : 2 - 2 * share) * (count - 1);
}

function between(row: readonly number[], index: number, closed: boolean): At {
  const count = row.length / 2;
  const low = Math.floor(index);
  const next = closed ? (low + 1) % count : Math.min(low + 1, count - 1);
  const share = index - low;
  const [one, other] = [at(row, low % count), at(row, next)];
  return { x: one.x + (other.x - one.x) * share, y: one.y + (other.y - one.y) * share };
}

/** The pins at a phase of the motion; as drawn where there is none. */
export function pinsAt(one: ShownFourBar, phase: number): Pins {
  const { motion } = one;
  const fixed = { a0: pin(one.pins, "a0"), b0: pin(one.pins, "b0") };
  if (lengthOf(motion) === 0) return { ...fixed, ...drawnPins(one.pins) };
  const index = indexAt(motion, phase);
  return {
    ...fixed,
    a: between(motion.a, index, motion.closed),
    b: between(motion.b, index, motion.closed),
    p: motion.p.length ? between(motion.p, index, motion.closed) : null,
  };
}

type PinTable = Record<string, readonly number[]>;

function pin(pins: PinTable, name: string): At {
  const [x = 0, y = 0] = pins[name] ?? [];
  return { x, y };
}

/** The moving pins as drawn at the first position. */
export function drawnPins(pins: PinTable): Pick<Pins, "a" | "b" | "p"> {
  return { a: pin(pins, "a"), b: pin(pins, "b"), p: pins["tracer"] ? pin(pins, "tracer") : null };
}

/** All pins as drawn. */
export function allPins(pins: PinTable): Pins {
  return { a0: pin(pins, "a0"), b0: pin(pins, "b0"), ...drawnPins(pins) };
}

const number = (value: number) => value.toFixed(1);

function line(camera: Camera, points: readonly At[], closed = false): string {
  const parts = points.map((one, index) => {
    const { x, y } = toScreen(camera, one);
    return `${index ? "L" : "M"}${number(x)} ${number(y)}`;
  });
  return parts.join("") + (closed ? "Z" : "");
}

/** Paths of crank, coupler and rocker. */
export function linkPaths(camera: Camera, pins: Pins): { crank: string; coupler: string; rocker: string } {
  const corners = pins.p === null ? [pins.a, pins.b] : [pins.a, pins.b, pins.p];
  return {
    crank: line(camera, [pins.a0, pins.a]),
    coupler: line(camera, corners, corners.length > 2),
    rocker: line(camera, [pins.b0, pins.b]),
  };
}

/** A row x, y, x, y, … as a path. */
export function rowPath(camera: Camera, row: readonly number[], closed = false): string {
  const points = Array.from({ length: row.length / 2 }, (_, index) => at(row, index));
  return line(camera, points, closed);
}

/** A ground pivot: a small triangle below a point. */
export function pivotPath(camera: Camera, pivot: At, size = 9): string {
  const { x, y } = toScreen(camera, pivot);
  const [left, right, low] = [x - size * 0.75, x + size * 0.75, y + size * 1.3];
  return `M${number(x)} ${number(y)}L${number(left)} ${number(low)}L${number(right)} ${number(low)}Z`;
}

/** Every point that a four-bar occupies in motion. */
export function reach(one: ShownFourBar): At[] {
  const rows = [one.motion.a, one.motion.b, one.motion.p, one.curve];
  const moving = rows.flatMap((row) => Array.from({ length: row.length / 2 }, (_, index) => at(row, index)));
  return [pin(one.pins, "a0"), pin(one.pins, "b0"), ...moving];
}
