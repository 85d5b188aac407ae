// pages.mjs [OUT]: builds both pages, OUT/app with its assets and OUT/viewer, one file. OUT is ../out/web unless
// given. CMake and `npm run build` both call this.
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "vite";

const root = join(dirname(fileURLToPath(import.meta.url)), "..");
const out = resolve(process.argv[2] ?? join(root, "../out/web"));
for (const mode of ["app", "viewer"]) {
  await build({ root, mode, logLevel: "warn", build: { outDir: join(out, mode), emptyOutDir: true } });
}
