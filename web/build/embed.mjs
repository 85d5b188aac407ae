// embed.mjs OUT SOURCE: compresses OUT/app and writes the C++ source that holds it and OUT/viewer.
import { mkdirSync, readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { dirname, extname, join } from "node:path";
import { gzipSync } from "node:zlib";

const [out, source] = process.argv.slice(2);

const types = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".css": "text/css; charset=utf-8",
  ".svg": "image/svg+xml",
  ".mcap": "application/octet-stream",
};

function filesBelow(folder, prefix = "") {
  return readdirSync(join(folder, prefix)).flatMap((name) => {
    const path = prefix + name;
    return statSync(join(folder, path)).isDirectory() ? filesBelow(folder, `${path}/`) : [path];
  });
}

/** The bytes of a file under a symbol of the assembler, which is much faster than an array in C++. */
const blob = (symbol, file) => `asm(R"(
  .section .rodata
  .global ${symbol}
${symbol}: .incbin "${file}"
  .global ${symbol}_end
${symbol}_end: .byte 0
  .previous)");
extern "C" const char ${symbol}[];
extern "C" const char ${symbol}_end[];
`;
const view = (symbol) => `{${symbol}, static_cast<std::size_t>(${symbol}_end - ${symbol})}`;

const paths = filesBelow(join(out, "app")).sort();
let text = '#include "page.hpp"\n\n';
const rows = paths.map((path, i) => {
  const type = types[extname(path)];
  if (!type) throw new Error(`${path}: no Content-Type is known for this`);
  const packed = join(out, "gzip", `${path}.gz`);
  mkdirSync(dirname(packed), { recursive: true });
  writeFileSync(packed, gzipSync(readFileSync(join(out, "app", path)), { level: 9 }));
  text += blob(`outrider_page_${i}`, packed);
  return `    {"${path}", "${type}", ${view(`outrider_page_${i}`)}},\n`;
});
text += blob("outrider_page_viewer", join(out, "viewer/viewer.html"));
text += `
namespace outrider::page {

std::span<const File> files() {
  static const File all[] = {
${rows.join("")}  };
  return all;
}

std::string_view viewer() { return ${view("outrider_page_viewer")}; }

}  // namespace outrider::page
`;
writeFileSync(source, text);
