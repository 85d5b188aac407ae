// Colours: defined in style.css and read from there for canvases; light, dark or as the system prefers.
import { keep, kept } from "./kept";

const names = ["ground", "panel", "yard", "ink", "soft", "line", "grid", "solid-low", "solid-high", "inflated", "robot",
  "water", "belief", "waiting", "reached", "failed", "unreachable", "open", "closed", "on-mark", "sans", "mono"] as const;
export type Colour = (typeof names)[number];

export const theme = Object.fromEntries(names.map((name) => [name, ""])) as Record<Colour, string>;
const listeners = new Set<() => void>();
const night = matchMedia("(prefers-color-scheme: dark)");
const forced = matchMedia("(forced-colors: active)");

function read(): void {
  const style = getComputedStyle(document.documentElement);
  for (const name of names) theme[name] = style.getPropertyValue(`--${name}`).trim();
  if (forced.matches) nameNoSystemColours();
  for (const listener of listeners) listener();
}

/** The view in space knows no names such as CanvasText. */
function nameNoSystemColours(): void {
  const pen = document.createElement("canvas").getContext("2d", { willReadFrequently: true })!;
  for (const name of names) {
    if (name === "sans" || name === "mono") continue;
    pen.fillStyle = theme[name];
    pen.fillRect(0, 0, 1, 1);
    theme[name] = `#${[...pen.getImageData(0, 0, 1, 1).data].slice(0, 3).map((value) => value.toString(16).padStart(2, "0")).join("")}`;
  }
}

export const isDark = (): boolean => document.documentElement.dataset.theme === "dark";

/** Calls the listener after every change; returns a function that removes it. */
export function onTheme(listener: () => void): () => void {
  listeners.add(listener);
  return () => listeners.delete(listener);
}

export function setTheme(name: "light" | "dark"): void {
  document.documentElement.dataset.theme = name;
  read();
}

/** Sets light or dark as in the address, else as last chosen, else as the system prefers. */
export function startTheme(asked: string | null): void {
  const chosen = asked ?? kept("theme");
  setTheme(chosen === "dark" || (chosen !== "light" && night.matches) ? "dark" : "light");
  forced.addEventListener("change", read);
  night.addEventListener("change", () => { if (!kept("theme")) setTheme(night.matches ? "dark" : "light"); });
}

export function toggleTheme(): void {
  const name = isDark() ? "light" : "dark";
  setTheme(name);
  keep("theme", name);
}

/** Returns the colours of the robots of a team; the first has that of a single one. */
export const teamColours = (): string[] => teamColourNames.map((name) => theme[name]);
export const teamColourNames: Colour[] = ["robot", "belief", "reached", "unreachable", "open"];

/** Returns the colours of the pursuers; they differ from the colour of the target. */
export const pursuerColours = (): string[] => [theme.water, theme.robot, theme.reached, theme.unreachable];
