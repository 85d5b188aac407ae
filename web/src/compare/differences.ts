// The metrics of several runs, beside each other: which differ, and by how much.
import { finite, metric, minus, type Num } from "../base/numbers";

/** So many runs are compared at a time. */
export const mostCompared = 4;

export interface Difference {
  name: string;
  /** As the page shows them; a dash where a run has no such metric. */
  values: string[];
  unit: string;
  /** They are not the same, as they are shown. */
  differs: boolean;
  /** The last one less the first; empty where either has none or they are the same. */
  change: string;
}

const absent = "\u2013";

function changeOf(name: string, first: Num | undefined, last: Num | undefined): string {
  if (!Number.isFinite(first) || !Number.isFinite(last) || first === last) return "";
  const change = finite(last) - finite(first);
  const { value, unit } = metric(name, Math.abs(change));
  return `${change > 0 ? "+" : minus("-")}${value}${unit ? ` ${unit}` : ""}`;
}

/** One row for each metric of any run, in the order in which the runs have them. */
export function differencesOf(runs: readonly Record<string, Num>[]): Difference[] {
  const names = [...new Set(runs.flatMap((one) => Object.keys(one)))];
  return names.map((name) => {
    const shown = runs.map((one) => (name in one ? metric(name, one[name]!) : null));
    const values = shown.map((one) => one?.value ?? absent);
    return { name: metric(name, 0).label, values, unit: shown.find((one) => one !== null)?.unit ?? "",
      differs: new Set(values).size > 1, change: new Set(values).size > 1 ? changeOf(name, runs[0]![name], runs.at(-1)![name]) : "" };
  });
}
