// Time of a view: play, pause, speed, seek, step from mark to mark, keep to the head of a run that goes on. No DOM:
// the timeline shows it.
import { clamp } from "../base/numbers";

export const speeds = [0.25, 0.5, 1, 2, 4, 8, 16, 32, 64];
/** The head comes in leaps; time glides to it, and after so long has made most of the way. */
const glide_s = 0.2;

export class Clock {
  t = 0;
  playing = false;
  /** Keeps to the head. Ends with whatever goes elsewhere: a seek, a pause. */
  live = false;
  private chosen: number | null = null;
  private wanted = 0;  // the time asked for, which a run that goes on may not have reached

  /** `goesOn`: the run is not over, and its end is where it has come to. */
  constructor(public duration: number, private changed: () => void, public goesOn = false) {}

  /** Unless one was chosen: the whole run in a minute or so. */
  get speed(): number { return this.chosen ?? 2 ** clamp(Math.round(Math.log2(this.duration / 45)), 0, 6); }
  set speed(speed: number) {
    this.chosen = speed;
    this.changed();
  }

  /** Returns true if the next frame shows another time. */
  get moves(): boolean { return this.playing || (this.live && this.t < this.duration); }

  /** The run has come so far by now. */
  grow(duration: number, goesOn: boolean): void {
    this.duration = duration;
    this.goesOn = goesOn;
    if (this.live && !goesOn) this.seek(duration);
    else if (!this.live && !this.playing) this.t = clamp(this.wanted, 0, duration);
    this.changed();
  }

  seek(t: number): void {
    this.live = false;
    this.wanted = t;
    this.t = clamp(t, 0, this.duration);
    this.changed();
  }

  /** To the end, and on with it. */
  follow(): void {
    if (!this.goesOn) this.seek(this.duration);
    this.live = this.goesOn;
    this.playing = false;
    this.changed();
  }

  toggle(on = !this.playing && !this.live): void {
    const atEnd = this.t >= this.duration - 1e-9;
    if (on && atEnd && this.goesOn) {
      this.follow();
      return;
    }
    this.playing = on;
    this.seek(on && atEnd ? 0 : this.t);
  }

  /** The next speed, up or down. */
  shift(direction: 1 | -1): void {
    const index = speeds.findIndex((one) => one >= this.speed);
    this.speed = speeds[clamp(index + direction, 0, speeds.length - 1)]!;
  }

  /** Moves time on by `elapsed` seconds of the wall clock; a pause of the browser is no leap. */
  advance(elapsed: number): void {
    if (this.live) {
      this.t += (this.duration - this.t) * (1 - Math.exp(-elapsed / glide_s));
      if (this.duration - this.t < 0.01) this.t = this.duration;
    } else if (this.playing) {
      this.t = Math.min(this.duration, this.t + clamp(elapsed, 0, 0.1) * this.speed);
      if (this.t >= this.duration) this.toggle(this.goesOn);
    }
  }
}

/** The mark after or before t, of marks in the order of time. */
export function neighbour<M extends { t: number }>(marks: M[], t: number, direction: 1 | -1): M | undefined {
  return direction > 0 ? marks.find((mark) => mark.t > t + 1e-6) : marks.findLast((mark) => mark.t < t - 1e-6);
}
