/** All texts of the studio: typed keys, English of the first view at once, the rest loaded when it is needed. */
import { computed, signal } from "@preact/signals";
import type { Catalogue, Group, Translation } from "./catalogue";
import { en } from "./en";

export type Language = "en" | "tr";

/** "group.key" of every text. */
export type Key = { [G in Group]: `${G}.${keyof Catalogue[G] & string}` }[Group];

type TextOf<K extends Key> = K extends `${infer G extends Group}.${infer N}`
  ? N extends keyof Catalogue[G]
    ? Catalogue[G][N]
    : never
  : never;
type Braces<S> = S extends `${string}{${infer Name}}${infer Rest}` ? Name | Braces<Rest> : never;
type Values<K extends Key> = [Braces<TextOf<K>>] extends [never]
  ? []
  : [values: Record<Braces<TextOf<K>> & string, string | number>];

export const LANGUAGES: Record<Language, string> = { en: "English", tr: "Türkçe" };

const chosen = signal<Language>("en");
let english: Partial<Translation> = en;
const catalogue = signal(english);

/** The language shown. */
export const language = computed(() => chosen.value);

/** Shows another language; resolves when its texts are there. */
export async function setLanguage(to: Language): Promise<void> {
  catalogue.value = to === "en" ? english : (await import("./tr")).tr;
  chosen.value = to;
  document.documentElement.lang = to;
}

/** Loads the texts of all views; the first one needs none of them. */
export async function loadTexts(): Promise<void> {
  english = { ...en, ...(await import("./en/views")).views };
  if (chosen.peek() === "en") catalogue.value = english;
}

/**
 * The text of a key; `{name}` in it is replaced by a value, numbers written as the language writes them.
 *
 * A text with `|` has two forms, for one and for other counts, chosen by the value `count`.
 */
export function t<K extends Key>(key: K, ...values: Values<K>): string {
  return fill(textOf(catalogue.value, key), values[0] as Record<string, string | number> | undefined);
}

/** `t` for a key that is made at run time; undefined where no text has it. */
export function textIfKnown(key: string, values?: Record<string, string | number>): string | undefined {
  const found = lookUp(catalogue.value, key);
  return found === undefined ? undefined : fill(found, values);
}

function lookUp(texts: Partial<Translation>, key: string): string | undefined {
  const at = key.indexOf(".");
  const group = texts[key.slice(0, at) as Group] as Record<string, string> | undefined;
  return group?.[key.slice(at + 1)];
}

function textOf(texts: Partial<Translation>, key: string): string {
  return lookUp(texts, key) ?? key;
}

function fill(text: string, values: Record<string, string | number> | undefined): string {
  if (values === undefined) return text;
  const forms = text.split("|");
  const plural = typeof values["count"] === "number" && forms.length > 1;
  const form = plural && pluralRules().select(values["count"] as number) !== "one" ? forms[1] : forms[0];
  return (form ?? text).replace(/\{(\w+)\}/g, (whole, name: string) => {
    const value = values[name];
    return value === undefined ? whole : typeof value === "number" ? formatNumber(value) : value;
  });
}

const rules = new Map<Language, Intl.PluralRules>();
function pluralRules(): Intl.PluralRules {
  const one = rules.get(chosen.value) ?? new Intl.PluralRules(chosen.value);
  rules.set(chosen.value, one);
  return one;
}

const formats = new Map<string, Intl.NumberFormat>();

/** A number as the language writes it, with at most `digits` significant digits; "–" where it is none. */
export function formatNumber(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "–" : value > 0 ? "∞" : "−∞";
  const size = Math.abs(value);
  const scientific = size !== 0 && (size < 1e-4 || size >= 1e9);
  const rounded = Number.isInteger(value) && size < 1e9 ? value : Number(value.toPrecision(digits));
  const key = `${chosen.value} ${scientific}`;
  let format = formats.get(key);
  if (format === undefined) {
    format = new Intl.NumberFormat(chosen.value, {
      maximumSignificantDigits: 15,
      notation: scientific ? "engineering" : "standard",
    });
    formats.set(key, format);
  }
  const written = format.format(rounded).replaceAll("-", "−");
  return scientific
    ? written.replace(/E(.+)$/, (_, power: string) => `·10${[...power].map(raised).join("")}`)
    : written;
}

function raised(sign: string): string {
  return "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(sign)] ?? "⁻";
}

/** A time span in words: "2 h 5 min", "40 s". */
export function formatSpan(seconds: number): string {
  if (seconds < 1) return `${formatNumber(seconds * 1000, 3)} ms`;
  if (seconds < 90) return `${formatNumber(seconds, 3)} s`;
  const minutes = Math.round(seconds / 60);
  if (minutes < 60) return `${minutes} min`;
  const [hours, rest] = [Math.floor(minutes / 60), minutes % 60];
  const unit = t("app.hours");
  return rest ? `${formatNumber(hours)} ${unit} ${rest} ${t("app.minutes")}` : `${formatNumber(hours)} ${unit}`;
}
