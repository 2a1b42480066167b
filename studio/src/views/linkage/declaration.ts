/** The declaration of mechanism files, as the reader of the server has it: what each entry is, and whose name it holds. */
import schema from "../../api/mechanism.json";

/** An entry of the file in JSON Schema, with the keywords `unit`, `units` and `refers` of the server. */
export interface Declared {
  readonly $ref?: string;
  readonly description?: string;
  readonly type?: string | readonly string[];
  readonly unit?: string;
  readonly units?: readonly string[];
  readonly refers?: string;
  readonly enum?: readonly (string | number)[];
  readonly oneOf?: readonly Declared[];
  readonly items?: Declared;
  readonly required?: readonly string[];
  readonly properties?: Readonly<Record<string, Declared>>;
  readonly propertyNames?: { readonly refers: string };
  readonly additionalProperties?: Declared | false;
}

export const FILE = schema as unknown as Declared;
const DEFINITIONS = schema.$defs as unknown as Readonly<Record<string, Declared>>;

function isTable(value: unknown): value is Record<string, unknown> {
  return value !== null && typeof value === "object" && !Array.isArray(value);
}

/** An entry without its reference, and of a choice what fits a value. */
function resolved(entry: Declared, value: unknown): Declared {
  const { $ref, ...own } = entry;
  if ($ref !== undefined) return resolved({ ...DEFINITIONS[$ref.replace("#/$defs/", "")], ...own }, value);
  if (entry.oneOf === undefined) return entry;
  const options = entry.oneOf.map((option) => resolved(option, undefined));
  const fits = ({ type, required }: Declared) =>
    isTable(value)
      ? type === "object" && (required?.[0] ?? "") in value
      : type !== "object" && (type === "array") === Array.isArray(value);
  const { oneOf, ...rest } = entry;
  return value === undefined ? entry : { ...(options.find(fits) ?? {}), ...rest };
}

function inside(entry: Declared, key: string): Declared {
  return entry.items ?? entry.properties?.[key] ?? (entry.additionalProperties || {});
}

/** What the entry at some keys of the file is. */
export function entryAt(data: unknown, path: readonly string[]): Declared {
  let [entry, value] = [FILE, data];
  for (const key of path) {
    entry = inside(resolved(entry, value), key);
    value = (value as Record<string, unknown> | undefined)?.[key];
  }
  return resolved(entry, value);
}

/** A point of a body, as the file has it: "body.point". */
export function spotOf(body: string, point: string): string {
  return `${body}.${point}`;
}

/** The names of the body and of the point. */
export function namesOf(spot: string): [string, string] {
  const at = spot.indexOf(".");
  return [spot.slice(0, at), spot.slice(at + 1)];
}

/** What a name refers to: a body, joint, input, coupling, or a point of a body. */
type Change = (kind: string, name: string, body: string | undefined) => string;

/** A value of the file with other names in it. */
export function withNames(value: unknown, declared: Declared, change: Change, body?: string): unknown {
  const entry = resolved(declared, value);
  if (typeof value === "string" && entry.refers === "spot") {
    const [on, point] = namesOf(value);
    return spotOf(change("body", on, undefined), change("point", point, on));
  }
  if (typeof value === "string") return entry.refers === undefined ? value : change(entry.refers, value, body);
  if (Array.isArray(value)) return value.map((one) => withNames(one, entry.items ?? {}, change, body));
  if (!isTable(value)) return value;
  const keys = entry.propertyNames?.refers;
  const renamed = Object.entries(value).map(([key, one]) => [
    keys === undefined ? key : change(keys, key, body),
    withNames(one, inside(entry, key), change, keys === "body" ? key : body),
  ]);
  return Object.fromEntries(renamed);
}

/** Whether a value of the file has a name of which a test holds. */
export function hasName(value: unknown, declared: Declared, test: (...name: Parameters<Change>) => boolean): boolean {
  let found = false;
  withNames(value, declared, (kind, name, body) => {
    found ||= test(kind, name, body);
    return name;
  });
  return found;
}

/** What an entry means, and its unit: "of the slot's line; default: 0 [rad]". */
export function hintOf({ description = "", unit, units = unit === undefined ? [] : [unit] }: Declared): string {
  const shown = units.filter((one) => one !== "1").join(", ");
  return shown === "" ? description : `${description} [${shown}]`.trim();
}

/** Every point of a body that the file names, as "body.point". */
function spots(data: Readonly<Record<string, unknown>>): readonly string[] {
  const joints = Object.entries((data["joints"] ?? {}) as Record<string, Record<string, unknown>>);
  return Object.entries((data["bodies"] ?? {}) as Record<string, { points?: object }>).flatMap(
    ([body, { points = {} }]) => {
      const joined = joints.filter(([, joint]) => Object.values(joint).flat().includes(body)).map(([name]) => name);
      return [...new Set([...Object.keys(points), ...joined])].map((point) => spotOf(body, point));
    },
  );
}

/** The texts among which an entry is chosen: names of bodies, joints, points; undefined: any may be typed. */
export function choicesOf(entry: Declared, data: Readonly<Record<string, unknown>>): readonly string[] | undefined {
  if (entry.enum !== undefined) return entry.enum.map(String);
  if (entry.type === "boolean") return ["true", "false"];
  if (entry.refers === "spot") return spots(data);
  const named = { body: data["bodies"], joint: data["joints"] }[entry.refers ?? ""];
  return named === undefined ? undefined : Object.keys(named as object);
}

/** The optional keys that a table lacks and that are one number or text, each with what it begins as. */
export function lackingKeys(entry: Declared, table: object): readonly (readonly [string, string | number | boolean])[] {
  const lacking = Object.entries(entry.properties ?? {}).filter(([key]) => !(key in table));
  return lacking.flatMap(([key, one]) => {
    const own = resolved(one, "");
    const first = own.enum?.[0] ?? (own.type === "boolean" ? true : beginning(own.units?.[0] ?? own.unit));
    return first === undefined ? [] : [[key, first] as const];
  });
}

const BEGINNINGS: Readonly<Record<string, string | number>> = { "1": 1, m: "10mm", rad: "10deg", Pa: "10MPa", s: "1s" };

function beginning(unit: string | undefined): string | number | undefined {
  return unit === undefined ? undefined : (BEGINNINGS[unit] ?? `1${unit}`);
}
