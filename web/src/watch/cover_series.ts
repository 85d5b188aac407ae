// How much of an area was covered, over the time.
import { coverOf } from "../log/cover";
import type { Run } from "../log/run";
import { areaOfOutlines } from "./cover_layer";
import type { Series } from "./plotted";

export function coverSeries(run: Run): Series[] {
  const cover = coverOf(run);
  if (!cover || cover.covered.length === 0) return [];
  const reach = areaOfOutlines(cover.reach);
  const share = (key: "covered" | "overlap"): (number | null)[] => cover.covered.map((row) => (reach > 0 ? (100 * row[key]) / reach : null));
  return [{ title: "Covered", unit: "% of the reach", time: cover.covered.map(({ t }) => t), lines: [
    { name: "covered", colour: "reached", values: share("covered") },
    { name: "overlap", colour: "failed", values: share("overlap") }] }];
}
