// Marks on the timeline: shots, and every event that is no part of a shot.
import { flightsOf, type Flight } from "../log/flights";
import type { Run } from "../log/run";

export interface Mark {
  t: number;
  kind: string;
  title: string;
  shot?: Flight;
}

const ofShots = new Set(["shot", "hit", "miss"]);

export function marksOf(run: Run): Mark[] {
  const shots: Mark[] = flightsOf(run).map((shot) => ({ t: shot.start, kind: shot.hit ? "hit" : "miss", shot,
    title: `Shot ${shot.index + 1} at ${shot.target}: ${shot.hit ? "hit" : `touched ${shot.contact || "nothing"}`}` }));
  const events: Mark[] = run.events
    .filter(({ message }) => shots.length === 0 || !ofShots.has(message.name))
    .map(({ t, message }) => ({ t, kind: message.name, title: message.msg }));
  return [...shots, ...events].sort((a, b) => a.t - b.t);
}
