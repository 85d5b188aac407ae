"""Ground that is not flat, from the command line."""
import unittest

from tool import PAGE, SOURCE, ToolTest, main
from well_logged import well_logged

HEAD = "ncols 9\nnrows 9\nxllcenter -4\nyllcenter -4\ncellsize 1\nNODATA_value -1\n"


def grid(height):
    rows = [" ".join(str(height(x, y)) for x in range(-4, 5)) for y in range(4, -5, -1)]
    return HEAD + "\n".join(rows) + "\n"


class Terrain(ToolTest):
    def on(self, height, *args):
        self.write("ground.asc", grid(height))
        return self.run_tool(*self.guard("--terrain", "ground.asc", *args))

    def test_flat_ground_changes_nothing(self):
        self.run_tool(*self.guard("--out", "floor"))
        self.on(lambda x, y: 0, "--out", "flat")
        self.same_mission("floor", "flat")

    def test_a_slope_is_driven_and_drawn(self):
        result = self.on(lambda x, y: 0.1 * (x + 4), "--json", "--out", "out", *PAGE)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        log = self.log_of("out")
        self.assertEqual(log.latest("/solids").solids[0].kind, "height_field")
        ground = log.latest("/terrain")
        heights = [line.height for line in ground.contours]
        self.assertGreater(len(heights), 0)
        self.assertEqual(heights, sorted(heights))
        self.assertEqual(ground.steep, [])
        self.assertIn("contours from", (self.folder / "out" / "run.svg").read_text())

    def test_a_start_that_is_too_steep_is_said_in_degrees(self):
        result = self.on(lambda x, y: max(0, -0.6 * y))
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr, r"as steep as 31\.0 degrees, and it holds on 20; start elsewhere")
        result = self.on(lambda x, y: max(0, -0.6 * y), "--robot-max-slope", "35", "--json")
        self.assertNotEqual(result.returncode, 2, result.stderr)

    def test_bad_grids_are_refused_with_file_and_line(self):
        for text, words in [(grid(lambda x, y: -1), "ground.asc:7: '-1' in column 1 of row 1 is no height"),
                            (grid(lambda x, y: 0)[:-4], "its header says 9 x 9"),
                            (HEAD.replace("ncols 9", "ncols 99999999"), "99999999|1e\\+08"),
                            (HEAD.replace("nrows 9", "nrows 9.5"), "whole numbers"),
                            ("nothing", "takes one number")]:
            self.write("ground.asc", text)
            result = self.run_tool(*self.guard("--terrain", "ground.asc"))
            self.assertEqual(result.returncode, 2, text)
            self.assertRegex(result.stderr, words)

    def test_ground_that_ends_in_the_yard_is_refused(self):
        self.write("ground.asc", grid(lambda x, y: 0.01 * x).replace("cellsize 1", "cellsize 0.5"))
        result = self.run_tool(*self.guard("--terrain", "ground.asc"))
        self.assertEqual(result.returncode, 2)
        self.assertIn("make it larger, or give bounds within it", result.stderr)

    def test_the_scenario_of_the_hill(self):
        result = self.run_tool("run", SOURCE / "scenarios" / "hill" / "hill.yaml", "--plan-resolution", "0.4",
                               "--plan-aim-step", "0.3", "--plan-pitch-step", "10", "--plan-iterations", "50", "--json", "--out", "out")
        summary = self.json_of(result)
        self.assertEqual(result.returncode, 0, result.stderr)
        well_logged(self, "out")
        self.assertEqual(summary["metrics"]["targets"], 12)
        self.assertGreaterEqual(summary["metrics"]["reached"], 11)
        self.assertLessEqual(summary["metrics"]["lower_bound_s"], summary["metrics"]["expected_s"])


if __name__ == "__main__":
    main()
