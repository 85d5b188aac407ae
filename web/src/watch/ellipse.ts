// What a robot believed of its pose at an instant, and the ellipse of its uncertainty.
import { mix, wrapped } from "../base/numbers";
import type { Run } from "../report/run";
import { lastNotAfter } from "../report/track";
import type { Belief } from "../report/types";

export interface Ellipse { major: number; minor: number; angle: number }

/** Ellipses are drawn at two standard deviations: 86 % of a plane's normal distribution. */
export const deviations = 2;

/** Axes of one standard deviation, m, and the direction of the larger. */
export function ellipseOf({ sigma_x_m: a, sigma_y_m: b, correlation }: Pick<Belief, "sigma_x_m" | "sigma_y_m" | "correlation">): Ellipse {
  const [xx, yy, xy] = [a * a, b * b, correlation * a * b];
  const middle = (xx + yy) / 2;
  const away = Math.hypot((xx - yy) / 2, xy);
  return { major: Math.sqrt(middle + away), minor: Math.sqrt(Math.max(0, middle - away)), angle: 0.5 * Math.atan2(2 * xy, xx - yy) };
}

/** How many times ellipses are enlarged, so that they can be seen: ten where most are small beside the robot. */
export function enlargement(beliefs: Belief[], radius: number): number {
  const sizes = Float64Array.from(beliefs, (one) => deviations * ellipseOf(one).major).sort();
  return (sizes[sizes.length >> 1] ?? 0) < 0.3 * radius ? 10 : 1;
}

const known = new WeakMap<Run, Beliefs>();

/** Beliefs of a run over its time. Between two of them the pose is linear, so that a ghost does not lag behind. */
export class Beliefs {
  readonly all: Belief[];
  readonly enlarged: number;
  private times: Float64Array;

  static of(run: Run): Beliefs {
    if (!known.has(run)) known.set(run, new Beliefs(run));
    return known.get(run)!;
  }

  constructor(private run: Run) {
    this.all = (run.report.drive ?? run.report.explore ?? run.report.slam)?.beliefs ?? [];
    this.times = Float64Array.from(this.all, (one) => one.time_s);
    this.enlarged = enlargement(this.all, run.report.robot.radius_m ?? 0);
  }

  /** The last one not after t; -1 before the first. O(log n). */
  index(t: number): number {
    return this.all.length === 0 || this.times[0]! > t ? -1 : lastNotAfter(this.times, t);
  }

  /** Null before the first, and once there are no more. */
  at(t: number): Belief | null {
    const low = this.all[this.index(t)];
    if (!low || t > this.run.believedUntil) return null;
    const high = this.all[this.index(t) + 1];
    if (!high) return low;
    const share = (t - low.time_s) / Math.max(1e-9, high.time_s - low.time_s);
    const [x, y, heading] = low.pose;
    const [hx, hy, then] = high.pose;
    return { ...low, time_s: t, pose: [mix(x, hx, share), mix(y, hy, share), heading + share * wrapped(then - heading)] };
  }
}
