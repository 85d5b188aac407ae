// What can be plotted of mapping from a log: how far belief, odometry and reference lie from the way as settled in the
// end, the belief's own uncertainty, and what the map had when.
import { finite } from "../base/numbers";
import type { Run } from "../report/run";
import type { Vec2 } from "../report/types";
import { ellipseOf } from "./ellipse";
import type { Series } from "./plotted";

export function slamSeries(run: Run): Series[] {
  const { slam } = run.report;
  if (!slam || slam.beliefs.length < 2) return [];
  const time = slam.beliefs.map((one) => one.time_s);
  const off = (places: Vec2[]): (number | null)[] => time.map((t, i) => {
    const at = run.track.at(t);
    const place = places[i];
    return place ? Math.hypot(place[0] - at.x, place[1] - at.y) : null;
  });
  const uncertainty: Series["lines"][number] = { name: "2 \u03c3", colour: "belief", values: slam.beliefs.map((one) => 2 * ellipseOf(one).major) };
  const settled = run.report.status !== "running";
  const beside: Series = settled && slam.engine !== "pose_graph"
    ? { title: "Off the way as settled", unit: "m", time, lines: [{ name: "belief", colour: "failed", values: off(slam.beliefs.map(({ pose: [x, y] }): Vec2 => [x, y])) }, uncertainty] }
    : { title: "Uncertainty of the pose", unit: "m", time, lines: [uncertainty] };
  if (slam.reference.length > 0) beside.lines.push({ name: "reference off the way", colour: "reached", values: off(slam.reference) });
  const all = [beside];
  if (slam.odometry.length > 0) {
    all.push({ title: settled ? "Odometry alone, off the way as settled" : "Odometry alone, off the belief", unit: "m", time, lines: [{ name: "odometry", colour: "waiting", values: off(slam.odometry) }] });
  }
  const known = knownSeries(run);
  return known ? [...all, known] : all;
}

/** Landmarks in the map and loops closed, over time. Of very many loops a report has some; its metrics count all. */
function knownSeries(run: Run): Series | null {
  const { slam, metrics } = run.report;
  const { landmarks, loops } = slam!;
  const loopsOfOne = Math.max(1, finite(metrics.loops, 0) / Math.max(1, loops.length));
  const kinds = [
    { name: "landmarks", colour: "reached" as const, each: 1, times: landmarks.map((one) => one.first_s) },
    { name: "loops closed", colour: "open" as const, each: loopsOfOne, times: loops.map((one) => one.time_s) }].filter((one) => one.times.length > 0);
  if (kinds.length === 0) return null;
  const time = [...new Set([0, ...kinds.flatMap((one) => one.times), run.duration])].sort((a, b) => a - b);
  return { title: "Known", unit: "", time, lines: kinds.map(({ name, colour, each, times }) => {
    const sorted = [...times].sort((a, b) => a - b);
    let count = 0;
    const values = time.map((t) => {
      while (count < sorted.length && sorted[count]! <= t) ++count;
      return Math.round(each * count);
    });
    return { name, colour, values, steps: true };
  }) };
}
