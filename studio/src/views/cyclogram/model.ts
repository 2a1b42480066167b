/** A cyclogram as the plain data of its file, and the edits that a drag or a typed value makes in it. */
import type { ShownMotionPart, ShownTrack } from "../../api/messages";
import { quantityText } from "../../ui";

export type Quantity = string | number;

export interface MotionData {
  start: Quantity;
  end: Quantity;
  from: Quantity;
  to: Quantity;
  law: string | Record<string, unknown>;
}

export interface EventData {
  angle?: Quantity;
  on?: string;
  [key: string]: unknown;
}

export interface TrackData {
  unit?: string;
  held?: boolean;
  motions?: Record<string, MotionData>;
  events?: Record<string, EventData>;
  [key: string]: unknown;
}

/** Plain data of a cyclogram file. */
export interface CyclogramData {
  name?: string;
  period?: Quantity;
  tracks?: Record<string, TrackData>;
  relations?: Record<string, unknown>[];
  exclusions?: Record<string, unknown>[];
  [key: string]: unknown;
}

export const DEGREE = Math.PI / 180;
export const TURN = 2 * Math.PI;

/** Least angle of a motion [rad]. */
const SHORTEST = 0.5 * DEGREE;

/** What of a motion is dragged. */
export type Grip = "start" | "end" | "all";

export interface Span {
  start: number;
  end: number;
}

/** An angle rounded to half a degree, or finer [rad]. */
export function snap(angle: number, step = 0.5): number {
  return Math.round(angle / DEGREE / step) * step * DEGREE;
}

/** The room of a motion between its neighbours: the last may run on to where the first starts in the next turn. */
export function room(track: ShownTrack, name: string): Span {
  const index = track.motions.findIndex((one) => one.name === name);
  const [before, after] = [track.motions[index - 1], track.motions[index + 1]];
  const last = track.motions.at(-1);
  const first = track.motions[0];
  return {
    start: before?.end ?? Math.max(0, (last?.end ?? 0) - TURN),
    end: after?.start ?? TURN + (index === 0 ? 0 : (first?.start ?? 0)),
  };
}

/** A motion dragged by an angle [rad], within the room that its neighbours leave. */
export function dragged(track: ShownTrack, name: string, grip: Grip, by: number): Span | null {
  const part = track.motions.find((one) => one.name === name);
  if (part === undefined) return null;
  const { start: low, end: high } = room(track, name);
  if (grip === "start") return { start: between(snap(part.start + by), low, part.end - SHORTEST), end: part.end };
  if (grip === "end") return { start: part.start, end: between(snap(part.end + by), part.start + SHORTEST, high) };
  const beta = part.end - part.start;
  const start = between(snap(part.start + by), low, Math.min(high - beta, TURN - SHORTEST));
  return { start, end: start + beta };
}

function between(value: number, low: number, high: number): number {
  return Math.min(Math.max(value, low), Math.max(low, high));
}

/** The data with a motion at another time; events that follow it get their angle from it. */
export function withSpan(data: CyclogramData, track: string, motion: string, span: Span): CyclogramData {
  const next = withMotion(data, track, motion, {
    start: quantityText(span.start, "deg", 8),
    end: quantityText(span.end, "deg", 8),
  });
  const events = next.tracks?.[track]?.events;
  if (events === undefined) return next;
  const freed = Object.entries(events).map(([name, event]) => [
    name,
    event.on === motion ? withoutAngle(event) : event,
  ]);
  return withEntries(next, track, { events: Object.fromEntries(freed) as Record<string, EventData> });
}

function withoutAngle(event: EventData): EventData {
  const { angle: _, ...rest } = event;
  return rest;
}

/** The data with entries of a motion changed. */
export function withMotion(
  data: CyclogramData,
  track: string,
  motion: string,
  change: Partial<MotionData>,
): CyclogramData {
  const motions = data.tracks?.[track]?.motions;
  const part = motions?.[motion];
  if (part === undefined) return data;
  return withEntries(data, track, { motions: { ...motions, [motion]: { ...part, ...change } } });
}

/** The data with entries of a track changed; undefined leaves an entry out. */
export function withEntries(data: CyclogramData, track: string, change: Record<string, unknown>): CyclogramData {
  const own = data.tracks?.[track];
  return own === undefined ? data : { ...data, tracks: { ...data.tracks, [track]: without({ ...own, ...change }) } };
}

/** A table without the entries that are undefined. */
export function without<T extends object>(table: T): T {
  return Object.fromEntries(Object.entries(table).filter(([, value]) => value !== undefined)) as T;
}

/** A position as a file holds it. */
export function positionText(si: number, unit: string): Quantity {
  return unit === "" ? Number(si.toPrecision(6)) : quantityText(si, unit);
}

/** A round step of the levels of a track: about a hundredth of its stroke [SI]. */
export function levelStep(track: ShownTrack): number {
  const stroke = Math.max(track.high - track.low, 1e-6) * track.factor;
  return 10 ** Math.floor(Math.log10(stroke / 50)) / track.factor;
}

/** The data with the level after a motion changed: its end, and the begin of the next one, where they join. */
export function withLevel(data: CyclogramData, track: ShownTrack, motion: string, level: number): CyclogramData {
  const index = track.motions.findIndex((one) => one.name === motion);
  const own = track.motions[index];
  const next = track.motions[(index + 1) % track.motions.length];
  if (own === undefined || next === undefined) return data;
  const text = positionText(level, track.shown_unit);
  const made = withMotion(data, track.name, motion, { to: text });
  return joins(own, next) ? withMotion(made, track.name, next.name, { from: text }) : made;
}

function joins(one: ShownMotionPart, next: ShownMotionPart): boolean {
  return Math.abs(one.finish - next.begin) < 1e-9;
}

/** The data with another begin of a motion, and the level before it with it. */
export function withBegin(data: CyclogramData, track: ShownTrack, motion: string, level: number): CyclogramData {
  const index = track.motions.findIndex((one) => one.name === motion);
  const before = track.motions.at(index - 1);
  const own = track.motions[index];
  if (before !== undefined && own !== undefined && joins(before, own))
    return withLevel(data, track, before.name, level);
  return withMotion(data, track.name, motion, { from: positionText(level, track.shown_unit) });
}

/** Name of the law of a motion in the file. */
export function lawName(law: MotionData["law"] | undefined): string {
  return typeof law === "string" ? law : String(law?.["name"] ?? "");
}
