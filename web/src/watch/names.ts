// Places of names beside what they name, in pixels: each where it covers nothing that stands there already, or nowhere.
import type { Ink } from "../base/ink";
import { theme } from "../base/theme";

export interface Named { text: string; x: number; y: number }
type Area = [number, number, number, number];

export const nameFont = (weight = 450): string => `${weight} 11.5px ${theme.sans}`;
export const shortName = (name: string): string => (name.length > 28 ? `${name.slice(0, 27)}\u2026` : name);

/** The left end of each name and its middle, from what it names; null where it has no room. Those that come first choose first. */
export function placeNames(ctx: Ink, { width, height }: { width: number; height: number }, all: Named[]): ({ x: number; y: number } | null)[] {
  ctx.font = nameFont();
  const taken: Area[] = all.map(({ x, y }) => [x - 8, y - 8, x + 8, y + 8]);
  const free = ([x0, y0, x1, y1]: Area): boolean => x0 > 2 && x1 < width - 2 && y0 > 2 && y1 < height - 2 &&
    taken.every((other) => x0 > other[2] || x1 < other[0] || y0 > other[3] || y1 < other[1]);
  return all.map(({ text, x, y }) => {
    const long = ctx.measureText(text).width;
    for (const [left, middle] of [[x + 11, y], [x - 11 - long, y], [x - long / 2, y - 16], [x - long / 2, y + 16]] as const) {
      const area: Area = [left - 2, middle - 7, left + long + 2, middle + 7];
      if (!free(area)) continue;
      taken.push(area);
      return { x: left - x, y: middle - y };
    }
    return null;
  });
}
