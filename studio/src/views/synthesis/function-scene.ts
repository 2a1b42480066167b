/** The function of a function generator on its plot: what is required and what a four-bar generates, as rows x, y. */
import type { ShownFourBar, SynthesisAnswer } from "../../api/messages";
import type { TaskPoint } from "./task";

const DEGREE = Math.PI / 180;

/** From a rotation of the rocker [rad] to the y that is drawn: that of the samples; without samples degrees. */
export function yOfRotation(answer: SynthesisAnswer, points: readonly TaskPoint[]): (rotation: number) => number {
  const [x, rotation] = [answer.required?.[0] ?? [], answer.required?.[1] ?? []];
  const swing = rotation.at(-1) ?? 1;
  if (points.length < 2) return (angle) => angle / DEGREE;
  const [first, last] = [valueAt(points, x[0] ?? 0), valueAt(points, x.at(-1) ?? 1)];
  return (angle) => first + ((last - first) * angle) / (swing || 1);
}

/** y of samples at x, by straight lines between them. */
export function valueAt(points: readonly TaskPoint[], x: number): number {
  const ordered = [...points].sort((a, b) => a.x - b.x);
  const next = ordered.findIndex((one) => one.x >= x);
  const [before, after] = [ordered[next - 1], ordered[next]];
  if (after === undefined) return ordered.at(-1)?.y ?? 0;
  if (before === undefined) return after.y;
  return before.y + ((after.y - before.y) * (x - before.x)) / (after.x - before.x || 1);
}

/** The required function as a row x, y, x, y, … */
export function requiredRow(answer: SynthesisAnswer, points: readonly TaskPoint[]): number[] {
  const y = yOfRotation(answer, points);
  const [xs, rotations] = [answer.required?.[0] ?? [], answer.required?.[1] ?? []];
  return xs.flatMap((x, index) => [x, y(rotations[index] ?? 0)]);
}

/** The function that a four-bar generates as a row. */
export function generatedRow(answer: SynthesisAnswer, one: ShownFourBar, points: readonly TaskPoint[]): number[] {
  const y = yOfRotation(answer, points);
  return (one.function?.x ?? []).flatMap((x, index) => [x, y(one.function?.generated[index] ?? 0)]);
}

/** Samples of the required function, to be dragged: x and the rotation in degrees. */
export function samplesOf(answer: SynthesisAnswer, count = 7): TaskPoint[] {
  const [xs, rotations] = [answer.required?.[0] ?? [], answer.required?.[1] ?? []];
  return Array.from({ length: count }, (_, index) => {
    const at = Math.round((index * (xs.length - 1)) / (count - 1));
    return { x: Number((xs[at] ?? 0).toPrecision(6)), y: Number(((rotations[at] ?? 0) / DEGREE).toPrecision(6)) };
  });
}
