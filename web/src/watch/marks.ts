// What stands on the timeline: shots, and every event that is no part of a shot.
import { finite } from "../base/numbers";
import type { Flight, Run } from "../report/run";

export interface Mark {
  t: number;
  kind: string;
  title: string;
  shot?: Flight;
}

const ofShots = new Set(["shot", "hit", "miss"]);

export function marksOf(run: Run): Mark[] {
  const shots: Mark[] = run.flights.map((shot) => ({ t: shot.start, kind: shot.hit ? "hit" : "miss", shot,
    title: `Shot ${shot.index + 1} at ${shot.target}: ${shot.hit ? "hit" : `touched ${shot.contact || "nothing"}`}` }));
  const events: Mark[] = run.report.events
    .filter((event) => shots.length === 0 || !ofShots.has(event.kind))
    .map((event) => ({ t: finite(event.time_s), kind: event.kind, title: event.text }));
  return [...shots, ...events].sort((a, b) => a.t - b.t);
}
