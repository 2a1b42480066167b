import { readdirSync, readFileSync } from "node:fs";
import { join, sep } from "node:path";
import { expect, it } from "vitest";

const EXPORT = /^export (?:async )?(?:function|const|class|type|interface|let) (\w+)/gm;

const files = readdirSync(import.meta.dirname, { recursive: true, encoding: "utf8" })
  .filter((name) => /\.tsx?$/.test(name) && !/\.test\.tsx?$/.test(name))
  .map((name) => ({ name: name.split(sep).join("/"), text: readFileSync(join(import.meta.dirname, name), "utf8") }));

it("has no export that nothing uses", () => {
  const uses = new Map<string, number>();
  for (const { text } of files) for (const [word] of text.matchAll(/\w+/g)) uses.set(word, (uses.get(word) ?? 0) + 1);
  const dead = files
    .filter(({ name }) => !["api/messages.ts", "api/mechanism.ts"].includes(name))
    .flatMap(({ name, text }) => [...text.matchAll(EXPORT)].map((found) => `${name}: ${found[1]}`))
    .filter((one) => uses.get(one.split(" ")[1] ?? "") === 1);
  expect(dead).toEqual([]);
});
