// A film of a range of time: numbered pictures in one archive, frame k as the view is at `from` + k / `rate`.
import { pngOf } from "../base/save";
import { Zip } from "../base/zip";

export interface Range {
  from: number;  // s of the run
  to: number;
  rate: number;  // frames a second of the run
}

/** Frames from `from` to `to`, the latter included where a frame falls on it. */
export const frameCount = ({ from, to, rate }: Range): number => Math.floor((to - from) * rate + 1e-6) + 1;
export const frameTime = ({ from, rate }: Range, k: number): number => from + k / rate;
/** As `ffmpeg -i frame-%05d.png` counts. */
export const frameName = (k: number): string => `frame-${String(k).padStart(5, "0")}.png`;

/** Returns the fault of a range, as a sentence; nothing if it is right. */
export function rangeFault({ from, to, rate }: Range, duration: number): string {
  if (!(from >= 0 && from <= duration)) return `From: expected a time of the run, 0 to ${duration.toFixed(2)} s`;
  if (!(to >= from && to <= duration)) return `To: expected a time from ${from.toFixed(2)} to ${duration.toFixed(2)} s`;
  if (!(rate >= 0.01 && rate <= 240)) return "Frames a second: expected a number from 0.01 to 240";
  const count = frameCount({ from, to, rate });
  return count > 36000 ? `${count.toLocaleString("en")} frames are too many; 36,000 is the most` : "";
}

/**
 * The archive of the frames that `draw` draws, one after another; null once `goOn`, which hears how many are done,
 * says no. Gives way to the browser after each.
 */
export async function filmed(range: Range, draw: (t: number) => HTMLCanvasElement, goOn: (done: number) => boolean): Promise<Blob | null> {
  const zip = new Zip();
  const count = frameCount(range);
  for (let k = 0; k < count; ++k) {
    if (!goOn(k)) return null;
    await zip.add(frameName(k), await pngOf(draw(frameTime(range, k))));
  }
  return goOn(count) ? zip.blob() : null;
}
