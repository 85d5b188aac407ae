"""The tool with reference methods, outrider-research, which `outrider research` becomes."""
import json
import pathlib
import subprocess

from tool import TOOL, ToolTest, main

# The robot at the left end waits on its cheap cell until the target stands still at the right end.
SMALL = "N\n4,1\nC\n9\nR\n1,1\nT\n" + "4 , 1\n" * 6 + "M\n1.0\n5.0\n 5\n7\n"


class Research(ToolTest):
    def pursue(self, *args):
        result = self.run_tool("pursue", "small.txt", *args, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return self.json_of(result)["metrics"]

    def test_the_tool_becomes_it_and_does_not_know_them_itself(self):
        self.write("small.txt", SMALL)
        tool = pathlib.Path(TOOL).with_name("outrider")
        words = ["pursue", "small.txt", "--planner", "rtaa_star", "--json"]
        alone = subprocess.run([tool, *words], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(alone.returncode, 2)
        self.assertIn("rtaa_star", alone.stderr)
        both = [subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=True).stdout
                for command in ([tool, "research", *words], [TOOL, *words])]
        first, second = (json.loads(text)["metrics"]["cost"] for text in both)
        self.assertEqual(first, second)

    def test_pursuits(self):
        self.write("small.txt", SMALL)
        rows = json.loads(self.run_tool("list", "--json").stdout)["pursuit_planners"]
        names = [row["name"] for row in rows]
        self.assertEqual(names[2:], ["iterative_a_star", "multi_goal_a_star", "lrta_star", "rtaa_star"])
        for name in names:
            metrics = self.pursue("--planner", name)
            self.assertEqual((metrics["cost"], metrics["lower_bound"]), (11, 11), name)

    def test_options_are_flags(self):
        self.write("small.txt", SMALL)

        def expansions(*flags):
            return self.pursue("--planner", "rtaa_star", *flags)["expansions"]

        self.assertLess(expansions("--rtaa-star-lookahead", "1"), expansions())
        self.refused("pursue", "small.txt", "--rtaa-star-lookahead", "0", says=["--rtaa-star-lookahead", "from 1"])


main()
