// The answers of the planners, side by side.
import { h } from "../base/dom";
import { fixed } from "../base/numbers";
import type { Shown } from "./shown";

type ResultRow = [string, (answer: Shown) => string];

/** Codes of searches that ended without a path. */
const searched = new Set(["no_path", "budget_exhausted"]);

const rows: ResultRow[] = [
  ["answer", (one) => (one.status === "done" ? "path found" : one.status === "unanswered" ? "not answered" : searched.has(one.status) ? "no path" : "refused")],
  ["cost", (one) => (one.cost == null ? "\u2013" : `${fixed(one.cost, 3)} ${one.cost_unit ?? ""}`)],
  ["lower bound", (one) => (one.lower_bound == null ? "\u2013" : `${fixed(one.lower_bound, 3)} ${one.cost_unit ?? ""}`)],
  ["length", (one) => (one.length_m == null ? "\u2013" : `${fixed(one.length_m, 3)} m`)],
  ["clearance", (one) => (one.clearance_m == null ? "\u2013" : `${fixed(one.clearance_m, 3)} m`)],
  ["expansions", (one) => one.expansions?.toLocaleString("en") ?? "\u2013"],
  ["lines of sight", (one) => one.line_of_sight_checks?.toLocaleString("en") ?? "\u2013"],
  ["time", (one) => (one.time_s === undefined ? "\u2013" : `${fixed(1000 * one.time_s, 2)} ms`)],
];

/** The answers in a sentence. */
export const answerWords = (answers: (Shown | null)[]): string =>
  answers.flatMap((one) => (one ? [`${one.planner}: ${rows.slice(0, 2).map(([name, text]) => (name === "answer" ? text(one) : `${name} ${text(one)}`)).join(", ")}.`] : [])).join(" ");

export function resultTable(answers: (Shown | null)[]): HTMLElement {
  const given = answers.filter((one) => one !== null);
  return h("table", { class: "result" },
    h("thead", {}, h("tr", {}, h("td"), ...given.map((one) => h("th", { scope: "col" }, one.planner)))),
    h("tbody", {}, ...rows.map(([name, text]) => h("tr", {}, h("th", { scope: "row" }, name), ...given.map((one) => h("td", { "data-row": name }, text(one)))))));
}
