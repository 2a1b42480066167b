/** Circles of imports between the sources, types and loaded parts included: none is allowed. */
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { dirname, join, relative, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const ROOT = resolve(dirname(fileURLToPath(import.meta.url)), "../src");
const IMPORT = /(?:\bfrom\s*|\bimport\s*\(?\s*)["'](\.[^"']*)["']/g;

/** The files that each file of a folder imports; those that are no sources (styles, pictures, tables) are left out. */
export function importsOf(root) {
  const files = readdirSync(root, { recursive: true })
    .map((name) => join(root, String(name)))
    .filter((path) => /\.tsx?$/.test(path));
  return new Map(
    files.map((path) => {
      const names = [...readFileSync(path, "utf8").matchAll(IMPORT)].map((found) => resolve(dirname(path), found[1]));
      return [path, names.map(source).filter((found) => found !== undefined)];
    }),
  );
}

function source(path) {
  const tried = [path, `${path}.ts`, `${path}.tsx`, join(path, "index.ts"), join(path, "index.tsx")];
  return tried.find((name) => /\.tsx?$/.test(name) && existsSync(name));
}

/** One shortest circle through each file that is in one and in none before, as paths, the first one again at the end. */
export function circles(imports) {
  const found = [];
  const seen = new Set();
  for (const start of imports.keys()) {
    const circle = seen.has(start) ? null : shortest(imports, start);
    if (circle === null) continue;
    for (const path of circle) seen.add(path);
    found.push(circle);
  }
  return found;
}

function shortest(imports, start) {
  const before = new Map([[start, null]]);
  for (const path of before.keys()) {
    for (const next of imports.get(path) ?? []) {
      if (next === start) return trail(before, path, [start]);
      if (!before.has(next)) before.set(next, path);
    }
  }
  return null;
}

function trail(before, path, end) {
  return path === null ? end : trail(before, before.get(path), [path, ...end]);
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const found = circles(importsOf(ROOT));
  for (const circle of found) console.error(`circle: ${circle.map((path) => relative(ROOT, path)).join(" -> ")}`);
  process.exitCode = found.length > 0 ? 1 : 0;
}
