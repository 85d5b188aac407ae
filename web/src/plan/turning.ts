// Headings set by pointer or keyboard.
import type { Vec2 } from "../base/outline";

/** The step between round angles: the pointer snaps to them, and the keyboard goes from one to the next. */
export const turn_step = Math.PI / 36;
const catch_rad = 0.02;

/** Wraps an angle to (-pi, pi]. */
export const wrapAngle = (angle: number): number => angle - 2 * Math.PI * Math.ceil(angle / (2 * Math.PI) - 0.5 - 1e-12);

/** Returns the heading from a middle to the pointer, snapped to a round angle nearby. */
export function headingTo(at: Vec2, [x, y]: Vec2): number {
  const angle = Math.atan2(at[1] - y, at[0] - x);
  const round = turn_step * Math.round(angle / turn_step);
  return Math.abs(angle - round) < catch_rad ? round : angle;
}

/** Returns the next round angle to the left (1) or right (-1). */
export function turned(heading: number, side: number): number {
  const steps = heading / turn_step;
  const next = side > 0 ? Math.floor(steps + 1e-6) + 1 : Math.ceil(steps - 1e-6) - 1;
  return wrapAngle(next * turn_step);
}
