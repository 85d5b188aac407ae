// Lengths in metres or in feet, as somebody chose; everything else on the page, and all that is saved, stays SI.
import { keep, kept } from "./kept";
import { fixed } from "./numbers";

const metres_per_foot = 0.3048;
const name = "length-unit";
const listeners = new Set<() => void>();
let feet = kept(name) === "ft";

export const lengthUnit = (): "m" | "ft" => (feet ? "ft" : "m");
/** A length of `metres` in the chosen unit. */
export const inUnit = (metres: number): number => (feet ? metres / metres_per_foot : metres);
/** The metres of a length in the chosen unit. */
export const inMetres = (length: number): number => (feet ? length * metres_per_foot : length);
export const lengthText = (metres: number, digits = 2): string => `${fixed(inUnit(metres), digits)} ${lengthUnit()}`;

export function toggleUnits(): void {
  feet = !feet;
  keep(name, feet ? "ft" : "m");
  for (const listener of listeners) listener();
}

/** Calls the listener after every change; returns a function that removes it. */
export function onUnits(listener: () => void): () => void {
  listeners.add(listener);
  return () => listeners.delete(listener);
}
