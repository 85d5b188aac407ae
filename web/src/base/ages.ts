// How long something took and how long ago it was, for people.
import { clockText } from "./numbers";

/** 0.4 s, 12 s, 2:05 min, 1:02:05 h. */
export function tookText(seconds: number | null): string {
  if (seconds === null || !Number.isFinite(seconds)) return "\u2013";
  if (seconds < 9.95) return `${seconds.toFixed(1)} s`;
  if (seconds < 59.5) return `${seconds.toFixed(0)} s`;
  if (seconds < 3599.5) return `${clockText(seconds)} min`;
  return `${Math.floor(Math.round(seconds) / 3600)}:${clockText(Math.round(seconds) % 3600).padStart(5, "0")} h`;
}

const units = [[86400, "day"], [3600, "hour"], [60, "minute"]] as const;

/** "just now", "5 minutes ago", "2 days ago". Times are in seconds. */
export function ageText(then: number, now: number): string {
  const age = now - then;
  const [length, name] = units.find(([least]) => age >= least) ?? [0, ""];
  if (length === 0) return "just now";
  const count = Math.floor(age / length);
  return `${count} ${name}${count === 1 ? "" : "s"} ago`;
}
