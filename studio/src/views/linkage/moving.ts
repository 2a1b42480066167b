/** Bodies moved as a whole, and sides of a body set to a length. */
import { readQuantity } from "../../ui";
import type { Figure } from "./figure";
import { distance, minus, plus, STILL, times, toLocal, type Vec, vec } from "./geometry";
import { bodiesOf, type Entry, GROUND, lengthEntry, type MechanismData, setPoint } from "./mechanism";

/** A side of a body: two of its points, and the distance between them. */
export interface Side {
  readonly from: string;
  readonly to: string;
  readonly length: number;
}

/** The sides of a body's points: of three or fewer all, of more those from each to the next. */
export function sidesOf(points: Readonly<Record<string, Vec>>): Side[] {
  const names = Object.keys(points);
  const pairs = names.flatMap((from, index) => names.slice(index + 1).map((to) => ({ from, to })));
  return pairs
    .filter(({ from, to }) => names.length <= 3 || names.indexOf(to) - names.indexOf(from) === 1)
    .map(({ from, to }) => ({ from, to, length: distance(points[from] as Vec, points[to] as Vec) }))
    .filter(({ length }) => length > 1e-9);
}

/** Where the second point of a side lies when the side has another length. */
export function endOfSide(points: Readonly<Record<string, Vec>>, side: Side, length: number): Vec {
  const [from, to] = [points[side.from] as Vec, points[side.to] as Vec];
  return plus(from, times(minus(to, from), length / side.length));
}

/** The moving bodies that are joined to a body, itself among them, and whether the ground is. */
export function connected(data: MechanismData, body: string): { bodies: string[]; grounded: boolean } {
  const found = new Set([body]);
  let grounded = false;
  for (const one of found) {
    for (const joint of Object.values(data.joints ?? {})) {
      const members = bodiesOf(joint);
      if (!members.includes(one)) continue;
      if (members.includes(GROUND)) grounded = true;
      for (const other of members) if (other !== GROUND) found.add(other);
    }
  }
  return { bodies: [...found], grounded };
}

/** Moves bodies in the world: their points, and their mass centres, that are given by coordinates in their own frames. */
export function shiftBodies(data: MechanismData, names: readonly string[], by: Vec, figure: Figure): void {
  for (const name of names) {
    const drawn = figure.bodies.find((one) => one.name === name);
    const table = data.bodies?.[name];
    if (!drawn || !table?.points || table.length !== undefined || table["shapes"] !== undefined) continue;
    const pose = figure.poses[name] ?? STILL;
    const own = turned(by, -pose.angle);
    for (const [point, entry] of Object.entries(table.points)) {
      const at = drawn.points.find((one) => one.name === point)?.at;
      if (Array.isArray(entry)) table.points = { ...table.points, [point]: shifted(data, entry, own) };
      else if (at && !isRelative(entry)) setPoint(data, name, point, toLocal(pose, plus(at, by)));
    }
    if (Array.isArray(table["centre"])) table["centre"] = shifted(data, table["centre"], own);
  }
}

function isRelative(entry: Entry): boolean {
  return entry !== null && typeof entry === "object" && ("from" in entry || "sides" in entry);
}

function shifted(data: MechanismData, [x, y]: readonly Entry[], by: Vec): [string | number, string | number] {
  return [shiftedLength(data, x, by.x), shiftedLength(data, y, by.y)];
}

function shiftedLength(data: MechanismData, entry: Entry, by: number): string | number {
  if (typeof entry === "number") return by === 0 ? entry : lengthEntry(data, entry + by);
  if (by === 0) return String(entry);
  const read = readQuantity(String(entry), "mm");
  return "si" in read ? lengthEntry(data, read.si + by) : `${entry} + ${lengthEntry(data, by)}`;
}

function turned(at: Vec, angle: number): Vec {
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  return vec(cos * at.x - sin * at.y, sin * at.x + cos * at.y);
}
