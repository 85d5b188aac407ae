"""The reference planners of guard from outside."""
import json

from tool import COARSE, ToolTest, main

PLANNERS = ["best_tour", "shrinking_circles", "circles_in_order", "source_target_table",
            "best_tour_by_headings"]
SCENARIO = ("job: guard\nworld: yard.sdf\ntargets: targets.txt\nstart: 0,-2,90\nplan:\n"
            + "".join(f"  {flag[len('--plan-'):]}: {value}\n" for flag, value in zip(COARSE[::2], COARSE[1::2])))


class GuardPlanners(ToolTest):
    def test_list_has_them(self):
        listed = json.loads(self.run_tool("list", "--json").stdout)["guard_planners"]
        self.assertEqual([row["name"] for row in listed], PLANNERS)

    def test_each_guards_the_yard_and_key_and_flags_agree(self):
        for name in PLANNERS:
            first = self.json_of(self.run_tool(*self.guard("--planner", name, "--json", "--out", f"{name}-a")))
            self.assertEqual(first["metrics"]["reached"], 3, name)
            self.run_tool(*self.guard("--plan-planner", name, "--out", f"{name}-b"))
            self.same_run(f"{name}-a", f"{name}-b")
        self.write("m.yaml", SCENARIO + "  planner: shrinking_circles\n")
        self.run_tool("run", "m.yaml", "--out", "key")
        self.assertIn("shrinking_circles", json.dumps(self.result_of("key")["settings"]))

    def test_a_team_takes_the_first_planner(self):
        self.refused(*self.guard("--robots", "2", "--planner", "circles_in_order"), says=["plan.planner", "several robots"])

    def test_the_bench_compares_them(self):
        self.write("m.yaml", SCENARIO)
        rows = self.json_of(self.run_tool("bench", "guard", "--scenarios", "m.yaml", "--seeds", "1", "--json"))["rows"]
        self.assertEqual([row["planner"] for row in rows], PLANNERS)
        for row in rows:
            self.assertAlmostEqual(row["ratio_to_best_tour"], row["mission_s"] / rows[0]["mission_s"])


main()
