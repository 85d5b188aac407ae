// Series that can be plotted of a mapping: how far belief, odometry and reference lie from the way as settled in the end, the
// belief's own uncertainty, and what the map had when.
import { beliefsOf } from "../log/beliefs";
import type { Vec2 } from "../log/geometry";
import { landmarksAt, loopsAt, odometryOf, referenceOf } from "../log/mapping";
import type { Run } from "../log/run";
import { topic } from "../log/topics";
import { ellipseOf } from "./ellipse";
import { wasMoved } from "./mapping_layer";
import type { Series } from "./plotted";

export function mappingSeries(run: Run): Series[] {
  const { all, times } = beliefsOf(run);
  if (run.hasTruth || all.length < 2) return [];
  const off = (at: ArrayLike<number>, places: Vec2[]): (number | null)[] => places.map(([x, y], i) => {
    const here = run.track.at(at[i]!);
    return Math.hypot(x - here.x, y - here.y);
  });
  const time = Array.from(times);
  const uncertainty: Series["lines"][number] = { name: "2 \u03c3", colour: "belief", values: all.map((one) => 2 * ellipseOf(one).major) };
  const settled = run.log.has(topic.trajectory);
  const beside: Series = settled && wasMoved(run)
    ? { title: "Off the way as settled", unit: "m", time, lines: [{ name: "belief", colour: "failed", values: off(times, all.map(({ pose: [x, y] }): Vec2 => [x, y])) }, uncertainty] }
    : { title: "Uncertainty of the pose", unit: "m", time, lines: [uncertainty] };
  const reference = referenceOf(run);
  if (reference.places.length === time.length) beside.lines.push({ name: "reference off the way", colour: "reached", values: off(times, reference.places) });
  const odometry = odometryOf(run);
  const alone: Series[] = odometry.places.length > 0 ? [{ title: settled ? "Odometry alone, off the way as settled" : "Odometry alone, off the belief", unit: "m",
    time: Array.from(odometry.times), lines: [{ name: "odometry", colour: "waiting", values: off(odometry.times, odometry.places) }] }] : [];
  return [beside, ...alone, ...knownSeries(run)];
}

/** Landmarks in the map and loops closed, over time. */
function knownSeries(run: Run): Series[] {
  const kinds = [
    { name: "landmarks", colour: "reached" as const, times: landmarksAt(run, Infinity).map((one) => one.first_seen) },
    { name: "loops closed", colour: "open" as const, times: loopsAt(run, Infinity).map((one) => one.closed) }].filter((one) => one.times.length > 0);
  if (kinds.length === 0) return [];
  const time = [...new Set([0, ...kinds.flatMap((one) => one.times), run.duration])].sort((a, b) => a - b);
  return [{ title: "Known", unit: "", time, lines: kinds.map(({ name, colour, times }) => {
    const sorted = [...times].sort((a, b) => a - b);
    let count = 0;
    const values = time.map((t) => {
      while (count < sorted.length && sorted[count]! <= t) ++count;
      return count;
    });
    return { name, colour, values, steps: true };
  }) }];
}
