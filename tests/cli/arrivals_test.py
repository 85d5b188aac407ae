"""Intruders that keep coming, from the command line."""
import json
import unittest

from mcap_log import targets_of
from tool import PAGE, SOURCE, ToolTest, main
from well_logged import well_logged

DOORS = "--arrivals-entrances=gate=-2,-2 gap=2,-2.5"
LIST = "t=0 at=fox by=gate\nt=4 at=1_0 by=gap\nt=9.5 at=fox by=gap  # again\n"


class Arrivals(ToolTest):
    def watch(self, *args):
        return self.guard(DOORS, *args)

    def test_json_tells_the_objectives_and_their_bounds(self):
        result = self.run_tool(*self.watch("--arrivals-count", "5", "--json", "--out", "out", *PAGE))
        self.assertEqual(result.returncode, 0, result.stderr)
        summary = self.json_of(result)
        metrics = summary["metrics"]
        self.assertEqual(summary["status"], "done")
        self.assertEqual(metrics["targets"], 5)
        self.assertEqual(metrics["reached"], 5)
        self.assertEqual(metrics["lower_bound_s"], metrics["intruder_seconds_bound"])
        self.assertLessEqual(metrics["intruder_seconds_bound"], metrics["intruder_seconds"])
        self.assertLessEqual(metrics["makespan_bound_s"], metrics["makespan_s"])
        self.assertLessEqual(metrics["makespan_s"], metrics["mission_s"])
        log = self.log_of("out")
        events = log.read("/rosout")
        enters = [(time, event.msg) for time, event in events if event.name == "enter"]
        self.assertEqual(len(enters), 5)
        stamps = [(event.stamp.sec, event.stamp.nanosec) for _, event in events]
        self.assertEqual(stamps, sorted(stamps))
        for target, (time, sentence) in zip(targets_of(log).values(), enters):
            self.assertEqual(target.places[0][0], time)
            self.assertIn(target.entrance, ["gate", "gap"])
            self.assertIn(target.name, sentence)

    def test_a_schedule_says_who_comes(self):
        self.write("list.txt", LIST)
        result = self.run_tool(*self.watch("--arrivals-list", "list.txt", "--json", "--out", "out"))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual([t["name"] for t in self.json_of(result)["targets"]], ["fox", "1_0", "fox_2"])
        self.assertEqual([target.places[0][0] for target in targets_of(self.log_of("out")).values()], [0, 4, 9.5])

    def test_every_policy_and_objective_twice_the_same(self):
        listed = json.loads(self.run_tool("list", "--json").stdout)["guard_policies"]
        self.assertGreaterEqual(len(listed), 3)
        for policy in listed:
            for objective in ["time_inside", "makespan"]:
                outs = [f"{policy['name']}-{objective}-{threads}" for threads in "12"]
                for out in outs:
                    self.run_tool(*self.watch("--arrivals-count", "4", "--arrivals-policy", policy["name"],
                                              "--arrivals-objective", objective, "--threads", out[-1], "--out", out))
                self.same_run(*outs)

    def test_an_empty_process_is_the_still_yard(self):
        for out, flags in [("still", []), ("nobody", [DOORS, "--arrivals-policy", "groups"])]:
            self.assertEqual(self.run_tool(*self.guard(*flags, "--out", out)).returncode, 0)
        self.same_mission("still", "nobody")

    def test_what_is_wrong_gets_a_sentence(self):
        for flags, says in [
                (["--arrivals-rate", "0"], ["--arrivals-rate", "'0'", "from 1e-06"]),
                (["--arrivals-rate", "-1"], ["--arrivals-rate", "'-1'"]),
                (["--arrivals-count", "-1"], ["--arrivals-count", "from 0 to 1000"]),
                (["--arrivals-policy", "each_arival"], ["arrivals.policy", "did you mean 'each_arrival'"]),
                (["--arrivals-objective", "fun"], ["arrivals.objective", "time_inside or makespan"]),
                (["--arrivals-list", "missing.txt"], ["missing.txt"]),
                (["--arrivals-count", "2", "--targets-block"], ["targets_block"]),
                (["--arrivals-until", "1e5", "--arrivals-rate", "10"], ["arrivals.rate", "1000 intruders"])]:
            with self.subTest(flags=flags):
                self.refused(*self.watch(*flags, "--out", "out"), says=says)
        for doors, says in [(["--arrivals-entrances=gate=9,0"], ["outside the yard"]),
                            (["--arrivals-entrances=gate"], ["name=x,y"]), ([], ["missing"])]:
            with self.subTest(doors=doors):
                self.refused(*self.guard(*doors, "--arrivals-count", "2", "--out", "out"),
                             says=["arrivals.entrances", *says])

    def test_the_bundled_scenario_and_its_table(self):
        scenario = SOURCE / "scenarios" / "arrivals" / "arrivals.yaml"
        result = self.run_tool("run", scenario, "--json", "--plan-resolution", "0.2", "--arrivals-stops", "40", "--out", "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.json_of(result)["metrics"]["reached"], 24)
        well_logged(self, "out")
        for name in ["yard.sdf", "targets.txt"]:
            self.assertTrue((self.folder / name).exists())
        self.write("small.yaml", "world: yard.sdf\ntargets: targets.txt\nstart: 0,-2,90\n"
                   "plan: {resolution: 0.2, iterations: 50, refinements: 0}\n"
                   "arrivals: {count: 6, rate: 0.2, entrances: 'gate=-2,-2'}\n")
        table = self.run_tool("bench", "guard", "--arrivals", "small.yaml", "--seeds", "3", "--json")
        self.assertEqual(table.returncode, 0, table.stderr)
        rows = self.json_of(table)["rows"]
        for row in rows:
            self.assertEqual(row["runs"], 3)
            bound = next(r for r in rows if r["policy"] == "lower bound" and r["objective"] == row["objective"])
            self.assertGreaterEqual(row["inside_s"]["mean"], bound["inside_s"]["mean"])
            self.assertGreaterEqual(row["makespan_after_entry_s"]["mean"], bound["makespan_after_entry_s"]["mean"])
            if row is not bound:
                self.assertEqual((row["lost"], row["below_bound"]), (0, 0))


if __name__ == "__main__":
    main()
