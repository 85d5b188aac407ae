// The motion of the robot: columns of the track, linear between two rows, angles the shorter way.
import { clamp, finite, mix } from "../base/numbers";
import type { Num } from "./types";

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

/** Index of the value of an ascending column that is closest to t. */
export function nearest(column: ArrayLike<number>, t: number): number {
  let low = 0;
  let high = column.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (column[middle]! <= t) low = middle;
    else high = middle;
  }
  return t - column[low]! <= column[high]! - t ? low : high;
}

/** One column of the rows, with 0 for unknown values. A loop, because it is by far the fastest method. */
function column(rows: Num[][], k: number): Float64Array {
  const values = new Float64Array(rows.length);
  for (let i = 0; i < rows.length; ++i) values[i] = finite(rows[i]![k]);
  return values;
}

/** Adds turns so that neighbours differ by at most half a turn. */
export function unwrap(angles: Float64Array): Float64Array {
  for (let i = 1; i < angles.length; ++i) {
    angles[i]! -= 2 * Math.PI * Math.round((angles[i]! - angles[i - 1]!) / (2 * Math.PI));
  }
  return angles;
}

export class Track {
  readonly time: Float64Array;
  readonly x: Float64Array;
  readonly y: Float64Array;
  readonly heading: Float64Array;
  readonly yaw: Float64Array;
  readonly pitch: Float64Array;

  constructor(rows: Num[][], start: Num[]) {
    const used = rows.length > 0 ? rows : [[0, start[0] ?? 0, start[1] ?? 0, start[2] ?? 0, start[2] ?? 0, 0]];
    this.time = column(used, 0);
    this.x = column(used, 1);
    this.y = column(used, 2);
    this.heading = unwrap(column(used, 3));
    this.yaw = unwrap(column(used, 4));
    this.pitch = column(used, 5);
  }

  get length(): number { return this.time.length; }
  get end(): number { return this.time[this.length - 1]!; }

  at(t: number): State {
    const low = lastNotAfter(this.time, t);
    const next = Math.min(low + 1, this.length - 1);
    const span = this.time[next]! - this.time[low]!;
    const share = span > 0 ? clamp((t - this.time[low]!) / span, 0, 1) : 0;
    const value = (column: Float64Array): number => mix(column[low]!, column[next]!, share);
    return { x: value(this.x), y: value(this.y), heading: value(this.heading), yaw: value(this.yaw), pitch: value(this.pitch) };
  }
}
