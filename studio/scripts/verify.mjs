// Builds the client beside the shipped one, and ends with 1 where a file differs: the shipped build is that of the sources.
// The same for the types that are generated from the server's schema.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, relative } from "node:path";
import { fileURLToPath } from "node:url";

const studio = fileURLToPath(new URL("..", import.meta.url));
const shipped = join(studio, "../src/ilmek/web/client");
const work = mkdtempSync(join(tmpdir(), "ilmek-studio-"));

function names(folder) {
  const found = readdirSync(folder, { recursive: true }).filter((name) => statSync(join(folder, name)).isFile());
  return found.map((name) => relative(".", name)).sort();
}

function differing(one, other) {
  const all = new Set([...names(one), ...names(other)]);
  return [...all].filter((name) => {
    try {
      return !readFileSync(join(one, name)).equals(readFileSync(join(other, name)));
    } catch {
      return true;
    }
  });
}

try {
  const run = (command, ...given) =>
    execFileSync("npx", ["--no-install", command, ...given], { cwd: studio, stdio: "pipe" });
  run("vite", "build", "--outDir", join(work, "client"), "--emptyOutDir", "--logLevel", "error");
  execFileSync("node", ["scripts/page.mjs", join(work, "client")], { cwd: studio, stdio: "inherit" });
  execFileSync("node", ["scripts/stamp.mjs", join(work, "client")], { cwd: studio, stdio: "inherit" });
  const changed = differing(shipped, join(work, "client"));
  for (const of of ["messages", "mechanism"]) {
    run(
      ...["json2ts", "-i", `src/api/${of}.json`, "-o", join(work, `${of}.ts`)],
      ...["--unknownAny", "--no-additionalProperties", "--unreachableDefinitions"],
    );
    const types = readFileSync(join(studio, `src/api/${of}.ts`));
    if (!types.equals(readFileSync(join(work, `${of}.ts`)))) changed.push(`studio/src/api/${of}.ts`);
  }
  if (changed.length > 0) {
    console.error(`not the build of the sources: ${changed.join(", ")}; run make client`);
    process.exitCode = 1;
  }
} finally {
  rmSync(work, { recursive: true });
}
