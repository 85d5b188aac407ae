"""The catalogue of guard planners from outside: guard --planner, the picture of regions, bench guard."""
import json
import unittest
import xml.etree.ElementTree as ElementTree

from tool import COARSE, ToolTest, main

PLANNERS = ["best_tour"]
SCENARIO = ("job: guard\nworld: yard.sdf\ntargets: targets.txt\nstart: 0,-2,90\nplan:\n"
            + "".join(f"  {flag[len('--plan-'):]}: {value}\n" for flag, value in zip(COARSE[::2], COARSE[1::2])))


class GuardPlanners(ToolTest):
    def test_list_has_them(self):
        listed = json.loads(self.run_tool("list", "--json").stdout)["guard_planners"]
        self.assertEqual([row["name"] for row in listed], PLANNERS)
        text = self.run_tool("list").stdout
        for row in listed:
            for key in ["name", "sentence", "source"]:
                self.assertIn(row[key], text)

    def test_each_guards_the_yard_and_key_and_flags_agree(self):
        for name in PLANNERS:
            first = self.json_of(self.run_tool(*self.guard("--planner", name, "--json", "--out", f"{name}-a")))
            self.assertEqual(first["metrics"]["reached"], 3, name)
            self.run_tool(*self.guard("--plan-planner", name, "--out", f"{name}-b"))
            self.same_run(f"{name}-a", f"{name}-b")

    def test_unknown_planners(self):
        self.refused(*self.guard("--planner", "best_tuor"), says=["best_tuor", "did you mean 'best_tour'?", "planner"])
        self.write("m.yaml", SCENARIO + "  planner: none\n")
        self.refused("run", "m.yaml", says=["plan.planner", "none", "best_tour"])

    def test_picture_of_the_regions(self):
        result = self.run_tool(*self.guard("--regions", "--out", "out"))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("out/run.svg", result.stdout)
        picture = ElementTree.fromstring((self.folder / "out/run.svg").read_text())
        words = [text.text for text in picture.iter("{http://www.w3.org/2000/svg}text")]
        self.assertIn("fox", words)
        self.assertIn("0 to 3 of 3 targets in range", words)


class GuardBench(ToolTest):
    def bench(self, *args):
        self.write("m.yaml", SCENARIO)
        return self.run_tool("bench", "guard", "--scenarios", "m.yaml", *args)

    def test_every_planner_and_seed_is_measured(self):
        answer = self.json_of(self.bench("--seeds", "2", "--json"))
        self.assertEqual((answer["status"], answer["job"]), ("done", "bench guard"))
        rows = answer["rows"]
        self.assertEqual([(row["planner"], row["seed"]) for row in rows],
                         [(name, seed) for name in PLANNERS for seed in (1, 2)])
        for row in rows:
            self.assertEqual(row["reached"] + row["failed"] + row["unreachable"], 3)
            self.assertAlmostEqual(row["drive_s"] + row["turn_s"] + row["aim_s"] + row["flight_s"], row["mission_s"],
                                   places=6)
            base = next(r for r in rows if r["planner"] == "best_tour" and r["seed"] == row["seed"])
            self.assertAlmostEqual(row["ratio_to_best_tour"], row["mission_s"] / base["mission_s"])
            self.assertGreater(row["planning_s"], 0)

    def test_table_for_people_and_a_choice(self):
        result = self.bench("--seeds", "1", "--planners", "best_tour")
        self.assertEqual(result.returncode, 0, result.stderr)
        head, line = result.stdout.splitlines()
        self.assertEqual(len(head), len(line))
        self.assertEqual(line.split()[:3], ["yard", "best_tour", "1"])

    def test_a_yard_of_so_many_targets_is_made(self):
        flags = ("--targets", "5", "--planners", "best_tour", "--seeds", "1", "--json")
        row, = self.json_of(self.bench(*flags))["rows"]
        self.assertEqual((row["yard"], row["reached"]), ("5 targets", 5))
        self.assertTrue(0 <= row["gap"] <= row["anywhere_gap"] <= 1, row)
        again, = self.json_of(self.bench(*flags))["rows"]
        self.assertEqual(again["mission_s"], row["mission_s"])

    def test_refusals(self):
        for args, words in [(["--scenarios", "nowhere.yaml"], ["nowhere.yaml"]),
                            (["--data", "nowhere"], ["nowhere/worlds/by_small.sdf"]),
                            (["--planners", "tuor"], ["--planners", "tuor"]), (["--seeds", "0"], ["--seeds"])]:
            result = self.bench(*args) if args[0] != "--scenarios" else self.run_tool("bench", "guard", *args)
            self.assertEqual(result.returncode, 2, args)
            self.assertEqual(result.stdout, "")
            for word in words:
                self.assertIn(word, self.sentence(result))


if __name__ == "__main__":
    main()
