// The page of benchmarks, drawn from what `make bench` wrote: a JSON file for each program and suite (bench/run.py).
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { fence, plain } from "./site_pages.mjs";

const nanoseconds = { ns: 1, us: 1e3, ms: 1e6, s: 1e9 };
const number = (value) => Number.isInteger(value) ? String(value) : String(Number(value.toPrecision(4)));
const cell = (value) => plain(typeof value === "number" ? number(value) : String(value ?? "")).replace(/\n/g, " ");

/** Times as bars on a logarithmic scale. */
function bars(benchmarks) {
  const rows = benchmarks.filter(({ real_time }) => real_time > 0)
    .map((row) => ({ ...row, ns: row.real_time * nanoseconds[row.time_unit] }));
  const least = Math.log(Math.min(...rows.map(({ ns }) => ns)) / 2), most = Math.log(Math.max(...rows.map(({ ns }) => ns)));
  return rows.map(({ name, real_time, time_unit, ns }) => {
    const width = (100 * (Math.log(ns) - least)) / (most - least);
    return `<div>${plain(name)}: ${real_time.toPrecision(3)} ${time_unit}<div style="height:8px;width:${width.toFixed(1)}%;background:var(--vp-c-brand-1)"></div></div>`;
  }).join("\n");
}

/** Rows of objects as a table; columns that no row fills are left out. */
function table(rows) {
  const columns = [...new Set(rows.flatMap((row) => Object.keys(row)))]
    .filter((column) => rows.some((row) => row[column] !== "" && row[column] !== null && row[column] !== undefined));
  const line = (cells) => `| ${cells.join(" | ")} |`;
  return [line(columns.map(plain)), line(columns.map(() => "---")), ...rows.map((row) => line(columns.map((column) => cell(row[column]))))].join("\n");
}

function section({ name, command, machine, commit, date, seconds, benchmarks, rows, lines }) {
  const where = `${machine.processor}, ${machine.cores} cores, ${machine.system}, load ${machine.load.toFixed(1)} before; ${date}, commit ${commit}, ${number(seconds)} s`;
  const drawn = benchmarks ? `Real time of a call, logarithmic:\n\n${bars(benchmarks)}` : rows ? table(rows) : fence("text", lines.join("\n"));
  return `## ${plain(name)}\n\n${fence("sh", command)}\n${plain(where)}\n\n${drawn}\n`;
}

/** The page of a folder of results; `measured` says whether they are the reader's own. */
export function benchmarkPage(folder, measured) {
  const results = readdirSync(folder).filter((file) => file.endsWith(".json")).sort()
    .map((file) => JSON.parse(readFileSync(join(folder, file), "utf8")));
  const origin = measured ? "These are the results of `make bench` on this machine."
    : "These results are part of the sources, and belong to the machine that is named; `make bench` followed by `make site` draws yours.";
  return `# Benchmarks\n\n${origin} What they mean, with longer runs, is said in the pages of the jobs.\n\n${results.map(section).join("\n")}`;
}
