// Poses that the robot believed to have, with their uncertainty.
import { mix, wrapped } from "../base/numbers";
import { poseOf, type Pose } from "./geometry";
import type { PoseWithCovarianceStamped } from "./messages";
import { once } from "./once";
import type { Run } from "./run";
import { topic } from "./topics";
import { lastNotAfter } from "./track";

export interface Uncertainty { sigma_x: number; sigma_y: number; correlation: number }
export interface Belief extends Uncertainty {
  t: number;
  pose: Pose;
  sigma_heading: number;
  /** Something that was observed corrected it since the belief before. */
  corrected: boolean;
}

/** After the last belief it holds for so long. A yard that is explored is then guarded by other means. */
const holds_s = 1.5;

export class Beliefs {
  readonly times: Float64Array;
  constructor(readonly all: Belief[]) {
    this.times = Float64Array.from(all, ({ t }) => t);
  }

  /** Until then the robot went by what it believed. */
  get until(): number { return this.all.length > 0 ? this.times.at(-1)! + holds_s : -Infinity; }

  /** The last one not after t; -1 before the first. O(log n). */
  index(t: number): number {
    return this.all.length === 0 || this.times[0]! > t ? -1 : lastNotAfter(this.times, t);
  }

  /** Linear between two beliefs, so that a ghost does not lag behind; null before the first, and once there are no more. */
  at(t: number): Belief | null {
    const low = this.all[this.index(t)];
    if (!low || t > this.until) return null;
    const high = this.all[this.index(t) + 1];
    if (!high) return low;
    const share = (t - low.t) / Math.max(1e-9, high.t - low.t);
    const [x, y, heading] = low.pose;
    const [hx, hy, then] = high.pose;
    return { ...low, t, pose: [mix(x, hx, share), mix(y, hy, share), heading + share * wrapped(then - heading)] };
  }
}

function beliefOf(t: number, { pose: { pose, covariance } }: PoseWithCovarianceStamped, corrected: boolean): Belief {
  const sigma = (k: number): number => Math.sqrt(Math.max(0, covariance[k] ?? 0));
  const [x, y] = [sigma(0), sigma(7)];
  const correlation = x * y > 0 ? Math.min(1, Math.max(-1, covariance[1]! / (x * y))) : 0;
  return { t, pose: poseOf(pose), sigma_x: x, sigma_y: y, correlation, sigma_heading: sigma(35), corrected };
}

export const beliefsOf = once(({ log }: Run): Beliefs => {
  const corrections = new Set(log.messages(topic.corrections).map(({ t }) => t));
  return new Beliefs(log.messages<PoseWithCovarianceStamped>(topic.belief).map(({ t, message }) => beliefOf(t, message, corrections.has(t))));
});
