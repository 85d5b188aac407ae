// Small arithmetic, and formatting of numbers for people.

/** A number of run.json; null means infinite or unknown. */
export type Num = number | null;

export const finite = (value: Num | undefined, otherwise = 0): number =>
  Number.isFinite(value) ? (value as number) : otherwise;
export const clamp = (value: number, low: number, high: number): number => Math.min(high, Math.max(low, value));
export const mix = (a: number, b: number, share: number): number => a + (b - a) * share;

export const minus = (text: string): string => text.replace("-", "\u2212");
export const fixed = (value: Num | undefined, digits: number): string =>
  Number.isFinite(value) ? minus((value as number).toFixed(digits)) : "\u2013";
export const figures = (value: number): string =>
  fixed(value, Math.abs(value) >= 100 ? 0 : Math.abs(value) >= 10 ? 1 : 2);
export const degrees = (radians: Num, digits = 1): string =>
  Number.isFinite(radians) ? fixed((finite(radians) * 180) / Math.PI, digits) + "\u00b0" : "\u2013";
/** Wraps an angle to (-pi, pi]. */
export const wrapped = (angle: number): number => Math.atan2(Math.sin(angle), Math.cos(angle));

/** Formats minutes and seconds: 1:02.5; of an hour and more hours, too: 2:14:30.6. */
export function clockText(seconds: Num, digits = 0): string {
  if (!Number.isFinite(seconds)) return "\u2013";
  const whole = Number(finite(seconds).toFixed(digits));
  const rest = (whole % 60).toFixed(digits).padStart(digits ? digits + 3 : 2, "0");
  const minutes = Math.floor(whole / 60);
  return minutes < 60 ? `${minutes}:${rest}` : `${Math.floor(minutes / 60)}:${String(minutes % 60).padStart(2, "0")}:${rest}`;
}

/** Returns 1, 2 or 5 times a power of ten, at least `least`. */
export function roundStep(least: number): number {
  const power = 10 ** Math.floor(Math.log10(least));
  return power * ([1, 2, 5, 10].find((k) => k * power >= least * (1 - 1e-9)) ?? 10);
}

/** Metrics that say yes or no. */
const truths = new Set(["tour_proven", "caught", "optimal", "returned_home"]);

/** Labels for names that are too short to say what they are. */
const labels: Record<string, string> = {
  t_min_s: "least possible time",
  t_max_s: "largest possible time",
  sure_fraction: "share covered for sure",
  sure_inner_fraction: "share covered for sure, without the rim",
  order_bound_s: "time bound of the order",
};

/** Returns the quantity of a metric, after its unit, where its name leaves it open: "planned" may be a time, a length or a share. */
function nounOf(stem: string, unit: string | undefined): string {
  if (unit === "fraction") return "share";
  if (unit === "m2") return stem.includes("area") ? "" : "area";
  if (unit === "s") return /time|bound|seconds|makespan/.test(stem) ? "" : "time";
  if (unit === "m") return /(ed|en|^ideal|^path)$/.test(stem) ? "length" : "";
  return "";
}

/** Derives a metric's label, value and unit from its name: mission_s, driven_m, turned_rad, covered_fraction, ... */
export function metric(name: string, value: Num): { label: string; value: string; unit: string } {
  const [, stem = name, unit] = name.match(/^(.*?)(?:_(s|m|m2|rad|mps|j|fraction))?$/) ?? [];
  const label = labels[name] ?? `${stem.replaceAll("_", " ")} ${nounOf(stem, unit)}`.trim();
  if (!Number.isFinite(value)) return { label, value: "\u2013", unit: "" };
  const v = value as number;
  if (truths.has(name)) return { label, value: v ? "yes" : "no", unit: "" };
  if (/(^|_)gap$/.test(name)) return { label, value: figures(100 * v), unit: "%" };
  if (unit === "s" && v >= 3600) return { label, value: clockText(v), unit: "h" };
  if (unit === "s" && v >= 100) return { label, value: clockText(v), unit: "min" };
  if (unit === "s") return { label, value: figures(v), unit: "s" };
  if (unit === "m") return { label, value: figures(v), unit: "m" };
  if (unit === "m2") return { label, value: figures(v), unit: "m\u00b2" };
  if (unit === "fraction") return { label, value: fixed(100 * v, 2), unit: "%" };
  if (unit === "j") return { label, value: figures(v), unit: "J" };
  if (unit === "mps") return { label, value: figures(v), unit: "m/s" };
  if (unit === "rad") return { label, value: figures(v / (2 * Math.PI)), unit: "turns" };
  return { label, value: Number.isInteger(v) ? minus(v.toLocaleString("en")) : figures(v), unit: "" };
}
