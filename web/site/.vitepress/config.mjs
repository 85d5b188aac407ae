// The docs site. web/build/site.mjs copies this folder to where it stages the pages, with sidebar.json, and builds it there.
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { defineConfig } from "vitepress";

const staged = new URL("../", import.meta.url);

/** The name of a heading in links, as on GitHub, so that a link leads to it on both. */
const slugify = (text) => text.trim().toLowerCase().replace(/[^\p{L}\p{N}\s_-]/gu, "").replace(/\s/g, "-");

export default defineConfig({
  title: "Outrider",
  description: "Path planning and jobs for ground robots",
  cacheDir: fileURLToPath(new URL(".cache", import.meta.url)),
  ignoreDeadLinks: false,
  // Colours would cost most of the time of a build.
  markdown: { anchor: { slugify }, highlight: (text) => `<pre v-pre><code>${text.replace(/&/g, "&amp;").replace(/</g, "&lt;")}</code></pre>` },
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
