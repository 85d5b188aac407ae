// The header of a run: its name, whether it was done, and why not.
import { h, iconButton, svg } from "./base/dom";
import { fixed } from "./base/numbers";
import { typeset } from "./base/typeset";
import { showHelp } from "./base/help";
import { toggleTheme } from "./base/theme";
import type { RunInfo } from "./log/messages";
import type { RunLog } from "./log/run_log";
import { topic } from "./log/topics";

export function emblem(): SVGElement {
  return svg("svg", { class: "emblem", viewBox: "0 0 24 24", "aria-hidden": "true" }, svg("circle", { cx: 12, cy: 14.5, r: 6.2 }),
    svg("path", { d: "M12 14.5 18.6 4.4" }), svg("circle", { class: "dot", cx: 20.4, cy: 2.6, r: 1.6 }));
}

export function tools(): HTMLElement {
  return h("div", { class: "tools" }, iconButton("theme", "Light or dark", toggleTheme, "d"), iconButton("help", "Keys", showHelp, "?"));
}

export function heading(log: RunLog): HTMLHeadingElement {
  const info = log.latest<RunInfo>(topic.run);
  return h("h1", {}, h("span", { class: "job" }, info?.job || log.summary?.job || ""), worldOf(log));
}

/** The world; a file without what its format is. */
const worldOf = (log: RunLog): string => (log.latest<RunInfo>(topic.run)?.world || log.summary?.world || "no name").replace(/\.(txt|map|ya?ml)$/, "");

/** Returns the name of the run, with its verdict. */
export const nameOf = (log: RunLog): string => `${worldOf(log)}, ${verdictOf(log).word.toLowerCase()}`;

/** Returns the verdict of the run, as a word and a sentence. */
function verdictOf({ summary, cut, count, end }: RunLog): { word: string; sentence: string } {
  const why = "its run was killed, or the file is not whole";
  if (cut && count === 0) return { word: "Cut short", sentence: `The log is cut short before its first message: ${why}.` };
  if (cut) return { word: "Cut short", sentence: `The log is cut short at t = ${fixed(end, 2)} s: ${why}. It is shown up to there.` };
  if (!summary) return { word: "No verdict", sentence: "The log has no run.json, which says how the run ended." };
  const done = summary.status === "done";
  const caught = summary.metrics.catch_time_s;
  const words: Record<string, string> = { done: "Done", doubtful: "Doubtful", unconfirmed: "Unconfirmed", cancelled: "Cancelled" };
  return { word: words[summary.status] ?? "Not done", sentence: typeset(summary.reason) || (done && Number.isFinite(caught) ? `caught in second ${fixed(caught, Number.isInteger(caught) ? 0 : 1)}` : "") };
}

/** Returns title and verdict, for the header of the viewer and above a run in the app. */
export function title(log: RunLog): HTMLElement[] {
  const { word, sentence } = verdictOf(log);
  const info = log.latest<RunInfo>(topic.run);
  return [heading(log),
    h("p", { class: log.cut ? "verdict cut" : "verdict", title: sentence, ...(log.cut ? { role: "alert" } : {}) }, h("b", word === "Done" ? {} : { class: "not" }, word), sentence ? ` ${sentence}` : ""),
    h("p", { class: "seed" }, info?.seeded ? `seed ${info.seed}` : "")];
}

export function banner(log: RunLog): HTMLElement {
  return h("header", { class: "top" }, emblem(), ...title(log), tools());
}
