// How much of an area was covered, over the time.
import type { Run } from "../report/run";
import { areaOfOutlines } from "./cover_layer";
import type { Series } from "./plotted";

export function coverSeries({ report: { cover } }: Run): Series[] {
  if (!cover || cover.covered.length === 0) return [];
  const reach = areaOfOutlines(cover.reach);
  const share = (column: number): (number | null)[] => cover.covered.map((row) => (reach > 0 ? (100 * row[column]!) / reach : null));
  return [{ title: "Covered", unit: "% of the reach", time: cover.covered.map(([t]) => t!), lines: [
    { name: "covered", colour: "reached", values: share(1) },
    { name: "overlap", colour: "failed", values: share(2) }] }];
}
