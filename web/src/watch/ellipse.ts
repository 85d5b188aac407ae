// The ellipse of a belief: where the position lies within so many standard deviations.
import type { Belief } from "../report/types";
import { lastNotAfter } from "../report/track";

export interface Ellipse { major: number; minor: number; angle: number }

/** Axes of one standard deviation, m, and the direction of the larger. */
export function ellipseOf({ sigma_x_m: a, sigma_y_m: b, correlation }: Pick<Belief, "sigma_x_m" | "sigma_y_m" | "correlation">): Ellipse {
  const [xx, yy, xy] = [a * a, b * b, correlation * a * b];
  const middle = (xx + yy) / 2;
  const away = Math.hypot((xx - yy) / 2, xy);
  return { major: Math.sqrt(middle + away), minor: Math.sqrt(Math.max(0, middle - away)), angle: 0.5 * Math.atan2(2 * xy, xx - yy) };
}

/** Finds the belief of an instant again and again: the last one not after it. */
export function beliefFinder(beliefs: Belief[]): (t: number) => number {
  const times = Float64Array.from(beliefs, (one) => one.time_s);
  return (t) => (beliefs.length === 0 || times[0]! > t ? -1 : lastNotAfter(times, t));
}
