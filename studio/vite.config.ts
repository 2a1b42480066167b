import { defineConfig } from "vitest/config";

// The built client is part of the Python package. Names carry a digest of the content; the same sources give the same
// bytes. The page's content policy allows no inline script, so Vite's polyfill for module preload stays out.
export default defineConfig({
  base: "./",
  oxc: { jsx: { runtime: "automatic", importSource: "preact" } },
  build: {
    outDir: "../src/ilmek/web/client",
    emptyOutDir: true,
    target: "es2022",
    sourcemap: false,
    modulePreload: { polyfill: false },
    assetsInlineLimit: 0,
    cssCodeSplit: true,
    reportCompressedSize: true,
    chunkSizeWarningLimit: 800,
    license: { fileName: "licenses.md" },
  },
  test: {
    environment: "happy-dom",
    include: ["src/**/*.test.{ts,tsx}"],
    isolate: false,
    pool: "threads",
    maxWorkers: 1,
  },
});
