"""guard --sim physics from outside: rigid bodies where the engine is built in, a sentence where it is not."""
import unittest

from tool import PAGE, ToolTest, main


class Physics(ToolTest):
    def carried_out(self, *flags):
        """The result of a run in the engine; skips the test where the build has none."""
        result = self.run_tool(*self.guard("--sim", "physics", *flags))
        if result.returncode == 2 and "physics engine" in result.stderr:
            self.assertIn("install", result.stderr)
            self.skipTest(result.stderr.strip())
        return result

    def test_log_and_summary_say_what_carried_it_out(self):
        result = self.carried_out("--json", "--out", "a")
        summary = self.json_of(result)
        self.assertGreater(summary["metrics"]["physics_s"], 0)
        self.assertEqual(summary["status"], "done")
        self.assertEqual(summary["metrics"]["reached"], 3)
        self.assertLess(summary["metrics"]["arrival_error_max_m"], 0.01)
        self.assertIn("times real time", self.carried_out().stdout)
        self.assertEqual(self.log_of("a").latest("/run").sim, "physics")
        self.assertEqual(self.result_of("a")["settings"]["sim"], "physics")

    def test_the_same_seed_gives_the_same_bytes(self):
        self.carried_out("--seed", "3", "--out", "a", *PAGE)
        self.carried_out("--seed", "3", "--out", "b", "--threads", "1")
        self.same_run("a", "b")
        self.assertEqual((self.folder / "a/guard.html").exists(), bool(PAGE))

    def test_a_kinematic_run_has_no_sim(self):
        summary = self.json_of(self.run_tool(*self.guard("--sim", "kinematic", "--json", "--out", "a")))
        self.assertNotIn("sim", summary)
        self.assertEqual(self.log_of("a").latest("/run").sim, "")

    def test_what_it_is_refused_for(self):
        self.refused(*self.guard("--sim", "magic"), says=["sim", "'magic'", "kinematic, navigator or physics"])
        self.carried_out()
        for flags in [("--air-drag", "0.02"), ("--arrivals-leave", "0.5"), ("--supplies-tank", "5")]:
            self.refused(*self.guard("--sim", "physics", *flags), says=["sim", "rigid bodies", "do not go together"])


if __name__ == "__main__":
    main()
