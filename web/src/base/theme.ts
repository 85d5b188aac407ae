// Colours: defined in style.css and read from there for canvases; light, dark or as the system prefers.

const names = ["ground", "panel", "yard", "ink", "soft", "line", "grid", "solid-low", "solid-high", "inflated", "robot",
  "water", "belief", "waiting", "reached", "failed", "unreachable", "open", "closed", "on-mark", "sans", "mono"] as const;
export type Colour = (typeof names)[number];

export const theme = Object.fromEntries(names.map((name) => [name, ""])) as Record<Colour, string>;
const listeners = new Set<() => void>();
const night = matchMedia("(prefers-color-scheme: dark)");

function read(): void {
  const style = getComputedStyle(document.documentElement);
  for (const name of names) theme[name] = style.getPropertyValue(`--${name}`).trim();
  for (const listener of listeners) listener();
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
  const kept = asked ?? remembered();
  setTheme(kept === "dark" || (kept !== "light" && night.matches) ? "dark" : "light");
  night.addEventListener("change", () => { if (!remembered()) setTheme(night.matches ? "dark" : "light"); });
}

export function toggleTheme(): void {
  const name = isDark() ? "light" : "dark";
  setTheme(name);
  try {
    localStorage.setItem("theme", name);
  } catch { /* without storage, as on a page from a file, the choice lasts until the page closes */ }
}

function remembered(): string | null {
  try {
    return localStorage.getItem("theme");
  } catch {
    return null;
  }
}

/** Returns the colours of the pursuers; they differ from the colour of the target. */
export const pursuerColours = (): string[] => [theme.water, theme.robot, theme.reached, theme.unreachable];
