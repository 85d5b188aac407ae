// Mapping: landmarks and loops as they were known at a time, and where odometry alone, a reference and other robots went.
import { placesOf, vec2, type Vec2 } from "./geometry";
import type { Landmark, Landmarks, Loop, Loops, Odometry, Path } from "./messages";
import { once } from "./once";
import type { Run } from "./run";
import { indexAt } from "./run_log";
import { ofRobot, topic } from "./topics";

/** A line and when its places were reached. */
export interface TimedWay { times: Float64Array; places: Vec2[] }

/** The landmarks of the map at t. Maps are logged now and then: a landmark that came since is as the newest map has it. */
export function landmarksAt({ log }: Run, t: number): Landmark[] {
  const all = log.messages<Landmarks>(topic.landmarks);
  const then = all[indexAt(all, t)]?.message.landmarks ?? [];
  const known = new Set(then.map(({ id }) => id));
  return [...then, ...(all.at(-1)?.message.landmarks ?? []).filter(({ id, first_seen }) => first_seen <= t && !known.has(id))];
}

/** Returns the true places of landmarks, by their ids: known for good in the newest map. */
export const truePlaces = once(({ log }: Run): Map<bigint, Vec2> =>
  new Map((log.latest<Landmarks>(topic.landmarks)?.landmarks ?? []).filter(({ truth }) => Number.isFinite(truth.x)).map(({ id, truth }) => [id, vec2(truth)])));

/** The loops closed by then, at their places as known at t; where none were logged by then, as known in the end. */
export function loopsAt({ log }: Run, t: number): Loop[] {
  const all = log.messages<Loops>(topic.loops);
  const known = all[indexAt(all, t)]?.message ?? all.at(-1)?.message;
  return (known?.loops ?? []).filter(({ closed }) => closed <= t);
}

export const odometryOf = once(({ log }: Run): TimedWay => {
  const all = log.messages<Odometry>(topic.odometry);
  return { times: Float64Array.from(all, ({ t }) => t), places: all.map(({ message }) => vec2(message.pose.pose.position)) };
});

/** The reference has a pose for each pose of the track; else it is there from the beginning. */
export const referenceOf = once(({ log, track }: Run): TimedWay => {
  const places = placesOf(log.latest<Path>(topic.reference));
  return { places, times: places.length === track.length ? track.time : new Float64Array(places.length) };
});

/** The paths of all robots, where there are several. */
export const robotWays = once(({ log }: Run): TimedWay[] => {
  const wayOf = (name: string): TimedWay => {
    const path = log.latest<Path>(name);
    return { times: Float64Array.from(path?.poses ?? [], ({ header: { stamp } }) => stamp.sec + 1e-9 * stamp.nanosec), places: placesOf(path) };
  };
  const ways: TimedWay[] = [];
  for (let robot = 2; log.has(ofRobot(robot, topic.trajectory)); ++robot) ways.push(wayOf(ofRobot(robot, topic.trajectory)));
  return ways.length > 0 ? [wayOf(topic.trajectory), ...ways] : [];
});
