"""Intruders that survive hits, and intruders that walk about, from the command line."""
import unittest

from mcap_log import targets_of
from tool import COARSE, PAGE, ToolTest, main

FOXES = ("name=fox size=0.3,0.3,0.3 x=1.8 y=1.9\nname=hare size=0.3,0.3,0.3 x=-1.5 y=1\n"
         "name=boar size=0.4,0.4,0.4 x=1.5 y=-1.2\n")


class Movers(ToolTest):
    def setUp(self):
        super().setUp()
        self.write("foxes.txt", FOXES)

    def hunt(self, *args):
        return self.run_tool("guard", "--world", "yard.sdf", "--targets", "foxes.txt", "--start", "0,-2,90",
                             *COARSE, *args)

    def refused(self, result, where, words):
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn(where, result.stderr)
        self.assertIn(words, result.stderr)

    def test_who_survives_goes_elsewhere_and_the_time_is_expected(self):
        result = self.hunt("--arrivals-leave", "0.4", "--seed", "2", "--json", "--out", "out", *PAGE)
        self.assertEqual(result.returncode, 0, result.stderr)
        metrics = self.json_of(result)["metrics"]
        self.assertEqual(metrics["reached"], 3)
        self.assertGreater(metrics["expected_s"], metrics["expected_error_s"])
        log = self.log_of("out")
        survived = [event for _, event in log.read("/rosout") if event.name == "survive"]
        self.assertEqual(len(survived), metrics["survived"])
        self.assertGreater(len(survived), 0)
        self.assertEqual(sum((len(target.places) - 1) // 2 for target in targets_of(log).values()), len(survived))
        again = self.hunt("--arrivals-leave", "0.4", "--seed", "2", "--threads", "1", "--out", "again")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.same_run("out", "again")

    def test_when_all_leave_it_is_the_still_yard(self):
        for out, flags in [("still", []), ("leave", ["--arrivals-leave", "1"]), ("stay", ["--wander-speed", "0"])]:
            self.assertEqual(self.hunt("--out", out, *flags).returncode, 0)
        for out in ("leave", "stay"):
            self.same_mission(out, "still")

    def test_probabilities_without_an_end_are_refused(self):
        self.refused(self.hunt("--arrivals-leave", "0"), "arrivals.leave", "would not end")
        self.refused(self.hunt("--arrivals-leave", "1.5"), "arrivals-leave", "1.5")
        self.refused(self.hunt("--arrivals-leave", "-0.1"), "arrivals-leave", "-0.1")
        self.write("foxes.txt", FOXES.splitlines()[0] + "\n")
        self.refused(self.hunt("--arrivals-leave", "0.5"), "arrivals.leave", "two targets")

    def test_walkers_are_led_and_hit(self):
        self.write("history.csv", "t,id,x,y\n" + "".join(f"{t / 2},fox,1.5,-1.2\n" for t in range(60)))
        flags = ["--wander-speed", "0.4", "--wander-rest", "4", "--wander-history", "history.csv",
                 "--wander-prefers", "boar=9", "--json", *PAGE]
        result = self.hunt(*flags, "--out", "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.json_of(result)["metrics"]["reached"], 3)
        log = self.log_of("out")
        for target in targets_of(log).values():
            times = [time for time, _ in target.places]
            self.assertGreater(len(times), 1)
            self.assertEqual(times, sorted(times))
        leads = [event for _, event in log.read("/rosout") if event.name == "lead"]
        self.assertEqual(len(leads), len(log.of("/shots")))
        self.assertEqual(self.hunt(*flags, "--threads", "1", "--out", "again").returncode, 0)
        self.same_run("out", "again")

    def test_bad_walkers_are_refused(self):
        walk = ["--wander-speed", "0.4"]
        self.write("history.csv", "0,fox,1,1\n1,fox,one,1\n")
        self.refused(self.hunt(*walk, "--wander-history", "history.csv"), "history.csv:2", "t,id,x,y")
        self.refused(self.hunt(*walk, "--wander-history", "none.csv"), "none.csv", "none.csv")
        self.refused(self.hunt(*walk, "--wander-prefers", "fix=2"), "wander.prefers", "did you mean 'fox'")
        self.refused(self.hunt(*walk, "--arrivals-leave", "0.5"), "arrivals.leave", "walk about")
        self.refused(self.hunt(*walk, "--targets-block"), "targets_block", "walk about")
        self.write("foxes.txt", "name=fox size=0.3,0.3,0.3 x=1 y=1 z=1\n")
        self.refused(self.hunt(*walk), "wander.speed", "does not stand on the floor")


if __name__ == "__main__":
    main()
