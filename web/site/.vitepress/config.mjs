// The docs site. web/build/site.mjs stages its pages in web/.site, with sidebar.json, and builds them.
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { defineConfig } from "vitepress";

const staged = new URL("../../.site/", import.meta.url);

export default defineConfig({
  title: "Outrider",
  description: "Path planning and jobs for ground robots",
  srcDir: fileURLToPath(staged),
  cacheDir: fileURLToPath(new URL("../../node_modules/.vitepress", import.meta.url)),
  ignoreDeadLinks: false,
  // Colours would cost most of the time of a build.
  markdown: { highlight: (text) => `<pre v-pre><code>${text.replace(/&/g, "&amp;").replace(/</g, "&lt;")}</code></pre>` },
  vite: { publicDir: false, build: { chunkSizeWarningLimit: 8000 } },
  themeConfig: {
    sidebar: JSON.parse(readFileSync(new URL("sidebar.json", staged), "utf8")),
    outline: [2, 3],
    // All words must occur, and what people wrote comes before what the headers declare.
    search: { provider: "local", options: { miniSearch: { searchOptions: {
      combineWith: "AND", fuzzy: false, prefix: true, boost: { title: 4, titles: 1, text: 2 },
      boostDocument: (id) => (id.includes("/include/") ? 0.1 : 1),
    } } } },
  },
});
