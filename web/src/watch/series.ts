// Series that can be plotted of a run.
import type { Colour } from "../base/theme";
import { beliefsOf } from "../log/beliefs";
import { knownArea } from "../log/map";
import type { StoreLevels, Supplies } from "../log/messages";
import { pursuitOf } from "../log/pursuit";
import type { Run } from "../log/run";
import { indexAt } from "../log/run_log";
import { targetsOf } from "../log/targets";
import { topic } from "../log/topics";
import { coverSeries } from "./cover_series";
import { ellipseOf } from "./ellipse";
import { mappingSeries } from "./mapping_series";
import type { Series } from "./plotted";

const orNull = (value: number | undefined): number | null => (Number.isFinite(value) ? value! : null);

/** Speed along the true path between each pose and the next, m/s. Pursuers go by cells, and times of a recording may be made up. */
export function speedOf(run: Run): Series[] {
  const { track } = run;
  if (track.length < 3 || !run.hasTruth || run.log.has(topic.costGrid)) return [];
  const time = Array.from(track.time);
  const values = time.map((_, i) => {
    const next = Math.min(i + 1, track.length - 1);
    const before = Math.max(0, next - 1);
    const span = time[next]! - time[before]!;
    return span > 0 ? Math.hypot(track.x[next]! - track.x[before]!, track.y[next]! - track.y[before]!) / span : 0;
  });
  return [{ title: "Speed", unit: "m/s", time, lines: [{ name: "robot", colour: "robot", values, steps: true }] }];
}

function targetSeries(run: Run): Series[] {
  const targets = targetsOf(run);
  if (targets.length === 0) return [];
  const times = [...new Set([0, ...targets.flatMap((one) => one.changes), run.duration])].sort((a, b) => a - b);
  const count = (status: string) => times.map((t) => targets.filter((one) => one.statusAt(t) === status).length);
  return [{ title: "Targets", unit: "", time: times, lines: [
    { name: "reached", colour: "reached", values: count("reached"), steps: true },
    { name: "waiting", colour: "waiting", values: count("waiting"), steps: true }] }];
}

function supplySeries({ log }: Run): Series[] {
  const supplies = log.latest<Supplies>(topic.supplies);
  if (!supplies) return [];
  const levels = log.messages<StoreLevels>(topic.stores);
  const made = (title: string, unit: string, key: keyof StoreLevels, colour: Colour, full: number): Series[] =>
    (Number.isFinite(full) ? [{ title, unit, time: levels.map(({ t }) => t), lines: [{ name: title.toLowerCase(), colour, values: levels.map(({ message }) => orNull(message[key])) }] }] : []);
  return [...made("Water", "", "water", "water", supplies.tank), ...made("Charge", "J", "charge", "robot", supplies.battery)];
}

/** How far the belief is from the truth, and its own uncertainty. */
function beliefSeries(run: Run): Series[] {
  const beliefs = beliefsOf(run).all.filter(({ t }) => t <= run.track.end);
  if (beliefs.length < 2 || !run.hasTruth) return [];
  const off = beliefs.map(({ t, pose }) => {
    const at = run.track.at(t);
    return 1000 * Math.hypot(pose[0] - at.x, pose[1] - at.y);
  });
  return [{ title: "Belief", unit: "mm", time: beliefs.map((one) => one.t), lines: [
    { name: "off the truth", colour: "failed", values: off },
    { name: "2 \u03c3", colour: "belief", values: beliefs.map((one) => 2000 * ellipseOf(one).major) }] }];
}

function pursuitSeries(run: Run): Series[] {
  const pursuit = pursuitOf(run);
  if (!pursuit) return [];
  const time = pursuit.paid.map(({ t }) => t);
  const held = (key: "cost" | "lower_bound") => time.map((t) => orNull(pursuit.bounds[indexAt(pursuit.bounds, t)]?.[key]));
  return [{ title: "Cost", unit: "", time, lines: [
    { name: "paid", colour: "robot", values: pursuit.paid.map(({ paid }) => paid), steps: true },
    { name: "best catch known", colour: "failed", values: held("cost"), steps: true },
    { name: "lower bound", colour: "reached", values: held("lower_bound"), steps: true }] }];
}

/** Returns the knowledge of planning after so many expansions, of a pursuit that was planned step by step. */
function planningSeries(run: Run): Series[] {
  const rows = (pursuitOf(run)?.bounds ?? []).filter(({ expansions }) => Number.isFinite(expansions))
    .sort((a, b) => a.expansions - b.expansions).filter((row, i, all) => row.expansions !== all[i + 1]?.expansions);
  if (rows.length < 2) return [];
  return [{ title: "What planning knew", unit: "", along: "expansions", time: rows.map(({ expansions }) => expansions), lines: [
    { name: "best catch known", colour: "failed", values: rows.map(({ cost }) => orNull(cost)), steps: true },
    { name: "lower bound", colour: "reached", values: rows.map((row) => orNull(row.lower_bound)), steps: true }] }];
}

function knownSeries({ log }: Run): Series[] {
  const { time, area } = knownArea(log);
  return time.length > 0 ? [{ title: "Area known", unit: "m\u00b2", time, lines: [{ name: "known", colour: "water", values: area, steps: true }] }] : [];
}

export function seriesOf(run: Run): Series[] {
  return [knownSeries, coverSeries, pursuitSeries, planningSeries, targetSeries, beliefSeries, supplySeries, mappingSeries, speedOf].flatMap((made) => made(run));
}
