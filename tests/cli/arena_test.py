"""The arena: its safe and short ways planned, and both driven."""
import math
import unittest

from tool import SOURCE, ToolTest, flat, main
from well_logged import well_logged

ARENA = SOURCE / "scenarios" / "arena"
ENDS = ("--from", "2.5,0.5", "--to", "1,2.5", "--radius", "0.2")


class Arena(ToolTest):
    def row(self, planner, *more):
        result = self.run_tool("plan", ARENA / "arena.sdf", *ENDS, "--planner", planner, *more, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return self.json_of(result)["rows"][0]

    def test_safe_ways_among_polygons(self):
        short, wide, safe = (self.row(name) for name in ("visibility_graph", "widest", "medial_axis"))
        self.assertAlmostEqual(short["clearance_m"], 0.2, places=6)
        self.assertAlmostEqual(wide["clearance_m"], 0.5, places=6)  # as much as the start has
        self.assertGreaterEqual(safe["clearance_m"], 0.999 * 0.5 - 1e-9)
        self.assertLess(short["length_m"], wide["length_m"])
        self.assertLess(wide["length_m"], safe["length_m"])
        self.assertLess(safe["exposure"], wide["exposure"])
        self.assertLess(wide["exposure"], short["exposure"])
        self.assertAlmostEqual(safe["cost"], safe["length_m"] + 10 * safe["exposure"], delta=0.01 * safe["cost"])
        self.assertEqual((safe["cost_unit"], wide["cost_unit"]), ("m eq", "m"))
        self.assertLessEqual(len(safe["waypoints"]), 12)  # it bends round the box
        again = self.row("widest", "--widest-kept", "0")
        self.assertAlmostEqual(again["cost"], short["cost"], places=9)

    def test_safe_way_on_the_grid(self):
        ask = ("plan", ARENA / "arena.sdf", *ENDS, "--planner", "safest", "--resolution", "0.05", "--json")
        (few,) = self.json_of(self.run_tool(*ask))["rows"]
        (moves,) = self.json_of(self.run_tool(*ask, "--safest-along-moves"))["rows"]
        self.assertLessEqual(few["cost"], moves["cost"] + 1e-9)
        self.assertLessEqual(len(few["waypoints"]), 10)
        for row in (few, moves):
            self.assertGreater(row["clearance_m"], 0.2)
            self.assertAlmostEqual(sum(map(math.dist, row["waypoints"], row["waypoints"][1:])), row["length_m"],
                                   places=9)

    def test_bad_options_are_refused(self):
        for flag, value in (("--medial-axis-weight", "-1"), ("--widest-kept", "2"), ("--safest-kept", "x")):
            result = self.run_tool("plan", ARENA / "arena.sdf", *ENDS, "--planner", "widest", flag, value)
            self.assertEqual(result.returncode, 2)
            self.assertIn(flag, result.stderr)

    def test_both_ways_are_driven(self):
        runs = {}
        for name in ("shortest", "safest"):
            result = self.run_tool("run", ARENA / f"{name}.yaml", "--sight", "modelled", "--json", "--out", name)
            self.assertEqual(result.returncode, 0, result.stderr)
            well_logged(self, name)
            runs[name] = flat(self.json_of(result))
            self.assertEqual(runs[name]["status"], "done")
            self.assertLess(runs[name]["driven_m"], 1.2 * runs[name]["path_m"])
        self.assertLess(runs["shortest"]["path_m"], runs["safest"]["path_m"])
        # One word for one thing: plan, asked for the radius and the margin of 0.05 m, says the same clearance.
        for name, planner in (("safest", "medial_axis"), ("shortest", "visibility_graph")):
            self.assertAlmostEqual(runs[name]["path_clearance_m"], self.row(planner)["clearance_m"], places=6)
        self.assertGreater(runs["safest"]["clearance_m"], 0.45)
        self.assertGreater(runs["shortest"]["clearance_m"], 0.15)


if __name__ == "__main__":
    main()
