// A pursuit: the grid of costs, where the target and its pursuers are at each second, what was paid and known.
import { vec2, type Vec2 } from "./geometry";
import type { CostBound, CostGrid, PaidCost, PoseStamped } from "./messages";
import { once } from "./once";
import type { Run } from "./run";
import type { RunLog } from "./run_log";
import { ofRobot, topic } from "./topics";

export interface Pursuit {
  grid: CostGrid;
  /** Places at second 0, 1, ... */
  target: Vec2[];
  robots: Vec2[][];
  paid: { t: number; paid: number }[];
  bounds: { t: number; expansions: number; cost: number; lower_bound: number }[];
}

const placesOn = (log: RunLog, name: string): Vec2[] => log.messages<PoseStamped>(name).map(({ message }) => vec2(message.pose.position));

export const pursuitOf = once(({ log }: Run): Pursuit | null => {
  const grid = log.latest<CostGrid>(topic.costGrid);
  if (!grid) return null;
  const robots = [placesOn(log, topic.pose)];
  for (let robot = 2; log.has(ofRobot(robot, topic.pose)); ++robot) robots.push(placesOn(log, ofRobot(robot, topic.pose)));
  return { grid, target: placesOn(log, topic.targetPose), robots: robots.filter((way) => way.length > 0),
    paid: log.messages<PaidCost>(topic.paid).map(({ t, message }) => ({ t, ...message })),
    bounds: log.messages<CostBound>(topic.bounds).map(({ t, message }) => ({ t, ...message })) };
});
