// What a plot shows, over the time or over something else: columns of one length with their names and colours.
import type { Colour } from "../base/theme";

export interface Series {
  title: string;
  unit: string;
  /** What goes along the axis, where that is not the time. */
  along?: string;
  time: number[];
  lines: { name: string; colour: Colour; values: (number | null)[]; steps?: boolean }[];
}
