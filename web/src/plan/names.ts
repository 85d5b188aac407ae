// Suggests names for files and targets, and reads places from an address.
import type { Vec2 } from "../base/outline";

/**
 * Returns, for example, "rooms/hall_plan.yaml" for "rooms/hall.txt" and the ending "_plan": in the same folder, with
 * characters that the server accepts.
 */
export function suggestedName(path: string, ending: string): string {
  const [, folder = "", name = ""] = path.match(/^(.*\/)?(.*)$/) ?? [];
  const stem = name.replace(/\.gz$/, "").replace(/\.[^.]*$/, "").replace(/[^\w.-]+/g, "_");
  return `${folder}${stem}${stem.endsWith(ending) ? "" : ending}.yaml`;
}

/** Returns a name that no target has. */
export function newName(targets: readonly { name: string }[]): string {
  let number = 1;
  while (targets.some(({ name }) => name === `new_${number}`)) ++number;
  return `new_${number}`;
}

/** Reads "x,y"; null if that is no place. */
export function pointOf(text: string | undefined): Vec2 | null {
  const [x, y] = (text ?? "").split(",").map(Number);
  return Number.isFinite(x) && Number.isFinite(y) ? [x!, y!] : null;
}
