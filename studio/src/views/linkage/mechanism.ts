/** The plain data of a mechanism file, and the edits of the drawing: each a function of the data that it changes. */
import type { Body, Joint, MechanismFile } from "../../api/mechanism";
import { quantityText } from "../../ui";
import { FILE, hasName } from "./declaration";
import { type Pose, STILL, toLocal, type Vec } from "./geometry";

export type Entry = unknown;
export type Table = Record<string, Entry>;

/** The keys of all kinds of a table, each of which it may lack: a file may be unfinished. */
type Unfinished<T> = { [K in T extends unknown ? keyof T : never]?: T extends Record<K, infer V> ? V : Entry };

export type BodyTable = Omit<Body, "points"> & { points?: Record<string, Entry> };
export type JointTable = Unfinished<Joint> & { pin?: string[]; slide?: string[]; slot?: string[] };

/** A mechanism file. Keys that the editor does not draw are kept. */
export type MechanismData = Table &
  Pick<Partial<MechanismFile>, "name" | "inputs"> & {
    units?: string;
    bodies?: Record<string, BodyTable>;
    joints?: Record<string, JointTable>;
    branches?: Record<string, number>;
  };

export type Poses = Readonly<Record<string, Pose>>;

export const GROUND = "ground";

/** Bodies of a joint. */
export function bodiesOf(joint: JointTable | undefined): readonly string[] {
  return joint?.pin ?? joint?.slide ?? joint?.slot ?? [];
}

/** The joints of a body. */
export function jointsOf(data: MechanismData, body: string): string[] {
  return Object.entries(data.joints ?? {}).flatMap(([name, joint]) => (bodiesOf(joint).includes(body) ? [name] : []));
}

/** A length as it is written in the file: text with its unit, or SI where the file is. */
export function lengthEntry(data: MechanismData, value: number): string | number {
  const clean = Math.abs(value) < 1e-9 ? 0 : value;
  return data.units === "SI" ? clean : clean === 0 ? 0 : quantityText(clean, "mm", 7);
}

export function angleEntry(data: MechanismData, value: number): string | number {
  const clean = Math.abs(value) < 1e-9 ? 0 : value;
  return data.units === "SI" ? clean : clean === 0 ? 0 : quantityText(clean, "deg", 7);
}

export function pointEntry(data: MechanismData, at: Vec): [string | number, string | number] {
  return [lengthEntry(data, at.x), lengthEntry(data, at.y)];
}

/** A name that nothing of the file has yet: points and joints A, B, ... A1; bodies link1, link2. */
export function freeName(taken: ReadonlySet<string>, stem: string): string {
  for (let number = 1; ; number += 1) if (!taken.has(`${stem}${number}`)) return `${stem}${number}`;
}

export function freePointName(data: MechanismData): string {
  const taken = new Set([...Object.keys(data.joints ?? {}), ...allPointNames(data)]);
  for (const letter of "ABCDEFGHIJKLMNPQRSTUVWXYZ") if (!taken.has(letter)) return letter;
  return freeName(taken, "P");
}

function allPointNames(data: MechanismData): string[] {
  return Object.values(data.bodies ?? {}).flatMap((body) => Object.keys(body.points ?? {}));
}

export function freeBodyName(data: MechanismData, stem = "link"): string {
  return freeName(new Set(Object.keys(data.bodies ?? {})), stem);
}

function bodies(data: MechanismData): Record<string, BodyTable> {
  data.bodies ??= {};
  data.bodies[GROUND] ??= {};
  return data.bodies;
}

function joints(data: MechanismData): Record<string, JointTable> {
  data.joints ??= {};
  data.inputs ??= {};
  return data.joints;
}

/** Where the end of a new body lies: free, at a joint, or at a point of another body that becomes a joint. */
export interface Spot {
  readonly at: Vec;
  readonly joint?: string;
  readonly body?: string;
  readonly point?: string;
}

/** A new body through spots; it is joined to what lies there. Returns its name. */
export function addBody(data: MechanismData, spots: readonly Spot[], poses: Poses, stem = "link"): string {
  const name = freeBodyName(data, stem);
  bodies(data)[name] = { points: {} };
  for (const spot of spots) attach(data, name, spot, poses);
  return name;
}

/** Gives a body a point at a spot, joined to what lies there; returns the point's name. */
export function attach(data: MechanismData, body: string, spot: Spot, poses: Poses): string {
  const own = poses[body] ?? STILL;
  if (spot.joint !== undefined) {
    const joint = joints(data)[spot.joint];
    if (joint?.pin) {
      if (!joint.pin.includes(body)) {
        joint.pin.push(body);
        setPoint(data, body, spot.joint, toLocal(own, spot.at));
      }
      return spot.joint;
    }
  }
  if (spot.body !== undefined && spot.point !== undefined && spot.body !== body) {
    const name = pointForJoint(data, spot.body, spot.point);
    joints(data)[name] = { pin: [spot.body, body] };
    setPoint(data, body, name, toLocal(own, spot.at));
    return name;
  }
  const name = freePointName(data);
  setPoint(data, body, name, toLocal(own, spot.at));
  return name;
}

/** The name by which a point of a body can become a joint: its own, or a new one where that is taken. */
function pointForJoint(data: MechanismData, body: string, point: string): string {
  const others = Object.entries(bodies(data)).filter(([name]) => name !== body);
  const taken = joints(data)[point] !== undefined || others.some(([, table]) => point in (table.points ?? {}));
  if (!taken) return point;
  const name = freePointName(data);
  const points = bodies(data)[body]?.points;
  if (points) points[name] = points[point];
  return name;
}

/** Sets a point of a body by its coordinates. */
export function setPoint(data: MechanismData, body: string, point: string, local: Vec): void {
  const table = bodies(data)[body];
  if (table) table.points = { ...table.points, [point]: pointEntry(data, local) };
}

/** Pins a spot to the ground. */
export function addPivot(data: MechanismData, spot: Spot, poses: Poses): string {
  return attach(data, GROUND, spot, poses);
}

/** Joins several bodies by a pin at one position. */
export function addPin(data: MechanismData, at: Vec, members: readonly string[], poses: Poses): string {
  const name = freePointName(data);
  joints(data)[name] = { pin: [...members] };
  for (const body of members) setPoint(data, body, name, toLocal(poses[body] ?? STILL, at));
  return name;
}

/** A block that is pinned at a spot and slides along a line of a guide; returns the slide's name. */
export function addSlide(data: MechanismData, spot: Spot, guide: string, angle: number, poses: Poses): string {
  const block = freeBodyName(data, "block");
  bodies(data)[block] = {};
  if (spot.joint !== undefined && joints(data)[spot.joint]?.pin) {
    joints(data)[spot.joint]?.pin?.push(block);
  } else if (spot.body !== undefined && spot.point !== undefined) {
    const name = pointForJoint(data, spot.body, spot.point);
    joints(data)[name] = { pin: [spot.body, block] };
  }
  const slide = freeName(new Set(Object.keys(joints(data))), "slide");
  joints(data)[slide] = { slide: [block, guide], along: angleEntry(data, angle - (poses[guide]?.angle ?? 0)) };
  setPoint(data, guide, slide, toLocal(poses[guide] ?? STILL, spot.at));
  return slide;
}

/** A pair of gears about two pins with one carrier; returns its name, or undefined where the pins do not fit. */
export function addGears(data: MechanismData, first: string, second: string, poses: Poses): string | undefined {
  const [one, other] = [joints(data)[first]?.pin, joints(data)[second]?.pin];
  const carrier = one?.find((body) => other?.includes(body));
  const a = one?.find((body) => body !== carrier && body !== GROUND);
  const b = other?.find((body) => body !== carrier && body !== GROUND && body !== a);
  if (carrier === undefined || a === undefined || b === undefined) return undefined;
  const couplings = (data["couplings"] ?? {}) as Record<string, Table>;
  const name = freeName(new Set([...Object.keys(couplings), ...Object.keys(joints(data))]), "gears");
  const angle = (body: string) => (poses[body]?.angle ?? 0) - (poses[carrier]?.angle ?? 0);
  const entry: Table = { gears: [[a, first], [b, second]], ratio: -1 }; // biome-ignore format: a pair of pairs
  entry["first_at"] = angleEntry(data, angle(a));
  entry["second_at"] = angleEntry(data, angle(b));
  if (carrier !== GROUND) entry["carrier"] = carrier;
  data["couplings"] = { ...couplings, [name]: entry };
  return name;
}

/** Drives a joint, or no longer; returns the driven body, or undefined. */
export function toggleDrive(data: MechanismData, joint: string): string | undefined {
  const table = joints(data)[joint];
  const inputs = data.inputs ?? {};
  data.inputs = inputs;
  if (joint in inputs) {
    delete inputs[joint];
    return undefined;
  }
  const driven = new Set(Object.values(inputs));
  const body = table?.slide ? table.slide[0] : table?.pin?.find((one) => one !== GROUND && !driven.has(one));
  if (body !== undefined) inputs[joint] = body;
  return body;
}

/** A point whose path is traced; returns its name. */
export function addTracer(data: MechanismData, body: string, at: Vec, poses: Poses): string {
  const name = freePointName(data);
  const table = bodies(data)[body];
  if (table && body !== GROUND && !table.points && table.length === undefined) {
    const own = Object.fromEntries(jointsOf(data, body).map((joint) => [joint, [0, 0]]));
    table.points = own; // a block: its joints are at its origin
  }
  setPoint(data, body, name, toLocal(poses[body] ?? STILL, at));
  if (Array.isArray(data["paths"])) (data["paths"] as Entry[]).push([body, name]);
  return name;
}

/** A force at a point of a body; returns its name. */
export function addForce(data: MechanismData, body: string, point: string): string {
  const loads = (data["loads"] ?? {}) as Record<string, Table>;
  const name = freeName(new Set(Object.keys(loads)), "force");
  const force = data.units === "SI" ? 100 : "100N";
  const down = data.units === "SI" ? -Math.PI / 2 : "-90deg";
  data["loads"] = { ...loads, [name]: { force, direction: down, on: [body, point] } };
  return name;
}

/** Gives a force another size [N] and direction [rad]. */
export function setForce(data: MechanismData, name: string, size: number, turn: number): void {
  const load = (data["loads"] as Record<string, Table> | undefined)?.[name];
  if (load === undefined) return;
  load["force"] = data.units === "SI" ? Number(size.toPrecision(3)) : quantityText(size, "N", 3);
  load["direction"] = angleEntry(data, turn);
}

/** A mass of a body, with its centre at a position. */
export function addMass(data: MechanismData, body: string, at: Vec, poses: Poses): void {
  const table = bodies(data)[body];
  if (!table) return;
  table["mass"] = data.units === "SI" ? 1 : "1kg";
  table["centre"] = pointEntry(data, toLocal(poses[body] ?? STILL, at));
}

/** Removes bodies, joints and couplings, with everything that refers to them. */
export function removeAll(data: MechanismData, names: { bodies?: string[]; joints?: string[] }): void {
  const gone = new Set((names.bodies ?? []).filter((body) => body !== GROUND));
  const lost = new Set(names.joints ?? []);
  keepEnds(data, gone, lost);
  for (const body of gone) delete data.bodies?.[body];
  for (const [name, joint] of Object.entries(joints(data))) {
    const left = bodiesOf(joint).filter((body) => !gone.has(body));
    if (joint.pin && left.length >= 2 && !lost.has(name)) joint.pin = [...left];
    else if (left.length < bodiesOf(joint).length || lost.has(name)) {
      lost.add(name);
      delete data.joints?.[name];
    }
  }
  for (const key of Object.keys(data)) if (key !== "bodies" && key !== "joints") dropReferring(data, key, gone, lost);
  dropGroundPoints(data, lost);
}

/** Names the ends of links that are given by their length, where one of their joints goes. */
function keepEnds(data: MechanismData, gone: ReadonlySet<string>, lost: ReadonlySet<string>): void {
  const goes = (name: string) => {
    const members = bodiesOf(data.joints?.[name]);
    const left = members.filter((body) => !gone.has(body));
    return lost.has(name) || left.length < (data.joints?.[name]?.pin ? 2 : members.length);
  };
  for (const [body, table] of Object.entries(data.bodies ?? {})) {
    const [first, second] = jointsOf(data, body).filter((name) => table.points?.[name] === undefined);
    if (table.length === undefined || table.between !== undefined || first === undefined || second === undefined)
      continue;
    if (goes(first) || goes(second)) table.between = [first, second];
  }
}

/** Leaves out the entries of a table or list that name what is gone; of a coupling a wheel's middle is a joint. */
function dropReferring(data: MechanismData, key: string, gone: ReadonlySet<string>, lost: ReadonlySet<string>): void {
  const isGone = (kind: string, name: string, body?: string) =>
    kind === "body"
      ? gone.has(name)
      : kind === "point"
        ? lost.has(name) && (body === GROUND || key === "couplings")
        : lost.has(name) || (kind === "input" && gone.has(name));
  const [value, entry] = [data[key], FILE.properties?.[key] ?? {}];
  const drops = (one: Entry) => hasName(one, entry, isGone);
  if (!drops(value)) return;
  if (Array.isArray(value)) data[key] = value.filter((one) => !drops([one]));
  else if (value !== null && typeof value === "object") {
    data[key] = Object.fromEntries(Object.entries(value).filter(([name, one]) => !drops({ [name]: one })));
  } else delete data[key];
  if (key !== "inputs" && Object.keys((data[key] as Table | undefined) ?? {}).length === 0) delete data[key];
}

/** Points of the ground that belonged to joints that are gone. */
function dropGroundPoints(data: MechanismData, lost: ReadonlySet<string>): void {
  const points = data.bodies?.[GROUND]?.points;
  if (points) for (const name of lost) delete points[name];
}

/** Removes a point that is no joint. */
export function removePoint(data: MechanismData, body: string, point: string): void {
  const points = data.bodies?.[body]?.points;
  if (points && data.joints?.[point] === undefined) delete points[point];
}

/** Copies of bodies with the joints among them, in a new position; `place` maps world to world. Returns their names. */
export function copyBodies(
  data: MechanismData,
  chosen: readonly string[],
  corners: Readonly<Record<string, Readonly<Record<string, Vec>>>>,
  place: (at: Vec) => Vec,
): string[] {
  const renamed = new Map<string, string>();
  const names = new Map<string, string>();
  for (const body of chosen.filter((one) => one !== GROUND)) {
    const copy = freeBodyName(data, body.replace(/\d+$/, ""));
    bodies(data)[copy] = { ...structuredClone(omit(bodies(data)[body] ?? {}, ["points", "length", "between", "shapes", "centre"])), points: {} }; // biome-ignore format: one copy
    renamed.set(body, copy);
    for (const [point, at] of Object.entries(corners[body] ?? {})) {
      const joint = point.includes(".") ? point.slice(0, point.lastIndexOf(".")) : point;
      if (point !== joint && corners[body]?.[joint] !== undefined) continue;
      const name = names.get(joint) ?? freePointName(data);
      names.set(joint, name);
      setPoint(data, copy, name, place(at));
    }
  }
  for (const [name, joint] of Object.entries({ ...joints(data) })) {
    const members = bodiesOf(joint).map((body) => renamed.get(body));
    const copy = names.get(name);
    const kept = members.filter((body): body is string => body !== undefined);
    if (copy !== undefined && joint.pin && kept.length >= 2) joints(data)[copy] = { pin: kept };
  }
  return [...renamed.values()];
}

function omit(table: Table, keys: readonly string[]): Table {
  return Object.fromEntries(Object.entries(table).filter(([key]) => !keys.includes(key)));
}

/** Sets entries of the file: keys and value each. */
export function apply(data: MechanismData, changes: readonly { path: readonly string[]; value: Entry }[]): void {
  for (const { path, value } of changes) {
    let table: Table = data;
    for (const key of path.slice(0, -1)) {
      const inner = table[key];
      const next = inner !== null && typeof inner === "object" ? (inner as Table) : {};
      table[key] = next;
      table = next;
    }
    const last = path.at(-1);
    if (last !== undefined) table[last] = value;
  }
}

/** What an unfinished drawing needs next; null: nothing. */
export function nextStep(data: MechanismData, structure: { degrees_of_freedom: number; driven: number }) {
  const moving = Object.keys(data.bodies ?? {}).filter((body) => body !== GROUND);
  if (moving.length === 0) return "link";
  if (jointsOf(data, GROUND).length === 0) return "ground";
  if (moving.some((body) => jointsOf(data, body).length === 0)) return "join";
  const { degrees_of_freedom: count, driven } = structure;
  if (count < driven || count < 1) return "over";
  if (driven === 0) return "drive";
  return count > driven ? "under" : null;
}

/** An empty mechanism: the ground, ready to be drawn on. */
export function emptyMechanism(name: string): string {
  return `name = ${JSON.stringify(name)}\ninputs = {}\n\n[bodies]\nground = {}\n\n[joints]\n`;
}
