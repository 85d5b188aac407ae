// The ellipse of an uncertainty, as it is drawn.
import { beliefsOf, type Belief, type Uncertainty } from "../log/beliefs";
import { once } from "../log/once";
import type { Run } from "../log/run";

export interface Ellipse { major: number; minor: number; angle: number }

/** Ellipses are drawn at two standard deviations: 86 % of a plane's normal distribution. */
export const deviations = 2;

/** Axes of one standard deviation, m, and the direction of the larger. */
export function ellipseOf({ sigma_x: a, sigma_y: b, correlation }: Uncertainty): Ellipse {
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

export const enlargedOf = once((run: Run): number => enlargement(beliefsOf(run).all, run.radius));
