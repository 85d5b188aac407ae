// Time of a view: play, pause, speed, seek, step from mark to mark. No DOM: the timeline shows it.
import { clamp } from "../base/numbers";

export const speeds = [0.25, 0.5, 1, 2, 4, 8, 16, 32, 64];

export class Clock {
  t = 0;
  playing = false;
  speed: number;

  constructor(readonly duration: number, private changed: () => void) {
    // The whole run in a minute or so.
    this.speed = 2 ** clamp(Math.round(Math.log2(duration / 45)), 0, 6);
  }

  seek(t: number): void {
    this.t = clamp(t, 0, this.duration);
    this.changed();
  }

  toggle(on = !this.playing): void {
    this.playing = on;
    if (on && this.t >= this.duration - 1e-9) this.t = 0;
    this.changed();
  }

  /** The next speed, up or down. */
  shift(direction: 1 | -1): void {
    const index = speeds.findIndex((one) => one >= this.speed);
    this.speed = speeds[clamp(index + direction, 0, speeds.length - 1)]!;
    this.changed();
  }

  /** Moves time on by `elapsed` seconds of the wall clock; a pause of the browser is no leap. */
  advance(elapsed: number): void {
    if (!this.playing) return;
    this.t = Math.min(this.duration, this.t + clamp(elapsed, 0, 0.1) * this.speed);
    if (this.t >= this.duration) this.toggle(false);
  }
}

/** The mark after or before t, of marks in the order of time. */
export function neighbour<M extends { t: number }>(marks: M[], t: number, direction: 1 | -1): M | undefined {
  return direction > 0 ? marks.find((mark) => mark.t > t + 1e-6) : marks.findLast((mark) => mark.t < t - 1e-6);
}
