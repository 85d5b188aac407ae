// The paths that the robot meant to drive. An empty one ends the drive before it.
import { placesOf, poseOf, vec2, type Pose, type Vec2 } from "./geometry";
import type { Path, PoseStamped, Refusal } from "./messages";
import { once } from "./once";
import type { Run } from "./run";
import { indexAt } from "./run_log";
import { topic } from "./topics";

export interface PlannedPath { start: number; end: number; waypoints: Vec2[]; goal: Pose | null }

export const plansOf = once(({ log, duration }: Run): PlannedPath[] => {
  const plans = log.messages<Path>(topic.plan);
  const goals = log.messages<PoseStamped>(topic.goal);
  return plans.map(({ t, message }, i): PlannedPath => {
    const goal = goals[indexAt(goals, t)];
    return { start: t, end: plans[i + 1]?.t ?? duration, waypoints: placesOf(message), goal: goal ? poseOf(goal.message.pose) : null };
  }).filter(({ waypoints }) => waypoints.length > 0);
});

/** The path that is driven at t. */
export function planAt(run: Run, t: number): PlannedPath | undefined {
  return plansOf(run).find(({ start, end }) => start <= t && t < end);
}

/** Frontiers that were left as they were, and why. */
export const refusalsOf = once(({ log }: Run): { at: Vec2; reason: string }[] =>
  log.messages<Refusal>(topic.refusals).map(({ message: { position, reason } }) => ({ at: vec2(position), reason })));
