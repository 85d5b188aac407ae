// The list of runs: what each was, how it ended, how long it took, how long ago; and to run it again.
import { faultText, type RunRow } from "../api";
import { ageText, tookText } from "../base/ages";
import { h } from "../base/dom";
import { typeset } from "../base/typeset";
import { formatAddress } from "../base/url";
import { isOver, stateWords } from "./states";

/** Why it ended as it did; of a run that was done, what its summary says. */
const reasonOf = (run: RunRow): string => typeset(faultText(run) || run.summary?.reason || "");
/** The scenario is a file, so it can be run again. */
const isFile = ({ scenario }: RunRow): boolean => /\.ya?ml$/.test(scenario);

export interface ListActs {
  again: (run: RunRow) => void;
  /** The runs that are chosen to be compared, and what chooses one or lets it go. */
  chosen: ReadonlySet<string>;
  choose: (run: RunRow, on: boolean) => void;
}

function row(run: RunRow, now: number, { again, chosen, choose }: ListActs): HTMLElement {
  const begun = new Date(1000 * run.began_s);
  const facts = [run.seed === null ? "" : `seed ${run.seed}`, isOver(run.state) ? tookText(run.took_s) : ""].filter((one) => one && one !== "\u2013");
  const box = h("input", { type: "checkbox", title: "Compare it with another", "aria-label": `Compare ${run.scenario} of ${begun.toLocaleString()}`, checked: chosen.has(run.id), disabled: !(isOver(run.state) && run.has_log) });
  box.addEventListener("change", () => choose(run, box.checked));
  return h("li", { "data-run": run.id, class: "run-row" }, box, h("a", { href: formatAddress({ view: "live", path: run.id, query: {} }) },
    h("span", { class: "name" }, run.scenario || "a text", h("span", { class: "job" }, run.job)),
    h("span", { class: `run-state ${run.state}` }, stateWords(run.state)),
    h("span", { class: "run-facts" }, facts.join(" \u00b7 ")),
    h("time", { datetime: begun.toISOString(), title: begun.toLocaleString() }, ageText(run.began_s, now)),
    h("span", { class: "run-reason" }, reasonOf(run))),
  isFile(run) && h("button", { type: "button", class: "button", title: run.seed === null ? "Run the scenario again" : `Run the scenario again, with seed ${run.seed}`, onclick: () => again(run) }, "Run again"));
}

/** The newest first. `now` is the Unix time. */
export function runList(runs: readonly RunRow[], now: number, acts: ListActs): HTMLElement[] {
  if (runs.length === 0) return [h("li", { class: "none" }, "None yet.")];
  return runs.map((run) => row(run, now, acts));
}
