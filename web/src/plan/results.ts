// The answers of the planners, side by side.
import { h } from "../base/dom";
import { fixed } from "../base/numbers";
import { inUnit, lengthText, lengthUnit } from "../base/units";
import type { Shown } from "./shown";
import { titleOf } from "./titles";

type ResultRow = [name: string, text: (answer: Shown) => string, about?: string];

const costText = (cost: number, unit: string): string => (unit === "m" ? lengthText(cost, 3) : unit === "m eq" ? `${fixed(inUnit(cost), 3)} ${lengthUnit()} eq` : `${fixed(cost, 3)} ${unit}`);

/** Codes of searches that ended without a path. */
const searched = new Set(["no_path", "budget_exhausted"]);

const rows: ResultRow[] = [
  ["answer", (one) => (one.status === "done" ? "path found" : one.status === "unanswered" ? "not answered" : searched.has(one.status) ? "no path" : "refused")],
  ["cost", (one) => (one.cost == null ? "\u2013" : costText(one.cost, one.cost_unit ?? ""))],
  ["lower bound", (one) => (one.lower_bound == null ? "\u2013" : costText(one.lower_bound, one.cost_unit ?? ""))],
  ["length", (one) => (one.length_m == null ? "\u2013" : lengthText(one.length_m, 3))],
  ["clearance", (one) => (one.clearance_m == null ? "\u2013" : lengthText(one.clearance_m, 3)), "From the middle of the robot to the nearest obstacle, on every ground: at least its radius"],
  ["expansions", (one) => one.expansions?.toLocaleString("en") ?? "\u2013"],
  ["lines of sight", (one) => one.line_of_sight_checks?.toLocaleString("en") ?? "\u2013"],
  ["time", (one) => (one.time_s === undefined ? "\u2013" : `${fixed(1000 * one.time_s, 2)} ms`)],
];

const compared: Record<string, (answer: Shown) => number | null | undefined> = { cost: (one) => one.cost, expansions: (one) => one.expansions };

/** Returns true if this answer has less than all others; costs are compared only in one unit. */
function isLeast(name: string, answer: Shown, all: Shown[]): boolean {
  const value = compared[name];
  if (!value || all.length < 2 || (name === "cost" && new Set(all.map((one) => one.cost_unit)).size > 1)) return false;
  const own = value(answer);
  return own != null && all.every((one) => one === answer || (value(one) ?? Infinity) > own * (1 + 1e-9));
}

/** The answers in a sentence. */
export const answerWords = (answers: (Shown | null)[]): string =>
  answers.flatMap((one) => (one ? [`${titleOf(one.planner)}: ${rows.slice(0, 2).map(([name, text]) => (name === "answer" ? text(one) : `${name} ${text(one)}`)).join(", ")}.`] : [])).join(" ");

export function resultTable(answers: (Shown | null)[]): HTMLElement {
  const given = answers.filter((one) => one !== null);
  return h("table", { class: "result" },
    h("thead", {}, h("tr", {}, h("td"), ...given.map((one) => h("th", { scope: "col" }, titleOf(one.planner))))),
    h("tbody", {}, ...rows.map(([name, text, about]) => h("tr", {}, h("th", { scope: "row", title: about ?? null }, name), ...given.map((one) => h("td", { "data-row": name, class: isLeast(name, one, given) ? "least" : null, title: isLeast(name, one, given) ? "The least" : null }, text(one)))))));
}
