// Explains the steps of a search that does not show all, or is no search with a queue.
import type { PlannerRow } from "../api";
import type { Shown } from "./shown";
import { titleOf } from "./titles";

interface Searched extends Pick<PlannerRow, "name" | "tells"> {
  answer: Shown | null;
  /** How many expansions can be stepped through. */
  shown: number;
}

function sentenceOf({ name: planner, tells, answer, shown }: Searched): string {
  const name = titleOf(planner);
  const all = answer?.expansions ?? 0;
  if (!answer) return "";
  if (answer.trace?.truncated && all > shown) return `${name}: the steps show the first ${shown.toLocaleString("en")} of ${all.toLocaleString("en")} expansions.`;
  if (tells === "lookup" && shown <= 1) return `${name} looks its answer up in an index: there is no search to step through.`;
  return tells === "tree" ? `${name} draws points and has no queue: the steps show its tree as it grew.` : "";
}

/** One sentence for each planner that needs one. */
export const aboutSearch = (all: Searched[]): string => [...new Set(all.map(sentenceOf).filter(Boolean))].join(" ");
