import { expect, test } from "vitest";
import { legsOfOthers, teamOf } from "../../src/log/team";
import { pose, poses, runOf } from "./made";

const path = (...places: [number, number][]): unknown => ({ poses: places.map(([x, y]) => pose(x, y)) });

test("a run of one robot has a team of one", () => {
  const run = runOf({ "/pose": poses([[0, 0, 0, 0], [1, 1, 0, 0]]) });
  expect(teamOf(run).map(({ name }) => name)).toEqual(["robot"]);
  expect(legsOfOthers(run)).toEqual([]);
});

test("the others have their own poses, guns and paths", () => {
  const run = runOf({
    "/pose": poses([[0, 0, 0, 0], [2, 2, 0, 0]]),
    "/robot_2/pose": poses([[0, 5, 0, 0], [2, 5, 4, 0]]),
    "/robot_2/joint_states": [[0, { name: ["gun_yaw", "gun_pitch"], position: [0.5, 0.25] }]],
    "/robot_2/plan": [[0.5, path([5, 0], [5, 4])], [1.5, path()]],
    "/robot_3/pose": poses([[0, 9, 9, 0]]),
  });
  const team = teamOf(run);
  expect(team.map(({ name }) => name)).toEqual(["robot 1", "robot 2", "robot 3"]);
  expect(team[1]!.track.at(1)).toMatchObject({ x: 5, y: 2, yaw: 0.5, pitch: 0.25 });
  expect(legsOfOthers(run)).toEqual([[{ start: 0.5, end: 1.5, waypoints: [[5, 0], [5, 4]] }], []]);
});
