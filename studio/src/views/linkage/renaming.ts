/** New names of bodies, joints and points, everywhere in a mechanism file. */
import { bodiesOf, type Entry, GROUND, type MechanismData, REFERRING, type Table } from "./mechanism";

/** Renames a body; false where the name is taken or none. */
export function renameBody(data: MechanismData, from: string, to: string): boolean {
  if (from === GROUND || !isFree(to, Object.keys(data.bodies ?? {}))) return false;
  data.bodies = rekeyed(data.bodies ?? {}, from, to);
  for (const key of ["joints", "inputs", ...REFERRING]) {
    if (data[key] !== undefined) data[key] = swapped(data[key], from, to);
  }
  for (const key of ["pose", "motions"]) rekey(data, key, from, to);
  return true;
}

/** Tables whose keys are joints. */
const BY_JOINT = ["joints", "inputs", "branches", "friction", "pins", "motions", "actuators"] as const;

/** Renames a joint, and its point in each of its bodies; false where the name is taken or none. */
export function renameJoint(data: MechanismData, from: string, to: string): boolean {
  const members = bodiesOf(data.joints?.[from]);
  const points = members.flatMap((body) => Object.keys(data.bodies?.[body]?.points ?? {}));
  if (!isFree(to, [...Object.keys(data.joints ?? {}), ...points])) return false;
  for (const body of members) renameIn(data, body, from, to);
  for (const key of BY_JOINT) rekey(data, key, from, to);
  for (const key of ["transmission", "servo"]) if (data[key] !== undefined) data[key] = swapped(data[key], from, to);
  return true;
}

/** Renames a point that is no joint; false where the name is taken or none. */
export function renamePoint(data: MechanismData, body: string, from: string, to: string): boolean {
  if (!isFree(to, [...Object.keys(data.bodies?.[body]?.points ?? {}), ...Object.keys(data.joints ?? {})])) return false;
  renameIn(data, body, from, to);
  return true;
}

function isFree(name: string, taken: readonly string[]): boolean {
  return /^[^\s.][^.]*$/.test(name) && !taken.includes(name);
}

/** A point's name in its body, and wherever [body, point] is named. */
function renameIn(data: MechanismData, body: string, from: string, to: string): void {
  const table = data.bodies?.[body];
  if (table?.points) table.points = rekeyed(relative(table.points, from, to), from, to);
  for (const key of ["between", "shapes"]) if (table?.[key] !== undefined) table[key] = swapped(table[key], from, to);
  if (table?.["centre"] === from) table["centre"] = to;
  for (const key of REFERRING) if (data[key] !== undefined) data[key] = pairs(data[key], body, from, to);
}

/** Points of a body of which some are given from others. */
function relative(points: Table, from: string, to: string): Table {
  const own = (entry: Entry): Entry =>
    entry !== null && typeof entry === "object" && "from" in entry
      ? { ...entry, from: swapped(entry.from, from, to) }
      : entry;
  return Object.fromEntries(Object.entries(points).map(([name, entry]) => [name, own(entry)]));
}

/** An entry in which pairs [body, from] are [body, to]. */
function pairs(entry: Entry, body: string, from: string, to: string): Entry {
  if (Array.isArray(entry) && entry.length === 2 && entry[0] === body && entry[1] === from) return [body, to];
  return mapped(entry, (inner) => pairs(inner, body, from, to));
}

/** An entry in which a text is another one. */
function swapped(entry: Entry, from: string, to: string): Entry {
  return entry === from ? to : mapped(entry, (inner) => swapped(inner, from, to));
}

function mapped(entry: Entry, change: (inner: Entry) => Entry): Entry {
  if (Array.isArray(entry)) return entry.map(change);
  if (entry === null || typeof entry !== "object") return entry;
  return Object.fromEntries(Object.entries(entry).map(([key, value]) => [key, change(value)]));
}

function rekey(data: MechanismData, key: string, from: string, to: string): void {
  const table = data[key];
  if (table !== null && typeof table === "object" && from in table) data[key] = rekeyed(table as Table, from, to);
}

function rekeyed<T>(table: Record<string, T>, from: string, to: string): Record<string, T> {
  return Object.fromEntries(Object.entries(table).map(([key, value]) => [key === from ? to : key, value]));
}
