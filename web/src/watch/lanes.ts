// Lanes that show the state of each thing over the time.
import { known, type Status } from "../base/signs";
import { teamColourNames, type Colour } from "../base/theme";
import { coverOf } from "../log/cover";
import { plansOf } from "../log/plans";
import type { Run } from "../log/run";
import { targetsOf } from "../log/targets";
import { legsOfOthers } from "../log/team";
import { roleColours } from "./cover_layer";

export interface Stretch { from: number; to: number; words: string; colour: Colour; faint?: boolean }
export interface Lane { name: string; stretches: Stretch[] }
export interface Lanes { title: string; lanes: Lane[] }

function targetLanes(run: Run): Lanes[] {
  const lanes = targetsOf(run).map((target): Lane => {
    const times = [...new Set([0, ...target.changes])].sort((a, b) => a - b);
    return { name: target.name, stretches: times.map((from, i): Stretch => {
      const words = target.statusAt(from);
      const status: Status = known(words);
      return { from, to: times[i + 1] ?? run.duration, words, colour: status, faint: status === "waiting" };
    }) };
  });
  return lanes.length > 0 ? [{ title: "Status of targets", lanes }] : [];
}

function doingLanes(run: Run): Lanes[] {
  const passes = coverOf(run)?.passes ?? [];
  if (passes.length > 0) return [{ title: "What the robot does", lanes: [{ name: "pass", stretches: passes.map(({ start, end, role }) => ({ from: start, to: end, words: role, colour: roleColours[role] })) }] }];
  const plans = plansOf(run);
  const others = legsOfOthers(run);
  if (others.length > 0) return [{ title: "What the robots do", lanes: [plans, ...others].map((legs, i) => ({ name: `robot ${i + 1}`,
    stretches: legs.map(({ start, end }): Stretch => ({ from: start, to: end, words: "follows a path", colour: teamColourNames[i % teamColourNames.length]! })) })) }];
  return plans.length > 0 ? [{ title: "What the robot does", lanes: [{ name: "drives", stretches: plans.map(({ start, end }) => ({ from: start, to: end, words: "follows a path", colour: "robot" })) }] }] : [];
}

export const lanesOf = (run: Run): Lanes[] => [...doingLanes(run), ...targetLanes(run)];

export const stretchAt = ({ stretches }: Lane, t: number): Stretch | undefined => stretches.findLast(({ from, to }) => from <= t && t <= to);
