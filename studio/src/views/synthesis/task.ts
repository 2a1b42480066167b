/** The task of a synthesis as its file states it: lists of points, poses, pairs and corners, read and written. */
import { quantityText, readQuantity } from "../../ui";

export type Machine = "motion-four-bar" | "path-four-bar" | "function-four-bar";

export const MACHINES: readonly Machine[] = ["path-four-bar", "motion-four-bar", "function-four-bar"];

/** A value of a setting, as TOML holds it. */
export type SettingValue = string | number | boolean;

export type Settings = Record<string, SettingValue>;

/** Plain data of a synthesis file. */
export interface SynthesisData {
  machine?: string;
  settings?: Settings;
  [key: string]: unknown;
}

/** A point [m] with the angle of the body [rad] where it is a pose; of a function x and y as plain numbers. */
export interface TaskPoint {
  x: number;
  y: number;
  angle?: number;
}

/** Which setting holds the points, the units of a point's numbers, and how many are searched. */
export interface PointList {
  setting: "points" | "poses" | "samples";
  units: readonly string[];
  least: number;
  most: number;
}

export const LISTS: Record<Machine, PointList> = {
  "path-four-bar": { setting: "points", units: ["mm", "mm"], least: 4, most: 200 },
  "motion-four-bar": { setting: "poses", units: ["mm", "mm", "deg"], least: 3, most: 5 },
  "function-four-bar": { setting: "samples", units: ["", ""], least: 2, most: 60 },
};

/** Poses and points that a machine takes where its file states none. */
export const DEFAULTS: Record<Machine, string> = {
  "path-four-bar": "(20mm,20mm) (20mm,25mm) (20mm,30mm) (20mm,35mm) (20mm,40mm) (20mm,45mm)",
  "motion-four-bar": "(0mm,0mm,10deg) (25mm,15mm,3deg) (30mm,1mm,-25deg)",
  "function-four-bar": "",
};

export function isMachine(name: unknown): name is Machine {
  return MACHINES.some((one) => one === name);
}

/** The numbers [SI] of a list such as "(20mm,5mm) (1cm,0)"; null where it is none. */
export function readList(text: string, units: readonly string[]): number[][] | null {
  const rows: number[][] = [];
  const left = text.replace(/\(([^()]*)\)/g, (_, inner: string) => {
    rows.push(rowOf(inner, units));
    return " ";
  });
  if (left.replace(/[\s,;]/g, "") !== "") return null;
  return rows.every((row) => row.length === units.length && row.every(Number.isFinite)) ? rows : null;
}

function rowOf(text: string, units: readonly string[]): number[] {
  const items = text.split(/[,;]/).map((item) => item.trim());
  return items.map((item, at) => {
    const unit = units[at];
    if (unit === undefined) return Number.NaN;
    const read = readQuantity(item, unit);
    return "si" in read ? read.si : Number.NaN;
  });
}

/** A list as files hold it: "(20mm,5mm) (10mm,0mm)". */
export function writeList(rows: readonly (readonly number[])[], units: readonly string[]): string {
  return rows.map((row) => `(${row.map((value, at) => quantityText(value, units[at] ?? "")).join(",")})`).join(" ");
}

/** The points of a task; null where the text cannot be read, [] where a function is given by its name. */
export function pointsOf(data: SynthesisData): TaskPoint[] | null {
  if (!isMachine(data.machine)) return null;
  const list = LISTS[data.machine];
  const text = data.settings?.[list.setting] ?? DEFAULTS[data.machine];
  const rows = typeof text === "string" ? readList(text, list.units) : null;
  return rows?.map(([x = 0, y = 0, angle]) => (angle === undefined ? { x, y } : { x, y, angle })) ?? null;
}

/** How many points are missing before a search can begin; three that are met exactly are enough for a path. */
export function missingPoints(data: SynthesisData): number {
  if (!isMachine(data.machine)) return 0;
  const { least } = LISTS[data.machine];
  const points = pointsOf(data)?.length ?? least;
  if (data.machine === "function-four-bar" && points === 0) return 0;
  return Math.max(0, (isOn(data.settings?.["exact"]) ? 3 : least) - points);
}

/** Whether a point may be removed: of a function two have to stay, others are clicked anew. */
export function isRemovable(machine: Machine, count: number): boolean {
  return machine !== "function-four-bar" || count > LISTS[machine].least;
}

/** The data with other points; those of a function are sorted by x. */
export function withPoints(data: SynthesisData, points: readonly TaskPoint[]): SynthesisData {
  if (!isMachine(data.machine)) return data;
  const list = LISTS[data.machine];
  const ordered = data.machine === "function-four-bar" ? [...points].sort((a, b) => a.x - b.x) : points;
  const rows = ordered.map((point) => [point.x, point.y, ...(list.units.length > 2 ? [point.angle ?? 0] : [])]);
  return withSetting(data, list.setting, writeList(rows, list.units));
}

/** The data with one setting changed; undefined leaves it out. */
export function withSetting(data: SynthesisData, name: string, value: SettingValue | undefined): SynthesisData {
  const settings = { ...data.settings };
  if (value === undefined) delete settings[name];
  else settings[name] = value;
  return { ...data, settings };
}

/** A region of the plane: a rectangle by its bounds, or the corners of a polygon [m]. */
export type Region = readonly { x: number; y: number }[];

/** The corners of a region as it is written: two opposite corners are a rectangle; null where it cannot be read. */
export function readRegion(text: SettingValue | undefined): Region | null {
  const rows = typeof text === "string" ? readList(text, ["mm", "mm"]) : null;
  if (rows === null || rows.length < 2) return null;
  const corners = rows.map(([x = 0, y = 0]) => ({ x, y }));
  const [first, last] = [corners[0], corners[1]];
  if (corners.length > 2 || first === undefined || last === undefined) return corners;
  return rectangle(first, last);
}

export function rectangle(one: { x: number; y: number }, other: { x: number; y: number }): Region {
  const [left, right] = [Math.min(one.x, other.x), Math.max(one.x, other.x)];
  const [low, high] = [Math.min(one.y, other.y), Math.max(one.y, other.y)];
  return [
    { x: left, y: low },
    { x: right, y: low },
    { x: right, y: high },
    { x: left, y: high },
  ];
}

/** A region as files hold it; a rectangle by two corners. */
export function writeRegion(region: Region): string {
  const [a, b, c, d] = region;
  const upright = region.length === 4 && a && b && c && d && a.y === b.y && b.x === c.x && c.y === d.y && d.x === a.x;
  const corners = upright && a && c ? [a, c] : region;
  return writeList(
    corners.map((corner) => [corner.x, corner.y]),
    ["mm", "mm"],
  );
}

/** Bounds such as "10mm..60mm" or "..60mm" [SI]; infinite where a side is open; null where they cannot be read. */
export function readBounds(text: SettingValue | undefined, unit: string): [number, number] | null {
  if (typeof text !== "string" || text.trim() === "") return null;
  const [low = "", high, more] = text.split("..").map((part) => part.trim());
  if (more !== undefined) return null;
  const value = (part: string, open: number) => {
    if (part === "") return open;
    const read = readQuantity(part, unit);
    return "si" in read ? read.si : Number.NaN;
  };
  const found: [number, number] =
    high === undefined
      ? [value(low, Number.NaN), value(low, Number.NaN)]
      : [value(low, Number.NEGATIVE_INFINITY), value(high, Number.POSITIVE_INFINITY)];
  return found.some(Number.isNaN) ? null : found;
}

/** Bounds as files hold them. */
export function writeBounds([low, high]: readonly [number, number], unit: string): string {
  const side = (value: number) => (Number.isFinite(value) ? quantityText(value, unit) : "");
  return `${side(low)}..${side(high)}`;
}

/** Whether a setting is on: true, or "yes" and its kin. */
export function isOn(value: SettingValue | undefined): boolean {
  return value === true || ["yes", "true", "on"].includes(String(value).toLowerCase());
}
