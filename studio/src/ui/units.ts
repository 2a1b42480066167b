/** Quantities as texts with units: the rules of `ilmek.units`, with its table. */
import { formatNumber } from "../text";
import table from "./units.json";

type Dimension = readonly number[];

interface Unit {
  factor: number;
  dimension: Dimension;
}

/** Bounds of a quantity [SI], as a machine declares them; null: none. */
export interface Bounds {
  above?: number | null;
  at_least?: number | null;
  below?: number | null;
  at_most?: number | null;
}

/** What a text was read as: a value in SI, or why it is none. */
export type Reading =
  | { si: number; text: string }
  | { error: "notQuantity" | "notNumber" | "unknownUnit" | "wrongUnit"; unit: string };

const UNITS = table.units as unknown as Record<string, [number, Dimension]>;
const NUMBER = /^([+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)\s*([\s\S]*)$/;
const FACTOR = /^([a-zA-Z%°]+|1)(?:\^?(-?[0-9]{1,3}))?$/;
const SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻";
const PLAIN = "0123456789-";
const known = new Map<string, Unit | null>();

/** A unit written as products and quotients of known ones; null for one that is not known. */
export function parseUnit(text: string): Unit | null {
  const found = known.get(text);
  if (found !== undefined) return found;
  const made = readUnit(text);
  if (known.size < 1000) known.set(text, made);
  return made;
}

function readUnit(text: string): Unit | null {
  if (text.length > table.longest) return null;
  const written = [...text.trim()].map(plainSign).join("");
  let factor = 1;
  const dimension = [0, 0, 0, 0];
  if (written === "") return { factor, dimension };
  let sign = 1;
  for (const part of (written.startsWith("/") ? `1${written}` : written).split(/([*/])/)) {
    if (part === "*" || part === "/") {
      sign = part === "*" ? 1 : -1;
      continue;
    }
    const matched = FACTOR.exec(part.trim());
    const unit = matched?.[1] === undefined || !Object.hasOwn(UNITS, matched[1]) ? undefined : UNITS[matched[1]];
    if (matched === null || unit === undefined) return null;
    const power = sign * Number(matched[2] ?? 1);
    if (Math.abs(power) > table.highestPower) return null;
    factor *= unit[0] ** power;
    unit[1].forEach((exponent, at) => {
      dimension[at] = (dimension[at] ?? 0) + power * exponent;
    });
  }
  return factor >= table.least && factor <= table.greatest ? { factor, dimension } : null;
}

function plainSign(sign: string): string {
  const at = SUPERSCRIPTS.indexOf(sign);
  if (at >= 0) return PLAIN[at] ?? sign;
  return { "·": "*", µ: "u", μ: "u" }[sign] ?? sign;
}

/**
 * Reads a quantity of the dimension of `unit`. A number alone is taken in `unit`, and the text returned has it.
 *
 * A comma between digits is taken for a decimal point, as it is on keyboards of many countries.
 */
export function readQuantity(text: string, unit: string): Reading {
  const plain = unit === "" || unit === "1";
  const failed = plain ? ("notNumber" as const) : ("notQuantity" as const);
  const written = text
    .trim()
    .replace("−", "-")
    .replace(/^([+-]?\d*),(\d+)/, "$1.$2");
  const matched = written.length <= table.longest ? NUMBER.exec(written) : null;
  const required = parseUnit(unit);
  if (matched === null || required === null) return { error: failed, unit: "" };
  const [, number = "", given = ""] = matched;
  const own = parseUnit(given);
  if (own === null) return { error: "unknownUnit", unit: given };
  if (given !== "" && own.dimension.some((exponent, at) => exponent !== required.dimension[at])) {
    return { error: "wrongUnit", unit: given };
  }
  const si = Number(number) * (given === "" ? required.factor : own.factor) + 0;
  if (!(Math.abs(si) <= table.greatest)) return { error: failed, unit: "" };
  return { si, text: given === "" && !plain ? `${number}${unit.replace(/^1\//, "/")}` : written.replaceAll(" ", "") };
}

/** Which bound a value [SI] is outside of; null where it is inside. Rounding by 1e-9 counts as inside. */
export function outside(si: number, bounds: Bounds): "small" | "large" | null {
  const { above, at_least: least, below, at_most: most } = bounds;
  if ((above != null && si <= above) || (least != null && si < least - 1e-9 * Math.abs(least))) return "small";
  if ((below != null && si >= below) || (most != null && si > most + 1e-9 * Math.abs(most))) return "large";
  return null;
}

/** A value [SI] in a unit. */
export function fromSi(si: number, unit: string): number {
  return si / (parseUnit(unit)?.factor ?? 1);
}

/** A unit as it is printed: `kg/m^3` is kg/m³, `N*m` is N·m, `deg` is °. */
export function shownUnit(unit: string): string {
  const plain = { deg: "°", um: "µm", rpm: "rev/min", inch: "in", Nm: "N·m", "1": "" }[unit] ?? unit;
  const powers = plain.replace(/\^(-?\d+)/g, (_, digits: string) =>
    [...digits].map((digit) => SUPERSCRIPTS[PLAIN.indexOf(digit)] ?? digit).join(""),
  );
  return powers.replaceAll("*", "·").replace(/^1(?=\/)/, "");
}

/** A value [SI] as it is shown in a unit: "59.74 mm". */
export function formatQuantity(si: number, unit: string, digits = 4): string {
  const printed = shownUnit(unit);
  const number = formatNumber(fromSi(si, unit), digits);
  return `${number}${/^[\p{L}]/u.test(printed) ? " " : ""}${printed}`;
}

/** A quantity of a file as a field shows it, its unit apart: "59.74 mm". */
export function spaced(text: string): string {
  return text.replace(/^([-+]?[\d.]+(?:e[-+]?\d+)?)(?=[\p{L}%])/iu, "$1 ");
}

/** A value [SI] as a text that the command line and files read: "59.74mm". */
export function quantityText(si: number, unit: string, digits = 6): string {
  const number = String(Number(fromSi(si, unit).toPrecision(digits)));
  return unit === "" || unit === "1" ? number : `${number}${unit.replace(/^1\//, "/")}`;
}
