// Builds the part of the client that stands in a page by itself, loom.html: one script without imports.
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "vite";

const studio = fileURLToPath(new URL("..", import.meta.url));
const folder = process.argv[2] ?? join(studio, "../src/ilmek/web/client");

await build({
  root: studio,
  configFile: false,
  logLevel: "error",
  publicDir: false,
  oxc: { jsx: { runtime: "automatic", importSource: "preact" } },
  build: {
    outDir: folder,
    emptyOutDir: false,
    target: "es2022",
    modulePreload: false,
    lib: {
      entry: join(studio, "src/views/loom/page.tsx"),
      formats: ["iife"],
      name: "loomInSpace",
      fileName: () => "loom-page.js",
    },
    rollupOptions: { output: { codeSplitting: false } },
  },
});
