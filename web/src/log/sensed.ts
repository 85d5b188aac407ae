// The newest observations of the robot: the scan of its range finder or its sightings of landmarks, placed in the map.
import { headingOf, placedAt, vec2, type Pose, type Vec2 } from "./geometry";
import { beliefsOf } from "./beliefs";
import type { LaserScan, Sightings, TFMessage } from "./messages";
import { once } from "./once";
import type { Run } from "./run";
import type { Stamped } from "./run_log";
import { topic } from "./topics";

const mostBeams = 360;  // enough to be seen as such

export interface Sensed {
  isLaser: boolean;
  from: Vec2;
  /** Places where something was met. */
  points: Vec2[];
  /** Ends of all beams, which are the longest that are measured where nothing was met; empty of sightings. */
  ends: Vec2[];
}

/** The mount of a device on the robot: its pose, and its height above the floor. */
export interface Mount { pose: Pose; height: number }

export function mountOf({ log }: Run, frame: string): Mount {
  const all = log.messages<TFMessage>(topic.staticTransforms).flatMap(({ message }) => message.transforms);
  const found = all.findLast((one) => one.child_frame_id === frame)?.transform;
  return found ? { pose: [found.translation.x, found.translation.y, headingOf(found.rotation)], height: found.translation.z } : { pose: [0, 0, 0], height: 0 };
}

export const laserMount = once((run: Run): Mount => mountOf(run, "laser"));

/** Returns the pose of the robot then: the true one if that is known, else as the map of that time has it. */
function poseAt(run: Run, t: number): Pose {
  const believed = run.hasTruth ? null : beliefsOf(run).at(t)?.pose;
  if (believed) return believed;
  const { x, y, heading } = run.track.at(t);
  return [x, y, heading];
}

function ofScan(robot: Pose, mount: Pose, { angle_min, angle_increment, range_min, range_max, ranges }: LaserScan): Sensed {
  const sensed: Sensed = { isLaser: true, from: placedAt(robot, [mount[0], mount[1]]), points: [], ends: [] };
  const laser: Pose = [...sensed.from, robot[2] + mount[2]];
  const every = Math.max(1, Math.ceil(ranges.length / mostBeams));
  for (let i = 0; i < ranges.length; i += every) {
    const angle = angle_min + angle_increment * i;
    const met = ranges[i]! >= range_min && ranges[i]! <= range_max;
    const range = met ? ranges[i]! : range_max;
    const end = placedAt(laser, [range * Math.cos(angle), range * Math.sin(angle)]);
    sensed.ends.push(end);
    if (met && ranges[i]! < 0.999 * range_max) sensed.points.push(end);
  }
  return sensed;
}

class Senses {
  private shown: { key: unknown; sensed: Sensed } | null = null;

  constructor(private run: Run) {}

  /** The newest that is not after t; null before the first, and once there is nothing to map any more. */
  at(t: number): Sensed | null {
    const { run } = this;
    if (t > run.believedUntil) return null;
    const scan = run.log.at<LaserScan>(topic.scan, t);
    if (scan === null) return this.shown?.sensed ?? null;  // it is being read
    const seen = scan ? undefined : run.log.at<Sightings>(topic.sightings, t);
    const newest = scan ?? seen;
    if (!newest) return null;
    if (this.shown?.key !== newest) this.shown = { key: newest, sensed: scan ? this.placed(scan) : this.sightings(seen!) };
    return this.shown!.sensed;
  }

  private placed({ t, message }: Stamped<LaserScan>): Sensed { return ofScan(poseAt(this.run, t), laserMount(this.run).pose, message); }

  private sightings({ t, message }: Stamped<Sightings>): Sensed {
    const pose = poseAt(this.run, t);
    return { isLaser: false, from: [pose[0], pose[1]], points: message.points.map((point) => placedAt(pose, vec2(point))), ends: [] };
  }
}

export const sensesOf = once((run: Run) => new Senses(run));
export const hasSenses = ({ log }: Run): boolean => log.has(topic.scan) || log.has(topic.sightings);
