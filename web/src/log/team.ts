// The robots of a run: one, or several that share the targets of a yard. Pursuers have a grid of their own (pursuit.ts).
import type { Path } from "./messages";
import { placesOf, type Vec2 } from "./geometry";
import { once } from "./once";
import type { Run } from "./run";
import { ofRobot, topic } from "./topics";
import { gunOf, posesOn, Track } from "./track";

export interface TeamRobot {
  name: string;
  poseTopic: string;
  planTopic: string;
  track: Track;
}

/** The first robot of a run, and those beside it. */
export const teamOf = once((run: Run): TeamRobot[] => {
  const { log, track } = run;
  const team: TeamRobot[] = [{ name: "robot", poseTopic: topic.pose, planTopic: topic.plan, track }];
  if (log.has(topic.costGrid)) return team;
  for (let robot = 2; log.has(ofRobot(robot, topic.pose)); ++robot) {
    const poseTopic = ofRobot(robot, topic.pose);
    team.push({ name: `robot ${robot}`, poseTopic, planTopic: ofRobot(robot, topic.plan), track: new Track(posesOn(log, poseTopic), gunOf(log, ofRobot(robot, topic.joints))) });
  }
  if (team.length > 1) team[0]!.name = "robot 1";
  return team;
});

export interface Leg { start: number; end: number; waypoints: Vec2[] }

/** The paths that the robots after the first meant to drive. An empty one ends the drive before it. */
export const legsOfOthers = once((run: Run): Leg[][] => teamOf(run).slice(1).map(({ planTopic }) => {
  const plans = run.log.messages<Path>(planTopic);
  return plans.map(({ t, message }, i): Leg => ({ start: t, end: plans[i + 1]?.t ?? run.duration, waypoints: placesOf(message) })).filter(({ waypoints }) => waypoints.length > 0);
}));
