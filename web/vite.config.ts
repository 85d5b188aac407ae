// Builds two pages from the same sources: the app with its assets, and (--mode viewer) one self-contained file that
// shows the report placed in it.
import { createHash } from "node:crypto";
import type { Plugin } from "vite";
import { defineConfig } from "vitest/config";

/** Returns the hash of a script for a Content-Security-Policy; a browser runs only the script with these bytes. */
const hashOf = (script: string): string => `sha256-${createHash("sha256").update(script).digest("base64")}`;

/** Inlines the bundle's one script and one style sheet into its HTML, and adds the script's hash to its policy. */
function oneFile(): Plugin {
  return {
    name: "one-file",
    enforce: "post",
    generateBundle: { order: "post", handler(_, bundle) {
      const files = Object.values(bundle);
      const page = files.find((file) => file.fileName.endsWith(".html"));
      if (page?.type !== "asset") throw new Error("the bundle has no HTML file");
      let html = String(page.source);
      for (const file of files) {
        if (file === page) continue;
        const content = (file.type === "chunk" ? file.code : String(file.source)).replaceAll("</script", "<\\/script");
        const tag = file.type === "chunk"
          ? `<script type="module">${content}</script>`
          : `<style>${content}</style>`;
        const link = new RegExp(`<(script|link)[^>]*${file.fileName.replace(/[.]/g, "\\.")}[^>]*>(</script>)?`);
        if (!link.test(html)) throw new Error(`${file.fileName} is not named in the page`);
        html = file.type === "chunk" ? html.replace(link, "").replace("</body>", () => `${tag}\n</body>`)
          : html.replace(link, () => tag);
        if (file.type === "chunk") html = html.replace("SCRIPT-HASH", () => hashOf(content));
        delete bundle[file.fileName];
      }
      page.source = html;
    } },
  };
}

export default defineConfig(({ mode }) => ({
  base: "./",
  build: {
    target: "es2022",
    modulePreload: { polyfill: false },
    cssCodeSplit: mode !== "viewer",
    chunkSizeWarningLimit: 1000,
    rollupOptions: {
      input: mode === "viewer" ? "viewer.html" : "index.html",
      output: mode === "viewer" ? { inlineDynamicImports: true } : {},
    },
  },
  plugins: mode === "viewer" ? [oneFile()] : [],
  // One process for all files: each would load the packages again. A busy machine is slow.
  test: { include: ["tests/unit/**/*.test.ts"], isolate: false, fileParallelism: false, testTimeout: 300_000, hookTimeout: 300_000 },
}));
