"""`outrider research`: the tool with reference methods."""
import json

from tool import ToolTest, main

# The robot at the left end waits on its cheap cell until the target stands still at the right end.
SMALL = "N\n4,1\nC\n9\nR\n1,1\nT\n" + "4 , 1\n" * 6 + "M\n1.0\n5.0\n 5\n7\n"


class Research(ToolTest):
    def pursue(self, *args):
        result = self.run_tool("research", "pursue", "small.txt", *args, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return self.json_of(result)["metrics"]

    def test_the_tool_itself_does_not_know_them(self):
        self.write("small.txt", SMALL)
        self.refused("pursue", "small.txt", "--planner", "rtaa_star", says=["rtaa_star"])

    def test_pursuits(self):
        self.write("small.txt", SMALL)
        rows = json.loads(self.run_tool("research", "list", "--json").stdout)["pursuit_planners"]
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
        self.refused("research", "pursue", "small.txt", "--rtaa-star-lookahead", "0", says=["--rtaa-star-lookahead", "from 1"])


main()
