/** What a cyclogram consists of: tracks, motions, events and rules added, removed and renamed, references with them. */
import type { ShownTrack } from "../../api/messages";
import { fromSi, quantityText } from "../../ui";
import {
  type CyclogramData,
  DEGREE,
  type EventData,
  type MotionData,
  snap,
  type TrackData,
  TURN,
  withEntries,
} from "./model";

/** An instant: of a motion, an event, a passage, or a fixed angle. */
export interface MomentData {
  track?: string;
  starts?: string;
  ends?: string;
  event?: string;
  past?: string;
  at?: string | number;
  angle?: string | number;
}

export interface RelationData {
  then: MomentData;
  first: MomentData;
  gap?: string | number;
  most?: string | number;
  turns?: number;
  delay?: string | number;
  why?: string;
}

/** A track in a zone of its positions, or fixed windows of the master angle. */
export interface PresenceData {
  track?: string;
  above?: string | number;
  below?: string | number;
  name?: string;
  windows?: (string | number)[][];
}

export interface ExclusionData {
  first: PresenceData;
  second: PresenceData;
  gap?: string | number;
  why?: string;
}

export type Edge = "starts" | "ends" | "event" | "past";
export const EDGES: readonly Edge[] = ["starts", "ends", "event", "past"];

/** A cyclogram to begin with: two tracks would be needed for a rule, one motion and its return for a track. */
export const NEW_CYCLOGRAM = `period = "1s"

[tracks."track 1".motions]
out = { start = "30deg", end = "120deg", from = "0mm", to = "50mm", law = "modified-sine" }
back = { start = "210deg", end = "300deg", from = "50mm", to = "0mm", law = "modified-sine" }
`;

/** The key of the later instant in the file: written out, it would look like a promise. */
const THEN = "then";

/** A relation with other instants. */
export function withSides(one: RelationData, first: MomentData, later: MomentData): RelationData {
  return { ...one, first, [THEN]: later };
}

export function relationsOf(data: CyclogramData): RelationData[] {
  return (data.relations ?? []) as unknown as RelationData[];
}

export function exclusionsOf(data: CyclogramData): ExclusionData[] {
  return (data.exclusions ?? []) as unknown as ExclusionData[];
}

/** The data with other rules; an empty list is left out. */
export function withRules(
  data: CyclogramData,
  relations: readonly RelationData[],
  exclusions: readonly ExclusionData[],
): CyclogramData {
  const { relations: _, exclusions: __, ...rest } = data;
  const made: CyclogramData = rest;
  if (relations.length) made.relations = relations as never;
  if (exclusions.length) made.exclusions = exclusions as never;
  return made;
}

/** The first of "NAME 1", "NAME 2", … that is not taken. */
export function freeName(stem: string, taken: readonly string[]): string {
  let number = 1;
  while (taken.includes(`${stem} ${number}`)) number += 1;
  return `${stem} ${number}`;
}

/** The data with a further track that stays at zero. */
export function withTrack(data: CyclogramData, name: string): CyclogramData {
  return { ...data, tracks: { ...data.tracks, [name]: { unit: "mm" } } };
}

/** The data without a track, and without the rules that name it. */
export function withoutTrack(data: CyclogramData, name: string): CyclogramData {
  const { [name]: _, ...tracks } = data.tracks ?? {};
  const names = (...sides: (MomentData | PresenceData)[]) => sides.some((side) => side.track === name);
  return withRules(
    { ...data, tracks },
    relationsOf(data).filter((one) => !names(one.first, one.then)),
    exclusionsOf(data).filter((one) => !names(one.first, one.second)),
  );
}

function renamedKeys<T>(table: Record<string, T> | undefined, from: string, to: string): Record<string, T> {
  return Object.fromEntries(Object.entries(table ?? {}).map(([key, value]) => [key === from ? to : key, value]));
}

/** The data with another name of a track, in its rules too. */
export function renamedTrack(data: CyclogramData, from: string, to: string): CyclogramData {
  const side = <T extends MomentData | PresenceData>(one: T): T => (one.track === from ? { ...one, track: to } : one);
  return withRules(
    { ...data, tracks: renamedKeys(data.tracks, from, to) },
    relationsOf(data).map((one) => withSides(one, side(one.first), side(one.then))),
    exclusionsOf(data).map((one) => ({ ...one, first: side(one.first), second: side(one.second) })),
  );
}

/** Whether an instant is one of a motion, or of one of its events. */
function isOf(moment: MomentData, track: string, motion: string, events: readonly string[]): boolean {
  if (moment.track !== track) return false;
  return [moment.starts, moment.ends, moment.past].includes(motion) || events.includes(moment.event ?? "");
}

/** The data without a motion, its events, and the relations that name them; the next motion begins where it did. */
export function withoutMotion(data: CyclogramData, track: ShownTrack, motion: string): CyclogramData {
  const own = data.tracks?.[track.name];
  const gone = own?.motions?.[motion];
  if (own === undefined || gone === undefined) return data;
  const index = track.motions.findIndex((one) => one.name === motion);
  const next = track.motions[(index + 1) % track.motions.length]?.name ?? motion;
  const { [motion]: _, ...motions } = own.motions ?? {};
  const follower = motions[next];
  if (follower !== undefined) motions[next] = { ...follower, from: gone.from };
  const lost = Object.entries(own.events ?? {}).flatMap(([name, event]) => (event.on === motion ? [name] : []));
  const events = Object.fromEntries(Object.entries(own.events ?? {}).filter(([name]) => !lost.includes(name)));
  return withRules(
    withEntries(data, track.name, { motions: filled(motions), events: filled(events) }),
    relationsOf(data).filter((one) => ![one.first, one.then].some((side) => isOf(side, track.name, motion, lost))),
    exclusionsOf(data),
  );
}

function filled<T extends object>(table: T): T | undefined {
  return Object.keys(table).length ? table : undefined;
}

/** The data with another name of a motion, in its events and relations too. */
export function renamedMotion(data: CyclogramData, track: string, from: string, to: string): CyclogramData {
  const own = data.tracks?.[track];
  const events = Object.entries(own?.events ?? {}).map(([name, event]): [string, EventData] => [
    name,
    event.on === from ? { ...event, on: to } : event,
  ]);
  const change: Partial<TrackData> = { motions: renamedKeys(own?.motions, from, to) };
  if (events.length) change.events = Object.fromEntries(events);
  return withMoments(withEntries(data, track, change), track, ["starts", "ends", "past"], from, to);
}

/** The data with another name of an event, in its relations too. */
export function renamedEvent(data: CyclogramData, track: string, from: string, to: string): CyclogramData {
  const events = renamedKeys(data.tracks?.[track]?.events, from, to);
  return withMoments(withEntries(data, track, { events }), track, ["event"], from, to);
}

function withMoments(
  data: CyclogramData,
  track: string,
  edges: readonly Edge[],
  from: string,
  to: string,
): CyclogramData {
  const side = (one: MomentData): MomentData => {
    const edge = edges.find((key) => one[key] === from);
    return one.track === track && edge !== undefined ? { ...one, [edge]: to } : one;
  };
  const relations = relationsOf(data).map((one) => withSides(one, side(one.first), side(one.then)));
  return withRules(data, relations, exclusionsOf(data));
}

/** The data without an event and the relations that name it. */
export function withoutEvent(data: CyclogramData, track: string, event: string): CyclogramData {
  const { [event]: _, ...events } = data.tracks?.[track]?.events ?? {};
  const names = (one: MomentData) => one.track === track && one.event === event;
  return withRules(
    withEntries(data, track, { events: filled(events) }),
    relationsOf(data).filter((one) => !names(one.first) && !names(one.then)),
    exclusionsOf(data),
  );
}

/** Least room in which a motion and its return are put [rad]. */
const LEAST_ROOM = 8 * DEGREE;

interface Gap {
  start: number;
  end: number;
  level: number;
}

/** The longest dwell of a track within the turn, and its level; null where there is no room for two motions. */
export function longestDwell(track: ShownTrack): Gap | null {
  const parts = track.motions;
  const last = parts.at(-1);
  const runsOver = Math.max(0, (last?.end ?? 0) - TURN);
  const gaps: Gap[] = [{ start: runsOver, end: parts[0]?.start ?? TURN, level: parts[0]?.begin ?? 0 }];
  parts.forEach((one, index) => {
    gaps.push({ start: one.end, end: parts[index + 1]?.start ?? TURN, level: one.finish });
  });
  const longest = gaps.reduce((best, one) => (one.end - one.start > best.end - best.start ? one : best));
  return longest.end - longest.start < LEAST_ROOM ? null : longest;
}

/** The data with a motion and its return in the longest dwell of a track. */
export function withStroke(data: CyclogramData, track: ShownTrack, laws: readonly string[]): CyclogramData {
  const gap = longestDwell(track);
  if (gap === null) return data;
  const names = track.motions.map((one) => one.name);
  const out = freeName("motion", names);
  const back = freeName("motion", [...names, out]);
  const at = (share: number) => snap(gap.start + share * (gap.end - gap.start));
  const stroke = track.high - track.low > 1e-9 ? track.high - track.low : 50 / fromSi(1, track.shown_unit);
  const law = laws.includes("modified-sine") ? "modified-sine" : (laws[0] ?? "");
  const position = (si: number) => quantityText(si, track.shown_unit);
  const motion = (start: number, end: number, from: number, to: number): MotionData => ({
    start: quantityText(at(start), "deg"),
    end: quantityText(at(end), "deg"),
    from: position(from),
    to: position(to),
    law,
  });
  return withEntries(data, track.name, {
    motions: {
      ...data.tracks?.[track.name]?.motions,
      [out]: motion(0.1, 0.4, gap.level, gap.level + stroke),
      [back]: motion(0.6, 0.9, gap.level + stroke, gap.level),
    },
  });
}

/** The first instant of a track that a rule can name; a fixed angle where it has none. */
export function firstMoment(name: string, track: TrackData | undefined): MomentData {
  const motion = Object.keys(track?.motions ?? {})[0];
  if (motion !== undefined) return { track: name, ends: motion };
  const event = Object.keys(track?.events ?? {})[0];
  return event === undefined ? { angle: "0deg" } : { track: name, event };
}

/** The data with a further relation: of the first tracks that move. */
export function withNewRelation(data: CyclogramData): CyclogramData {
  const names = Object.keys(data.tracks ?? {});
  const [one = "", other = one] = names;
  const first = firstMoment(one, data.tracks?.[one]);
  const own = data.tracks?.[other];
  const motion = Object.keys(own?.motions ?? {}).at(one === other ? -1 : 0);
  const later: MomentData = motion === undefined ? firstMoment(other, own) : { track: other, starts: motion };
  return withRules(data, [...relationsOf(data), { [THEN]: later, first, gap: "0deg" }], exclusionsOf(data));
}

/** The data with a further exclusion: the upper half of the first two tracks. */
export function withNewExclusion(data: CyclogramData, tracks: readonly ShownTrack[]): CyclogramData {
  const [one, other] = tracks;
  const upper = (track: ShownTrack): PresenceData => ({
    track: track.name,
    above: quantityText((track.low + track.high) / 2, track.shown_unit, 3),
  });
  if (one === undefined) return data;
  const second: PresenceData = other === undefined ? { name: "windows", windows: [["0deg", "30deg"]] } : upper(other);
  return withRules(data, relationsOf(data), [...exclusionsOf(data), { first: upper(one), second, gap: "0deg" }]);
}
