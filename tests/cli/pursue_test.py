"""The command pursue: answers, clocks, teams, unknown futures, files, refusals; and bench pursuit."""
import gzip
import json
import unittest

from tool import DATA, PAGE, SOURCE, ToolTest, main

METRICS = {"caught", "catch_time_s", "moves", "cost", "lower_bound", "optimal", "earliest_catch_s",
           "first_feasible_s", "planning_s", "peak_mib"}
# The robot at the left end waits on its cheap cell until the target stands still at the right end.
SMALL = "N\n4,1\nC\n9\nR\n1,1\nT\n" + "4 , 1\n" * 6 + "M\n1.0\n5.0\n 5\n7\n"


class Pursue(ToolTest):
    def setUp(self):
        super().setUp()
        self.write("small.txt", SMALL)

    def pursue(self, *args, status=0):
        result = self.run_tool("pursue", *args, "--json")
        self.assertEqual(result.returncode, status, result.stderr)
        answer = self.json_of(result)
        self.assertEqual(answer["status"], "not_done" if status else "done")
        return answer

    def test_the_least_cost_is_proven_on_either_clock(self):
        for clock in ("virtual", "wall"):
            answer = self.pursue("small.txt", "--clock", clock)
            self.assertLessEqual(METRICS, set(answer["metrics"]))
            metrics = answer["metrics"]
            self.assertEqual((metrics["caught"], metrics["cost"], metrics["lower_bound"], metrics["optimal"],
                              metrics["catch_time_s"], metrics["moves"], metrics["earliest_catch_s"]),
                             (True, 11, 11, True, 3, 3, 3))

    def test_published_maps_on_both_clocks(self):
        folder = DATA / "pursuit"
        if not folder.exists():
            self.skipTest(f"{folder} is absent; set OUTRIDER_DATA")
        reference = {3: 791, 4: 696, 5: 2551, 6: 2800, 7: 300, 8: 451, 9: 600}
        for path in sorted(folder.rglob("map*.txt.gz")):
            costs = set()
            for clock in ("virtual", "wall"):
                metrics = self.pursue(path, "--clock", clock)["metrics"]
                self.assertTrue(metrics["caught"] and metrics["optimal"], (path, metrics))
                self.assertEqual(metrics["cost"], metrics["lower_bound"])
                costs.add(metrics["cost"])
            self.assertEqual(len(costs), 1, path)
            number = path.name[3:].split(".")[0]
            if number in map(str, reference):
                self.assertLess(costs.pop(), reference[int(number)])

    def test_what_cannot_be_caught_is_an_answer(self):
        self.write("far.txt", SMALL.replace(" 5\n", "9\n"))
        answer = self.pursue("far.txt", status=1)
        self.assertFalse(answer["metrics"]["caught"])
        self.assertTrue(answer["reason"])

    def test_knowing_little_and_teams(self):
        self.assertEqual(self.pursue("small.txt", "--known", "5")["metrics"]["cost"], 11)
        little = self.pursue("small.txt", "--known", "0", "--forecast", "evade")["metrics"]
        self.assertGreaterEqual(little["cost"], little["lower_bound"])
        team = self.pursue("small.txt", "--pursuers", "2", "--starts", "3,1")["metrics"]
        self.assertEqual((team["cost"], team["catcher"], team["robots"]), (5, 2, 2))

    def test_files_and_replay(self):
        self.pursue("small.txt", "--out", "a", *PAGE)
        self.pursue("small.txt", "--out", "b", *PAGE)
        for name in ("run.mcap", "run.svg", "pursue.html")[:2 + len(PAGE)]:
            self.assertEqual((self.folder / "a" / name).read_bytes(), (self.folder / "b" / name).read_bytes())
        replay = self.run_tool("replay", "a/run.mcap", "--json")
        self.assertEqual(self.json_of(replay)["metrics"]["cost"], 11)
        text = self.run_tool("replay", "a/run.mcap").stdout
        self.assertIn("caught in second 3 for 11", text)
        self.assertIn("proven", text)

    def test_scenarios(self):
        scenario = SOURCE / "scenarios/pursuit/park.yaml"
        first = self.run_tool("run", scenario, "--json", "--out", "a")
        second = self.run_tool("pursue", "--scenario", scenario, "--json", "--out", "b")
        self.assertEqual((first.returncode, second.returncode), (0, 0), first.stderr + second.stderr)
        self.same_mission("a", "b")
        self.assertEqual(self.json_of(first)["metrics"]["cost"], self.json_of(first)["metrics"]["lower_bound"])
        self.refused("run", str(scenario), "--gun-length", "1", says=["--gun-length"])
        self.write("own.yaml", self.run_tool("schema", "--job", "pursue", "--as", "scenario").stdout.replace(
            'map: ""', 'map: "small.txt"'))
        self.assertEqual(self.json_of(self.run_tool("run", "own.yaml", "--json"))["metrics"]["cost"], 11)

    def test_every_planner_answers(self):
        for row in json.loads(self.run_tool("list", "--json").stdout)["pursuit_planners"]:
            metrics = self.pursue("small.txt", "--planner", row["name"])["metrics"]
            self.assertEqual((metrics["cost"], metrics["lower_bound"]), (11, 11), row["name"])

    def test_refusals(self):
        self.write("bad.txt", SMALL.replace(" 5", "five"))
        self.refused("pursue", "bad.txt", says=["bad.txt:17", "'five' is no cost"])
        self.write("bad.txt", SMALL.replace(" 5", "-5"))
        self.refused("pursue", "bad.txt", says=["bad.txt:17", "'-5' is no cost"])
        self.write("bad.txt", SMALL.replace("4 , 1", "5,1", 1))
        self.refused("pursue", "bad.txt", says=["bad.txt:8", "off the map"])
        self.write("bad.txt", SMALL.replace("4,1\nC", "4,2\nC"))
        self.refused("pursue", "bad.txt", says=["bad.txt"])
        self.write("bad.txt", SMALL.replace("4,1\nC", "90000,90000\nC"))
        self.refused("pursue", "bad.txt", says=["bad.txt:2", "the most that is read"])
        self.write("cut.txt.gz", gzip.compress(SMALL.encode())[:-12])
        self.refused("pursue", "cut.txt.gz", says=["cut.txt.gz", "cut short"])
        self.refused("pursue", "none.txt", says=["none.txt", "no such file"])
        self.refused("pursue", says=["map"])
        self.refused("pursue", "small.txt", "--clock", "sun", says=["clock", "virtual or wall"])
        self.refused("pursue", "small.txt", "--planner", "optimall", says=["did you mean 'optimal'?"])
        self.refused("pursue", "small.txt", "--forecast", "stays", says=["did you mean 'stay'?"])
        self.refused("pursue", "small.txt", "--pursuers", "3", "--starts", "2,1", says=["starts", "give 2"])
        self.write("wall.txt", SMALL.replace("1.0\n5.0", "9\n5.0"))
        self.refused("pursue", "wall.txt", says=["cell (1, 1), a wall"])

    def test_bench(self):
        (self.folder / "maps").mkdir()
        self.write("maps/small.txt", SMALL)
        result = self.run_tool("bench", "pursuit", "--data", "maps", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = {row["planner"]: row for row in self.json_of(result)["rows"]}
        self.assertEqual(rows["optimal"]["cost"], 11)
        self.assertTrue(rows["optimal"]["optimal"] and rows["anytime"]["optimal"])
        self.assertIsNotNone(rows["anytime"]["proof_s"])
        for row in rows.values():
            self.assertEqual(row["mismatch"], "")
        result = self.run_tool("bench", "pursuit", "--data", "nowhere")
        self.assertEqual(result.returncode, 2)
        result = self.run_tool("bench", "pursuit")
        self.assertEqual(result.returncode, 2)
        for word in ("--data", "--smooth"):
            self.assertIn(word, self.sentence(result))


if __name__ == "__main__":
    main()
