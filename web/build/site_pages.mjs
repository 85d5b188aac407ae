// Pages of the docs site that are made from something else than Markdown: headers, examples, files, benchmarks.
import { readFileSync } from "node:fs";
import { basename, extname } from "node:path";

/** Text for Markdown that the reader sees as it stands. */
const plain = (text) => text.replace(/[&<>{}*_`[\]|]/g, (sign) => `&#${sign.charCodeAt(0)};`);
const fence = (language, text) => `\`\`\`\`${language}\n${text.trimEnd()}\n\`\`\`\`\n`;
const languages = { ".cpp": "cpp", ".hpp": "cpp", ".py": "python", ".json": "json", ".yaml": "yaml", ".xml": "xml" };
const languageOf = (path) => languages[extname(path)] ?? "text";

/** A header: its opening comment as text (lists and indented lines keep their lines), then what it declares. */
export function headerPage(path, source) {
  const lines = source.split("\n");
  const end = lines.findIndex((line) => !line.startsWith("//"));
  const comment = lines.slice(0, end).map((line) => line.replace(/^\/\/ ?/, "")).join("\n");
  const declared = lines.slice(end).filter((line) => line !== "#pragma once").join("\n").trim();
  const paragraphs = comment.split(/\n\s*\n/).map((paragraph) =>
    /^(-|\s)/m.test(paragraph) ? fence("text", paragraph) : plain(paragraph));
  return `# ${path.replace("include/", "")}\n\n${paragraphs.join("\n\n")}\n\n## Declarations\n\n${fence("cpp", declared)}`;
}

/** An example, whose last comment, from the line "Prints:", is its output; a test compares the two. */
export function examplePage(path, source) {
  const [code, output] = source.split(/^(?:\/\/|#) Prints:\n/m);
  const printed = output === undefined ? "" : `\nIt prints:\n\n${fence("text", output.replace(/^(?:\/\/|#) ?/gm, ""))}`;
  return `# ${basename(path)}\n\n${fence(languageOf(path), code)}${printed}`;
}

/** A file that a page links to, as it stands; the search leaves it out. */
export const filePage = (path, source) => `---\nsearch: false\n---\n# ${path}\n\n${fence(languageOf(path), source)}`;

/** The page that plans in the browser, with this planner; it stands beside the pages of the site. */
export const planFrame = (name) =>
  `\n## Try it\n\n<iframe src="/plan.html#${name}" title="a map on which ${name} plans" loading="lazy" style="width: 100%; height: 640px; border: 0"></iframe>\n`;

export const listPage = (title, entries) =>
  `# ${title}\n\n${entries.map(({ text, link }) => `- [${plain(text)}](${link})`).join("\n")}\n`;

/** The times in a JSON file of Google Benchmark, as bars on a logarithmic scale; without a file, how to make one. */
export function benchmarkPage(file) {
  const how = `Nothing is stored, since times belong to a machine. To draw yours, after \`make bench\`:

${fence("sh", `build/bench/bench_path --benchmark_out=out/bench.json --benchmark_out_format=json
OUTRIDER_BENCH=$PWD/out/bench.json make site`)}`;
  if (!file) return `# Benchmarks\n\n${how}`;
  const { context, benchmarks } = JSON.parse(readFileSync(file, "utf8"));
  const nanoseconds = { ns: 1, us: 1e3, ms: 1e6, s: 1e9 };
  const rows = benchmarks.filter((row) => row.real_time > 0 && row.run_type !== "aggregate").map((row) => ({
    name: row.name, text: `${row.real_time.toPrecision(3)} ${row.time_unit}`, ns: row.real_time * nanoseconds[row.time_unit] }));
  const least = Math.log(Math.min(...rows.map((row) => row.ns)) / 2), most = Math.log(Math.max(...rows.map((row) => row.ns)));
  const bars = rows.map(({ name, text, ns }) => {
    const width = (100 * (Math.log(ns) - least)) / (most - least);
    return `<div>${plain(name)}: ${text}<div style="height:8px;width:${width.toFixed(1)}%;background:var(--vp-c-brand-1)"></div></div>`;
  });
  return `# Benchmarks\n\nReal time of a call, logarithmic; measured ${plain(String(context?.date ?? ""))}.\n\n${bars.join("\n")}\n\n## Make it anew\n\n${how}`;
}
