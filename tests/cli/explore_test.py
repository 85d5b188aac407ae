"""The command explore: worlds and scenarios, its files, planners, the published maze, refusals."""
import unittest

from tool import DATA, FLOOR, PAGE, SOURCE, ToolTest, costly_cases, flat, main, wall, world

KEYS = {"status", "explored_fraction", "time_s", "distance_m", "decisions", "max_decision_s",
        "map_error_m", "contacts", "returned_home"}
ROOM = world(FLOOR, wall("north", 0, 1.1, 3.2, 0.2), wall("south", 0, -1.1, 3.2, 0.2), wall("east", 1.5, 0, 0.2, 2),
             wall("west", -1.5, 0, 0.2, 2), wall("screen", 0, -0.4, 0.1, 1.2))


class Explore(ToolTest):
    def setUp(self):
        super().setUp()
        self.write("room.sdf", ROOM)

    def explore(self, *args, verb="explore"):
        result = self.run_tool(verb, *args, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        answer = flat(self.json_of(result))
        self.assertLessEqual(KEYS, set(answer))
        self.assertEqual((answer["status"], answer["reason"]), ("done", ""))
        self.assertTrue(answer["returned_home"])
        self.assertEqual(answer["contacts"], 0)
        self.assertGreaterEqual(answer["explored_fraction"], 0.99)
        self.assertLessEqual(answer["map_error_m"], 0.05)
        return answer

    def test_a_room_and_its_files(self):
        answer = self.explore("room.sdf", "--start=-0.8,-0.5,30", "--out", "out", *PAGE)
        self.assertEqual(answer["log"], "out/run.mcap")
        self.assertLess(answer["time_s"], 60)
        self.assertEqual({path.name for path in (self.folder / "out").iterdir()},
                         {"run.json", "run.mcap", "run.svg", "track.csv", "map.yaml", "map.pgm"} | set(["explore.html"] * len(PAGE)))
        self.assertGreater(len((self.folder / "out/track.csv").read_text().splitlines()), 20)
        # The map of the exploration is a world to explore as well, once more with another seed.
        self.explore("out/map.yaml", "--start=-0.8,-0.5,30", "--seed", "2")

    def test_a_scenario_repeats_and_flags_win(self):
        self.write("room.yaml", 'job: explore\nworld: room.sdf\nstart: "0.8,0.5,180"\nseed: 3\n')
        first = self.explore("room.yaml")
        again = self.explore("room.yaml", verb="run")
        for answer in (first, again):
            del answer["max_decision_s"], answer["max_step_s"], answer["metrics"]
        self.assertEqual(first, again)
        other = self.explore("room.yaml", "--seed", "4", "--planner", "nearest", "--perfect-pose")
        self.assertLess(other["pose_error_m"], 1e-6)

    def test_the_published_maze(self):
        maze = DATA / "exploration" / "closed_maze.world"
        if not maze.exists():
            self.skipTest(f"{maze} is absent; set OUTRIDER_DATA")
        for seed in range(1, 1 + costly_cases(2)):
            answer = self.explore(maze, "--start=-1,0,0", "--seed", seed)
            self.assertLessEqual(answer["time_s"], 195)

    def test_people_get_a_summary(self):
        result = self.run_tool("explore", "room.sdf", "--start=-0.8,-0.5,30")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("that can be seen is mapped free", result.stdout)

    def test_a_budget_ends_it(self):
        result = self.run_tool("explore", "room.sdf", "--start=-0.8,-0.5,30", "--rules-most-time", "3", "--json")
        self.assertEqual(result.returncode, 1)
        answer = flat(self.json_of(result))
        self.assertEqual(answer["status"], "not_done")
        self.assertTrue(answer["returned_home"])

    def test_a_robot_that_cannot_go_back_goes_to_where_there_is_room(self):
        # It was carried across a table that its laser does not see, so the way back leads into that.
        result = self.run_tool("explore", SOURCE / "scenarios/explore/low_table.yaml", "--seed", "867653137154408",
                               "--faults-kidnapped-at", "3.345665585940909", "--faults-kidnapped-by=-0.46382828862714276",
                               "--faults-kidnapped-turn", "7.930452663849437", "--json")
        answer = flat(self.json_of(result))
        self.assertEqual((answer["status"], answer["reason"]), ("done", ""))
        self.assertGreater(answer["stuck"], 2)

    def test_slices_whose_outer_wall_has_a_gap(self):
        self.write("gap.csv", "0,0,6,0\n6,0,6,1.5\n6,2.5,6,4\n6,4,0,4\n0,4,0,0\n2,0,2,2.5\n")
        result = self.run_tool("explore", "gap.csv", "--start=1,1,0", "--json")
        self.assertEqual(result.returncode, 1, result.stderr)
        answer = flat(self.json_of(result))
        self.assertEqual(answer["status"], "not_done")
        self.assertIn("can leave the box of all that stands at about 6.", answer["reason"])
        closed = self.explore("gap.csv", "--start=1,1,0", "--walls", "6,1.5,6,2.5")
        self.assertGreater(answer["time_s"], closed["time_s"])

    def test_bad_input(self):
        self.refused("explore", "room.sdf", "--start", "0,0,0", says=["start"])
        self.refused("explore", "room.sdf", "--start", "2,0,0", says=["start", "(2, 0) is outside the map"])
        self.refused("explore", "room.sdf", "--start", "900,0,0", says=["start", "(900, 0) is outside the map"])
        self.refused("explore", "room.sdf", "--start", "x", says=["start", "x"])
        self.refused("explore", "none.sdf", says=["none.sdf"])
        self.refused("explore", says=["world"])
        self.refused("explore", "room.sdf", "--start=-0.8,-0.5,30", "--planner", "turo",
                     says=["there is no strategy 'turo'", "tour"])
        self.refused("explore", "room.sdf", "--start=-0.8,-0.5,30", "--explore-planner", "jsp",
                     says=["there is no planner 'jsp'", "jps"])
        self.refused("explore", "room.sdf", "--laser-beams", "-1", says=["--laser-beams", "-1"])
        self.write("bad.yaml", "job: explore\nwolrd: room.sdf\n")
        self.refused("run", "bad.yaml", says=["bad.yaml:2", "wolrd", "world"])


if __name__ == "__main__":
    main()
