// Writes client/build.json: a digest of the sources that the build was made of, and one of each built file. A test in
// Python computes both again, and so proves without Node that the shipped build is the build of the sources.
import { createHash } from "node:crypto";
import { readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { join, relative, sep } from "node:path";
import { fileURLToPath } from "node:url";

const studio = fileURLToPath(new URL("..", import.meta.url));
const client = process.argv[2] ?? join(studio, "../src/ilmek/web/client");
const SOURCES = [
  "index.html",
  "package-lock.json",
  "package.json",
  "public",
  "scripts",
  "src",
  "tsconfig.json",
  "vite.config.ts",
];

function filesBelow(path) {
  if (!statSync(path).isDirectory()) return [path];
  return readdirSync(path).flatMap((name) => filesBelow(join(path, name)));
}

function digest(bytes) {
  return createHash("sha256").update(bytes).digest("hex");
}

function named(paths, base) {
  return paths.map((path) => [relative(base, path).split(sep).join("/"), path]).sort(([a], [b]) => (a < b ? -1 : 1));
}

const sources = named(
  SOURCES.flatMap((name) => filesBelow(join(studio, name))),
  studio,
).filter(([name]) => !/\.test\.tsx?$/.test(name));
const lines = sources.map(([name, path]) => `${digest(readFileSync(path))}  ${name}\n`).join("");
const built = named(filesBelow(client), client).filter(([name]) => name !== "build.json");
const files = Object.fromEntries(built.map(([name, path]) => [name, digest(readFileSync(path))]));
writeFileSync(join(client, "build.json"), `${JSON.stringify({ sources: digest(lines), files }, null, 1)}\n`);
