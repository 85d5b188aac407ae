// The motion of the robot: poses at times, linear between two of them, angles the shorter way; and the joints of its gun.
import { clamp, mix } from "../base/numbers";
import { poseOf, type Pose } from "./geometry";
import type { JointState, Odometry, Path, PoseStamped, PoseWithCovarianceStamped } from "./messages";
import type { RunLog } from "./run_log";
import { topic } from "./topics";

export interface State { x: number; y: number; heading: number; yaw: number; pitch: number }

/** The last index of an ascending column whose value is not after t; 0 before all. O(log n). */
export function lastNotAfter(column: ArrayLike<number>, t: number): number {
  let low = 0;
  let high = column.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (column[middle]! <= t) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** Adds turns so that neighbours differ by at most half a turn. */
export function unwrap(angles: Float64Array): Float64Array {
  for (let i = 1; i < angles.length; ++i) {
    angles[i]! -= 2 * Math.PI * Math.round((angles[i]! - angles[i - 1]!) / (2 * Math.PI));
  }
  return angles;
}

/** A time between two rows: the indices of both, and the share of the way to the second. */
interface Between { low: number; next: number; share: number }

export function between(time: ArrayLike<number>, t: number): Between {
  const low = lastNotAfter(time, t);
  const next = Math.min(low + 1, time.length - 1);
  const span = time[next]! - time[low]!;
  return { low, next, share: span > 0 ? clamp((t - time[low]!) / span, 0, 1) : 0 };
}

const value = (column: Float64Array, { low, next, share }: Between): number => mix(column[low]!, column[next]!, share);

/** Poses at times; as many as there are times. */
export interface TimedPoses { time: number[]; poses: Pose[] }
/** Yaw (from where the robot looks) and pitch of the gun at times. */
export interface TimedGun { time: number[]; yaw: number[]; pitch: number[] }

export class Track {
  readonly time: Float64Array;
  readonly x: Float64Array;
  readonly y: Float64Array;
  readonly heading: Float64Array;
  private gunTime: Float64Array;
  private yaw: Float64Array;
  private pitch: Float64Array;

  constructor({ time, poses }: TimedPoses, gun: TimedGun = { time: [], yaw: [], pitch: [] }) {
    this.time = Float64Array.from(time);
    this.x = Float64Array.from(poses, (pose) => pose[0]);
    this.y = Float64Array.from(poses, (pose) => pose[1]);
    this.heading = unwrap(Float64Array.from(poses, (pose) => pose[2]));
    this.gunTime = Float64Array.from(gun.time);
    this.yaw = unwrap(Float64Array.from(gun.yaw));
    this.pitch = Float64Array.from(gun.pitch);
  }

  get length(): number { return this.time.length; }
  get end(): number { return this.time[this.length - 1] ?? 0; }

  /** Before the gun moves it looks ahead. A run without poses stands at the origin. */
  at(t: number): State {
    if (this.length === 0) return { x: 0, y: 0, heading: 0, yaw: 0, pitch: 0 };
    const here = between(this.time, t);
    const heading = value(this.heading, here);
    const state: State = { x: value(this.x, here), y: value(this.y, here), heading, yaw: heading, pitch: 0 };
    if (this.gunTime.length === 0 || t < this.gunTime[0]!) return state;
    const gun = between(this.gunTime, t);
    state.yaw = heading + value(this.yaw, gun);
    state.pitch = value(this.pitch, gun);
    return state;
  }
}

const secondsOf = ({ header: { stamp } }: PoseStamped): number => stamp.sec + 1e-9 * stamp.nanosec;

/** The poses on a topic of poses. */
export function posesOn(log: RunLog, name: string): TimedPoses {
  const all = log.messages<PoseStamped>(name);
  return { time: all.map(({ t }) => t), poses: all.map(({ message }) => poseOf(message.pose)) };
}

/** The poses to draw: the true ones; else the path as it was settled, what was believed, or odometry. */
export function posesOf(log: RunLog): TimedPoses {
  const from = <T>(name: string, pose: (message: T) => PoseStamped["pose"]): TimedPoses => {
    const all = log.messages<T>(name);
    return { time: all.map(({ t }) => t), poses: all.map(({ message }) => poseOf(pose(message))) };
  };
  if (log.has(topic.pose)) return posesOn(log, topic.pose);
  const settled = log.latest<Path>(topic.trajectory)?.poses ?? [];
  if (settled.length > 0) return { time: settled.map(secondsOf), poses: settled.map(({ pose }) => poseOf(pose)) };
  if (log.has(topic.belief)) return from<PoseWithCovarianceStamped>(topic.belief, ({ pose }) => pose.pose);
  return from<Odometry>(topic.odometry, ({ pose }) => pose.pose);
}

export function gunOf(log: RunLog, name: string = topic.joints): TimedGun {
  const all = log.messages<JointState>(name).flatMap(({ t, message: { name: joints, position } }) => {
    const [yaw, pitch] = [position[joints.indexOf("gun_yaw")], position[joints.indexOf("gun_pitch")]];
    return yaw === undefined || pitch === undefined ? [] : [{ t, yaw, pitch }];
  });
  return { time: all.map(({ t }) => t), yaw: all.map(({ yaw }) => yaw), pitch: all.map(({ pitch }) => pitch) };
}
