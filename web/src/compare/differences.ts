// The metrics of several runs, beside each other: which differ, and by how much.
import { finite, metric, minus, type Num } from "../base/numbers";

/** So many runs are compared at a time. */
export const mostCompared = 4;

export interface Difference {
  name: string;
  /** As the page shows them; a dash where a run has no such metric. */
  values: { value: string; unit: string }[];
  /** They are not the same, as they are shown. */
  differs: boolean;
  /** The last one less the first, or in words how they compare. */
  change: string;
}

const absent = { value: "\u2013", unit: "" };

function changeOf(name: string, first: Num | undefined, last: Num | undefined): string {
  if (first === undefined || last === undefined) return "not in both";
  if (!Number.isFinite(first) || !Number.isFinite(last) || first === last) return "differs";
  const change = finite(last) - finite(first);
  const { value, unit } = metric(name, Math.abs(change));
  return `${change > 0 ? "+" : minus("-")}${value}${unit ? ` ${unit}` : ""}`;
}

/** One row for each metric of any run, in the order in which the runs have them. */
export function differencesOf(runs: readonly Record<string, Num>[]): Difference[] {
  const names = [...new Set(runs.flatMap((one) => Object.keys(one)))];
  return names.map((name) => {
    const values = runs.map((one) => (name in one ? metric(name, one[name]!) : absent));
    const differs = new Set(values.map(({ value, unit }) => `${value} ${unit}`)).size > 1;
    return { name: metric(name, 0).label, values: values.map(({ value, unit }) => ({ value, unit })), differs, change: differs ? changeOf(name, runs[0]![name], runs.at(-1)![name]) : "same" };
  });
}
