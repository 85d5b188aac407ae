// Why the run went as it did, from its log: which stop serves whom and what the bound says of the tour, what each decision of an
// exploration had to choose from, how the bound of a pursuit closed in.
import { clockText, figures, finite, fixed } from "../base/numbers";
import { typeset } from "../base/typeset";
import { flightsOf } from "../log/flights";
import type { Decision } from "../log/messages";
import { refusalsOf } from "../log/plans";
import { pursuitOf } from "../log/pursuit";
import type { Run } from "../log/run";
import { indexAt } from "../log/run_log";
import { targetsOf } from "../log/targets";
import { topic } from "../log/topics";
import { isPlanning, tourOf } from "../log/tours";

/** The choices that there were, the best first. */
export interface Choices { head: string[]; rows: { cells: string[]; chosen: boolean }[] }
/** A sentence, with the time it is about where it is about one. */
export interface Reason { t?: number; head: string; text: string; table?: Choices }
export interface Reasons { title: string; about: string; rows: Reason[] }

/** Shots from one place, one after another, are one stop; those from one drive are together too. */
const together_m = 0.05;

interface Stop { t: number; end: number; x: number; y: number; driving: boolean; hit: string[]; missed: string[] }

export function stopsOf(run: Run): Stop[] {
  const stops: Stop[] = [];
  for (const shot of flightsOf(run)) {
    const at = run.track.at(shot.start);
    let stop = stops.at(-1);
    const together = stop && stop.driving === shot.driving && (shot.driving || Math.hypot(stop.x - at.x, stop.y - at.y) <= together_m);
    if (!stop || !together) stops.push(stop = { t: shot.start, end: shot.end, x: at.x, y: at.y, driving: shot.driving, hit: [], missed: [] });
    stop.end = shot.end;
    (shot.hit ? stop.hit : stop.missed).push(shot.target);
  }
  return stops;
}

/** Returns the numbers of a plan, in words. */
function tourWords(numbers: Record<string, number | null>): string {
  const known = (name: string): number => finite(numbers[name], NaN);
  const [planned, bound, anywhere, offered] = [known("planned_s"), known("lower_bound_s"), known("anywhere_lower_bound_s"), known("stops_offered")];
  const among = offered > 0 ? ` among tours of ${offered.toLocaleString("en")} places to stop at` : "shots_in_passing" in numbers ? " of all missions, standing or on the move" : "";
  const proof = numbers.tour_proven ? `It is the fastest${among}.`
    : bound > 0 ? `None takes less than ${fixed(bound, 1)} s, so it is at most ${figures(100 * (planned / bound - 1))} % slower than the fastest${among}.` : "";
  return [Number.isFinite(planned) ? `The plan takes ${fixed(planned, 1)} s. ${proof}` : "", offered > 0 && Number.isFinite(anywhere) ? `Wherever it stopped, it would take at least ${fixed(anywhere, 1)} s.` : ""].filter(Boolean).join(" ");
}

/** The tour that is planned, until the first shot. */
function planReasons(run: Run): Reasons[] {
  const tour = tourOf(run);
  if (!tour || tour.stops.length === 0 || flightsOf(run).length > 0) return [];
  const proof = tour.bound <= 0 ? "" : tour.bound > tour.cost - 1e-6 ? ", and none is faster" : `, and none takes less than ${fixed(tour.bound, 1)} s`;
  const about = isPlanning(run) ? `The fastest so far takes ${fixed(tour.cost, 1)} s.` : `It takes ${fixed(tour.cost, 1)} s if nothing goes wrong${proof}.`;
  return [{ title: isPlanning(run) ? "The tour so far" : "The tour as planned", about, rows: tour.stops.map(({ at: [x, y], targets }, i): Reason =>
    ({ head: `Stop ${i + 1} at (${fixed(x, 2)}, ${fixed(y, 2)})`, text: targets.length > 0 ? `serves ${targets.join(", ")}` : "fills up" })) }];
}

function tourReasons(run: Run): Reasons[] {
  if (targetsOf(run).length === 0) return [];
  const about = run.log.summary ? tourWords(run.log.summary.metrics) : "";
  const all = stopsOf(run);
  const numbers = new Map(all.filter(({ driving }) => !driving).map((stop, i) => [stop, i + 1]));
  const placeOf = (stop: Stop): string => stop.driving ? "On the way" : `Stop ${numbers.get(stop)} at (${fixed(stop.x, 2)}, ${fixed(stop.y, 2)})`;
  const stops = all.map((stop): Reason => ({ t: stop.t, head: `${placeOf(stop)}, ${clockText(stop.t)} to ${clockText(stop.end)}`,
    text: [stop.hit.length > 0 ? `serves ${stop.hit.join(", ")}` : "", stop.missed.length > 0 ? `misses ${stop.missed.join(", ")}` : ""].filter(Boolean).join("; ") }));
  const left = targetsOf(run).filter(({ status }) => status === "unreachable" || status === "failed").map(({ name, last }): Reason => ({ head: `${name}: ${last.status}`, text: typeset(last.reason) }));
  return stops.length + left.length > 0 ? [{ title: "The tour", about, rows: [...stops, ...left] }] : [];
}

/** The places that a decision compared, with what each costs, shows and is worth. */
function choicesOf({ candidates, value_of, most_is_best }: Omit<Decision, "kind" | "frontiers">): { table?: Choices } {
  if (!candidates?.length) return {};
  const [first = "", ...rest] = value_of.split(" ");
  return { table: { head: ["", "place", "to get there", "to see", `${rest.join(" ") || "value"}, ${most_is_best ? "most" : "least"} is best`],
    rows: candidates.map(({ position: { x, y }, cost, gain, value, chosen }, i) => ({ chosen,
      cells: [String(i + 1), `(${fixed(x, 2)}, ${fixed(y, 2)})`, `${fixed(cost, 1)} s`, `${figures(gain)} m\u00b2`, Number.isFinite(value) ? typeset(`${figures(value)} ${first}`) : "\u2013"] })) } };
}

function explorationReasons(run: Run): Reasons[] {
  const decisions = run.log.messages<Decision>(topic.decisions);
  if (decisions.length === 0) return [];
  const goals = run.log.messages<{ pose: { position: { x: number; y: number } } }>(topic.goal);
  const rows = decisions.map(({ t, message: { kind, frontiers, ...more } }): Reason => {
    const goal = goals[indexAt(goals, t)]?.message.pose.position;
    const to = goal ? ` (${fixed(goal.x, 2)}, ${fixed(goal.y, 2)})` : "";
    return { t, head: `${clockText(t)} ${kind === "home" ? "goes home" : `to a frontier at${to}`}`, text: `${frontiers.toLocaleString("en")} ${frontiers === 1 ? "frontier was" : "frontiers were"} open`, ...choicesOf(more) };
  });
  const refused = refusalsOf(run).map(({ at: [x, y], reason }): Reason => ({ head: `left over at (${fixed(x, 2)}, ${fixed(y, 2)})`, text: typeset(reason) }));
  return [{ title: "Decisions", about: `${decisions.length.toLocaleString("en")} times it chose where to look next.`, rows: [...rows, ...refused] }];
}

function pursuitReasons(run: Run): Reasons[] {
  const bounds = pursuitOf(run)?.bounds ?? [];
  if (bounds.length === 0) return [];
  const rows = bounds.map(({ t, expansions, cost, lower_bound }): Reason => ({ t, head: `${clockText(t, 1)} after ${expansions.toLocaleString("en")} expansions`,
    text: Number.isFinite(cost) ? `a catch for ${figures(cost)} is known, none costs less than ${figures(lower_bound)}${cost <= lower_bound ? ": it is the best" : `: at most ${figures(100 * (cost / lower_bound - 1))} % above the best`}`
      : `no catch is known yet; none costs less than ${figures(lower_bound)}` }));
  return [{ title: "The bound closes in", about: "What planning knew, step by step.", rows }];
}

export const reasonsOf = (run: Run): Reasons[] => [planReasons, tourReasons, explorationReasons, pursuitReasons].flatMap((make) => make(run));
