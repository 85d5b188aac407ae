// Numbers of a run that goes on, by the names that metrics have: the metrics themselves come with its end.
import type { Num } from "../base/numbers";
import type { Run } from "./run";

export function soFar(run: Run): Record<string, Num> {
  const { track: { x, y, heading }, report: { pursuit, explore, shots, targets } } = run;
  let [driven_m, turned_rad] = [0, 0];
  for (let i = 1; i < x.length; ++i) {
    driven_m += Math.hypot(x[i]! - x[i - 1]!, y[i]! - y[i - 1]!);
    turned_rad += Math.abs(heading[i]! - heading[i - 1]!);
  }
  const count = (status: string): number => targets.filter((one) => one.status === status).length;
  return { time_s: run.duration,
    ...(targets.length > 0 ? { targets: targets.length, reached: count("reached"), failed: count("failed"), shots: shots.length } : {}),
    ...(pursuit ? { cost: pursuit.paid.at(-1) ?? 0 } : { driven_m, turned_rad }),
    ...(explore ? { decisions: explore.decisions.length } : {}) };
}
