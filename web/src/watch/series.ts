// What can be plotted of a run.
import { finite } from "../base/numbers";
import type { Colour } from "../base/theme";
import type { Run } from "../report/run";
import { coverSeries } from "./cover_series";
import { Discovery } from "./explore_layer";
import { ellipseOf } from "./ellipse";
import type { Series } from "./plotted";
import { slamSeries } from "./slam_series";

/** Speed along the track between each row and the next, m/s. */
export function speedOf(run: Run): Series | null {
  const { track } = run;
  if (track.length < 3 || run.report.slam) return null;  // times of a log may be made up
  const time = Array.from(track.time);
  const values = time.map((_, i) => {
    const next = Math.min(i + 1, track.length - 1);
    const before = Math.max(0, next - 1);
    const span = time[next]! - time[before]!;
    return span > 0 ? Math.hypot(track.x[next]! - track.x[before]!, track.y[next]! - track.y[before]!) / span : 0;
  });
  return { title: "Speed", unit: "m/s", time, lines: [{ name: "robot", colour: "robot", values, steps: true }] };
}

function targetsOf(run: Run): Series | null {
  if (run.report.targets.length === 0) return null;
  const times = [...new Set([0, ...run.report.targets.map((one) => run.doneAt(one)), run.duration])].sort((a, b) => a - b);
  const count = (status: string) => times.map((t) => run.report.targets.filter((one) => run.status(one, t) === status).length);
  return { title: "Targets", unit: "", time: times, lines: [
    { name: "reached", colour: "reached", values: count("reached"), steps: true },
    { name: "waiting", colour: "waiting", values: count("waiting"), steps: true }] };
}

function suppliesOf(run: Run): Series[] {
  const { supplies } = run.report;
  if (!supplies) return [];
  const time = supplies.levels.map((row) => finite(row[0]));
  const made = (title: string, unit: string, column: number, colour: Colour, full: number | null): Series[] =>
    (Number.isFinite(full) ? [{ title, unit, time, lines: [{ name: title.toLowerCase(), colour, values: supplies.levels.map((row) => row[column] ?? null) }] }] : []);
  return [...made("Water", "", 1, "water", supplies.tank), ...made("Charge", "J", 2, "robot", supplies.battery_j)];
}

/** How far the belief is from the truth, and its own uncertainty. */
function beliefOf(run: Run): Series | null {
  const beliefs = ((run.report.drive ?? run.report.explore)?.beliefs ?? []).filter(({ time_s }) => time_s <= run.track.end);
  if (beliefs.length < 2) return null;
  const off = beliefs.map(({ time_s, pose }) => {
    const at = run.track.at(time_s);
    return 1000 * Math.hypot(pose[0] - at.x, pose[1] - at.y);
  });
  return { title: "Belief", unit: "mm", time: beliefs.map((one) => one.time_s), lines: [
    { name: "off the truth", colour: "failed", values: off },
    { name: "2 \u03c3", colour: "belief", values: beliefs.map((one) => 2000 * ellipseOf(one).major) }] };
}

function pursuitOf(run: Run): Series | null {
  const { pursuit } = run.report;
  if (!pursuit) return null;
  const time = pursuit.paid.map((_, s) => s);
  const held = (column: number) => time.map((t) => pursuit.bounds.findLast((row) => finite(row[0]) <= t)?.[column] ?? null);
  return { title: "Cost", unit: "", time, lines: [
    { name: "paid", colour: "robot", values: pursuit.paid },
    { name: "best catch known", colour: "failed", values: held(2), steps: true },
    { name: "lower bound", colour: "reached", values: held(3), steps: true }] };
}

/** What planning knew after so many expansions, of a pursuit that was planned step by step. */
function planningOf(run: Run): Series | null {
  const rows = (run.report.pursuit?.bounds ?? []).filter((row) => Number.isFinite(row[1]))
    .sort((a, b) => finite(a[1]) - finite(b[1])).filter((row, i, all) => row[1] !== all[i + 1]?.[1]);
  if (rows.length < 2) return null;
  const column = (k: number): (number | null)[] => rows.map((row) => row[k] ?? null);
  return { title: "What planning knew", unit: "", along: "expansions", time: column(1).map((value) => finite(value)), lines: [
    { name: "best catch known", colour: "failed", values: column(2), steps: true },
    { name: "lower bound", colour: "reached", values: column(3), steps: true }] };
}

function knownOf(run: Run): Series | null {
  const { explore, slam } = run.report;
  const map = explore?.map ?? slam?.map;
  if (!map) return null;
  const discovery = new Discovery(map);
  const time = Array.from({ length: 201 }, (_, i) => (run.duration * i) / 200);
  const area = map.cell_m ** 2;
  return { title: "Area known", unit: "m\u00b2", time, lines: [
    { name: "known", colour: "water", values: time.map((t) => discovery.knownAt(t) * area) }] };
}

export function seriesOf(run: Run): Series[] {
  return [knownOf(run), ...coverSeries(run), pursuitOf(run), planningOf(run), targetsOf(run), beliefOf(run), ...suppliesOf(run), ...slamSeries(run), speedOf(run)]
    .filter((one): one is Series => one !== null);
}
