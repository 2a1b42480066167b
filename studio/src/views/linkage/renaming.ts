/** New names of bodies, joints and points, everywhere in a mechanism file: where one is named, the declaration says. */
import { FILE, withNames } from "./declaration";
import { bodiesOf, GROUND, type MechanismData } from "./mechanism";

/** Renames a body; false where the name is taken or none. */
export function renameBody(data: MechanismData, from: string, to: string): boolean {
  if (from === GROUND || !isFree(to, Object.keys(data.bodies ?? {}))) return false;
  return rename(data, from, to, (kind) => kind === "body" || kind === "input");
}

/** Renames a joint, and its point in each of its bodies; false where the name is taken or none. */
export function renameJoint(data: MechanismData, from: string, to: string): boolean {
  const members = bodiesOf(data.joints?.[from]);
  const points = members.flatMap((body) => Object.keys(data.bodies?.[body]?.points ?? {}));
  if (!isFree(to, [...Object.keys(data.joints ?? {}), ...points])) return false;
  const isJoint = (kind: string, body = "") =>
    kind === "joint" || kind === "input" || (kind === "point" && members.includes(body));
  return rename(data, from, to, isJoint);
}

/** Renames a point that is no joint; false where the name is taken or none. */
export function renamePoint(data: MechanismData, body: string, from: string, to: string): boolean {
  if (!isFree(to, [...Object.keys(data.bodies?.[body]?.points ?? {}), ...Object.keys(data.joints ?? {})])) return false;
  return rename(data, from, to, (kind, of) => kind === "point" && of === body);
}

function isFree(name: string, taken: readonly string[]): boolean {
  return /^[^\s.][^.]*$/.test(name) && !taken.includes(name);
}

function rename(
  data: MechanismData,
  from: string,
  to: string,
  isMeant: (kind: string, body?: string) => boolean,
): true {
  const change = (kind: string, name: string, body?: string) => (name === from && isMeant(kind, body) ? to : name);
  Object.assign(data, withNames(data, FILE, change));
  return true;
}
