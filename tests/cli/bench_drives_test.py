"""The commands bench halls, maps and navigate: drives of the navigator, their rows, and refusals."""
import unittest

from tool import SOURCE, ToolTest, main


class BenchDrives(ToolTest):
    def rows_of(self, *args):
        result = self.run_tool("bench", *args, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return self.json_of(result)["rows"]

    def test_halls(self):
        args = ("halls", "--walkers", "social", "--worlds", "1", "--rules", "sampled")
        (row,) = self.rows_of(*args)
        self.assertEqual((row["walkers"], row["rule"], row["runs"], row["contacts"]), ("social", "sampled", 1, 0), row)
        self.assertEqual(row["success"], 1.0, row)
        self.assertGreater(row["time_ratio"], 0.8)
        self.assertEqual(self.rows_of(*args), [row])

    def test_maps(self):
        rows = self.rows_of("maps", "--files", str(SOURCE / "scenarios/explore/office_map.yaml"), "--goals", "3")
        self.assertEqual([row["map"] for row in rows], ["office_map"])
        (row,) = rows
        self.assertEqual(row["goals"], 3)
        self.assertEqual(row["done"] + row["no_way"] + row["maybe"], 3, row)
        self.assertEqual((row["contacts"], row["false_done"]), (0, 0), row)

    def test_navigate(self):
        rows = self.rows_of("navigate", "--steps", "20")
        self.assertEqual([row["varied"] for row in rows], ["beams"] * 4 + ["marks"] * 4 + ["moving"] * 4)
        for row in rows:
            self.assertGreaterEqual(row["us_99"], row["median_us"])
            self.assertGreater(row["robots"], 0.1)
        self.assertEqual([row["beams"] for row in rows[:4]], [180, 360, 720, 1440])

    def test_refusals(self):
        for args, sentence in ((["halls", "--walkers", "post"], "posts"), (["halls", "--worlds", "21"], "--worlds"),
                               (["halls", "--rules", "sample"], "sampled"), (["maps", "--files", "nowhere.yaml"], "nowhere"),
                               (["maps", "--files", "", "--data", "nowhere"], "nowhere")):
            result = self.run_tool("bench", *args)
            self.assertEqual(result.returncode, 2, (args, result.stderr))
            self.assertIn(sentence, result.stderr)


if __name__ == "__main__":
    main()
