// The values of a plot, over the time or over something else: columns of one length with their names and colours.
import { mix } from "../base/numbers";
import type { Colour } from "../base/theme";
import { between } from "../log/track";

export interface Line {
  name: string;
  colour: Colour;
  values: (number | null)[];
  /** A value holds until the next one. Without it, values are linear between two. */
  steps?: boolean;
}

export interface Series {
  title: string;
  unit: string;
  /** The quantity along the axis, if that is not the time. */
  along?: string;
  time: number[];
  lines: Line[];
  /** The key by which it was chosen, if somebody did. */
  key?: string;
}

/** The value of a line at t, where the line is drawn: no step tells what comes later. Null before the first value. O(log n). */
export function valueAt(time: number[], { values, steps }: Line, t: number): number | null {
  if (time.length === 0 || t < time[0]!) return null;
  const { low, next, share } = between(time, t);
  const [a, b] = [values[low] ?? null, values[next] ?? null];
  return steps || a === null || b === null ? a : mix(a, b, share);
}
