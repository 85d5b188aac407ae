"""Water and charge that end, from the command line."""
import unittest

from tool import PAGE, SOURCE, ToolTest, main
from well_logged import well_logged

STATIONS = "--supplies-stations=well=-2,-2,water dock=0,-2.3,charge"


class Stations(ToolTest):
    def test_the_log_has_levels_stations_and_fills(self):
        result = self.run_tool(*self.guard(STATIONS, "--supplies-tank", "1", "--supplies-battery", "1", "--json",
                                           "--out", "out", *PAGE))
        self.assertEqual(result.returncode, 0, result.stderr)
        metrics = self.json_of(result)["metrics"]
        self.assertGreaterEqual(metrics["fills"], 1)
        self.assertGreaterEqual(metrics["least_water"], 0)
        self.assertGreaterEqual(metrics["least_charge_j"], 0)
        log = self.log_of("out")
        self.assertEqual([station.name for station in log.latest("/supplies").stations], ["well", "dock"])
        time, first = log.read("/stores")[0]
        self.assertEqual((time, first.water, first.charge), (0, 1, 3600))
        self.assertIn("fill", [event.name for _, event in log.read("/rosout")])
        self.assertIn(">well</text>", (self.folder / "out" / "run.svg").read_text())

    def test_without_ends_nothing_changes(self):
        for out, flags in [("plain", []), ("stations", [STATIONS])]:
            self.assertEqual(self.run_tool(*self.guard(*flags, "--out", out)).returncode, 0)
        self.same_mission("plain", "stations")

    def test_what_does_not_suffice_gets_a_reason_and_status_1(self):
        result = self.run_tool(*self.guard("--supplies-tank", "1", "--json"))
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("no station gives water", result.stdout)
        result = self.run_tool(*self.guard(STATIONS, "--supplies-battery", "0.03", "--json"))
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("and back to a charger", result.stdout)

    def test_what_is_wrong_gets_a_sentence(self):
        for flags, says in [
                (["--supplies-tank", "-1"], ["--supplies-tank", "'-1'"]),
                (["--supplies-tank", "1", "--supplies-shot-water", "2"], ["supplies.tank", "too small for any shot"]),
                (["--supplies-stations=well=1,1"], ["supplies.stations", "name=x,y,water"]),
                (["--supplies-stations=well=9,1,water"], ["supplies.stations", "outside the yard"]),
                (["--supplies-tank", "5", "--supplies-stations=well=1,1,water"], ["supplies.stations", "obstacle"]),
                (["--supplies-tank", "5", "--sim", "physics"], ["sim", "rigid bodies", "no tank and no battery"]),
                (["--supplies-tank", "5", "--wander-speed", "0.5"],
                 ["supplies", "wander.speed", "without stations"])]:
            with self.subTest(flags=flags):
                self.refused(*self.guard(*flags, "--out", "out"), says=says)

    def test_the_bundled_scenario(self):
        scenario = SOURCE / "scenarios" / "stations" / "stations.yaml"
        result = self.run_tool("run", scenario, "--json", "--plan-resolution", "0.2", "--out", "out")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        well_logged(self, "out")
        self.assertGreaterEqual(self.json_of(result)["metrics"]["fills"], 2)


if __name__ == "__main__":
    main()
