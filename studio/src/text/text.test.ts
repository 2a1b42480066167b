import { readdirSync, readFileSync, statSync } from "node:fs";
import { join } from "node:path";
import { afterEach, beforeAll, describe, expect, it } from "vitest";
import { formatNumber, formatSpan, loadTexts, setLanguage, t } from ".";
import { en as first } from "./en";
import { views } from "./en/views";
import { tr } from "./tr";

const SOURCES = join(import.meta.dirname, "..");

function filesBelow(path: string): string[] {
  if (!statSync(path).isDirectory()) return [path];
  return readdirSync(path).flatMap((name) => filesBelow(join(path, name)));
}

const code = filesBelow(SOURCES)
  .filter((path) => /\.tsx?$/.test(path) && !/\.test\.tsx?$/.test(path) && !path.includes(join(SOURCES, "text")))
  .map((path) => ({ path, text: readFileSync(path, "utf8") }));
const en = { ...first, ...views };
const groups = Object.entries(en) as [keyof typeof en, Record<string, string>][];

function braces(text: string): string[] {
  return [...new Set(text.match(/\{\w+\}/g) ?? [])].sort();
}

beforeAll(loadTexts);
afterEach(() => setLanguage("en"));

describe("every text", () => {
  it.each(groups)("of %s is in both languages, with the same values", (group, texts) => {
    const other = tr[group] as Record<string, string>;
    expect(Object.keys(other)).toEqual(Object.keys(texts));
    for (const [key, text] of Object.entries(texts)) {
      expect(other[key], `tr ${group}.${key}`).toBeTruthy();
      expect(braces(other[key] ?? ""), `tr ${group}.${key}`).toEqual(braces(text));
    }
  });
  it.each(groups)("of %s is used", (group, texts) => {
    const everything = code.map((one) => one.text).join("\n") + readFileSync(join(SOURCES, "text/index.ts"), "utf8");
    const made = [...everything.matchAll(/`(\w+)\.(\w*)\$\{[^}]*\}(\w*)`/g)].filter((one) => one[1] === group);
    const unused = Object.keys(texts).filter(
      (key) =>
        !everything.includes(`"${group}.${key}"`) &&
        !made.some(([, , before = "", after = ""]) =>
          before + after === "" ? everything.includes(`"${key}"`) : key.startsWith(before) && key.endsWith(after),
        ),
    );
    expect(unused).toEqual([]);
  });
  it("stands in the catalogue, none in a component", () => {
    const literal = code.flatMap(({ path, text }) =>
      [
        ...text.matchAll(
          /(?:<\w[^<>{}=]*>|\s(?:label|title|alt|placeholder|aria-label|help)=")\s*([A-Z][a-z]+[ \w]*)/g,
        ),
      ].map((found) => `${path.slice(SOURCES.length)}: ${found[1]}`),
    );
    expect(literal).toEqual([]);
  });
});

describe("t", () => {
  it("fills in values, numbers as the language writes them", async () => {
    expect(t("machine.sensitivityWork", { done: 2, all: 12345 })).toBe("2 of 12,345 parameters moved");
    await setLanguage("tr");
    expect(t("machine.sensitivityWork", { done: 2, all: 12345 })).toBe("12.345 parametreden 2 tanesi oynatıldı");
    expect(document.documentElement.lang).toBe("tr");
  });
});

describe("numbers", () => {
  it("have four digits, true minus signs and powers where they are far from one", async () => {
    expect(formatNumber(59.7375)).toBe("59.74");
    expect(formatNumber(-0.5)).toBe("−0.5");
    expect(formatNumber(135000)).toBe("135,000");
    expect(formatNumber(0.00002)).toBe("20·10⁻⁶");
    expect(formatNumber(Number.NaN)).toBe("–");
    await setLanguage("tr");
    expect(formatNumber(59.7375)).toBe("59,74");
  });
  it("are spans of time", () => {
    expect(formatSpan(0.04)).toBe("40 ms");
    expect(formatSpan(40)).toBe("40 s");
    expect(formatSpan(7500)).toBe("2 h 5 min");
  });
});
