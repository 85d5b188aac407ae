"""The command bench barn: drives through posts that nobody mapped, and refusals."""
import gzip
import json
import unittest

from tool import ToolTest, main

POSTS = [[x / 10, y] for x in range(-18, 19, 3) if abs(x) > 4 for y in (2.0, 4.5)] + [[0.3, 3.2], [-0.5, 5.6]]
LANE = [[x, y / 2] for x in (-1.0, 1.0) for y in range(-1, 15)]
WORLDS = {"radius_m": 0.075, "start": [0.0, 0.0, 1.5707963], "goal": [0.0, 7.0],
          "worlds": {"0": {"path_m": 7.5, "cylinders": POSTS}, "4": {"path_m": 7.0, "cylinders": LANE}}}


class Barn(ToolTest):
    def setUp(self):
        super().setUp()
        (self.folder / "static_even.json.gz").write_bytes(gzip.compress(json.dumps(WORLDS).encode()))

    def test_arrives_without_contact(self):
        result = self.run_tool("bench", "barn", "--data", ".", "--seeds", "2", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = {row["rule"]: row for row in self.json_of(result)["rows"]}
        self.assertEqual(set(rows), {"sampled", "dwa", "steer"})
        for row in rows.values():
            self.assertEqual((row["runs"], row["success"], row["contacts"], row["not_reached"]), (4, 1.0, 0, 0), row)
            self.assertLessEqual(row["score"], 0.5)
        self.assertGreater(rows["sampled"]["score"], 0.45)

    def test_gives_the_same_bytes_again(self):
        once = self.run_tool("bench", "barn", "--data", ".", "--worlds", "0", "--seeds", "2", "--rules", "sampled", "--json")
        again = self.run_tool("bench", "barn", "--data", ".", "--worlds", "0", "--seeds", "2", "--rules", "sampled", "--json")
        self.assertEqual(self.json_of(once)["rows"], self.json_of(again)["rows"])

    def test_refusals(self):
        for args, sentence in ((["--data", "nowhere"], "static_even.json.gz"), (["--data", ".", "--rules", "sample"], "sampled"),
                               (["--data", ".", "--worlds", "7"], "--worlds")):
            result = self.run_tool("bench", "barn", *args)
            self.assertEqual(result.returncode, 2, args)
            self.assertIn(sentence, result.stderr)
        (self.folder / "static_even.json.gz").write_text('{"radius_m": 1}')
        result = self.run_tool("bench", "barn", "--data", ".")
        self.assertEqual(result.returncode, 2)
        self.assertIn("BARN", result.stderr)


if __name__ == "__main__":
    main()
