// Builds the parts of the client that stand in pages by themselves, each one script without imports: the figures of
// reports, and the loom in space, each with its own texts alone.
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "vite";

const studio = fileURLToPath(new URL("..", import.meta.url));
const folder = process.argv[2] ?? join(studio, "../src/ilmek/web/client");
const PAGES = [
  { name: "figures", entry: "src/draw/page.tsx", texts: "src/text/page.ts" },
  { name: "loom", entry: "src/views/loom/page.tsx", texts: "src/text/loom-page.ts" },
];

for (const { name, entry, texts } of PAGES) {
  await build({
    root: studio,
    configFile: false,
    logLevel: "error",
    publicDir: false,
    resolve: { alias: [{ find: /^\.\/(en|tr)$/, replacement: join(studio, texts) }] },
    oxc: { jsx: { runtime: "automatic", importSource: "preact" } },
    build: {
      outDir: folder,
      emptyOutDir: false,
      target: "es2022",
      modulePreload: false,
      lib: { entry: join(studio, entry), formats: ["iife"], name: `${name}Page`, fileName: () => `${name}-page.js` },
      rollupOptions: {
        output: { codeSplitting: false },
        treeshake: { moduleSideEffects: (id) => id.endsWith(entry) },
      },
    },
  });
}
