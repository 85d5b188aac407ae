// one_file.mjs PLANNER.wasm OUT.html: puts the module and its functions into page.html, which then needs nothing else.
import { readFileSync, writeFileSync } from "node:fs";
import { gzipSync } from "node:zlib";

const [wasm, out] = process.argv.slice(2);
const text = (name) => readFileSync(new URL(name, import.meta.url), "utf8");
const functions = text("planner.mjs").replaceAll(/^export /gm, "");
const packed = gzipSync(readFileSync(wasm), { level: 9 });
const page = text("page.html").replace("/*planner.mjs*/", () => functions).replace("/*planner.wasm*/", () => packed.toString("base64"));
writeFileSync(out, page);
console.log(`${out}: ${(page.length / 1000).toFixed(0)} kB, of which the planners ${(packed.length / 1000).toFixed(0)} kB compressed`);
