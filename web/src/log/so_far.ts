// Numbers of a run that goes on, by the names that metrics have: the metrics themselves come with its end.
import type { Num } from "../base/numbers";
import { flightsOf } from "./flights";
import { pursuitOf } from "./pursuit";
import type { Run } from "./run";
import { targetsOf } from "./targets";
import { topic } from "./topics";

export function soFar(run: Run): Record<string, Num> {
  const { x, y, heading } = run.track;
  const targets = targetsOf(run);
  const pursuit = pursuitOf(run);
  const decisions = run.log.messages(topic.decisions).length;
  let [driven_m, turned_rad] = [0, 0];
  for (let i = 1; i < x.length; ++i) {
    driven_m += Math.hypot(x[i]! - x[i - 1]!, y[i]! - y[i - 1]!);
    turned_rad += Math.abs(heading[i]! - heading[i - 1]!);
  }
  const count = (status: string): number => targets.filter((one) => one.status === status).length;
  return { time_s: run.duration,
    ...(targets.length > 0 ? { targets: targets.length, reached: count("reached"), failed: count("failed"), shots: flightsOf(run).length } : {}),
    ...(pursuit ? { cost: pursuit.paid.at(-1)?.paid ?? 0 } : { driven_m, turned_rad }),
    ...(decisions > 0 ? { decisions } : {}) };
}
