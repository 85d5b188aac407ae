"""The log of every bundled scenario is in order: here, or where another test runs it anyway."""
from tool import SOURCE, ToolTest, main
from well_logged import well_logged

# Tests that run a scenario and call well_logged() for it.
ELSEWHERE = {"arena/safest": "arena", "arena/shortest": "arena", "arrivals/arrivals": "arrivals", "cover/cover_field": "cover",
             "cover/cover_mower": "cover", "cover/cover_room": "cover", "driveby/driveby": "driveby", "explore/office": "slam_laser", "explore/unknown_yard": "killed", "hill/hill": "terrain",
             "orchard/orchard": "guard_air", "stations/stations": "stations", "waypoints/closed_loop": "drive", "wind/wind": "guard_air",
             "yard/two_robots": "team", "yard/yard": "guard"}
ANY_ORDER = ["--order-iterations", "100", "--order-gap", "1"]
# Flags that leave work out which a log does not show.
FLAGS = {"cover/cover_things": ["--width", "0.6", *ANY_ORDER], "cover/cover_tractor": ["--width", "16", *ANY_ORDER],
         "explore/cave": ["--laser-beams", "90"], "explore/narrow_corridor": ["--laser-beams", "90"],
         "parking/car_drive": ["--laser-beams", "60"]}


def scenarios():
    """Each scenario by its folder and name."""
    found = sorted((SOURCE / "scenarios").glob("*/*.yaml"))
    return {f"{path.parent.name}/{path.stem}": path for path in found
            if any(line.startswith("job:") for line in path.read_text().splitlines())}


class RunLog(ToolTest):
    def test_that_there_are_scenarios(self):
        self.assertGreater(len(scenarios()), 20)

    def test_the_others_are_checked_where_they_run(self):
        for name, script in ELSEWHERE.items():
            text = (SOURCE / f"tests/cli/{script}_test.py").read_text()
            self.assertIn(name.split("/")[1], text)
            self.assertIn("well_logged(self, ", text)


def test_of(name, path):
    def test(self):
        result = self.run_tool("run", path, *FLAGS.get(name, []), "--out", "out")
        self.assertIn(result.returncode, (0, 1), result.stderr)
        well_logged(self, "out", leaks=path.name == "leaking_yard.yaml")
    return test


for name, path in scenarios().items():
    if name not in ELSEWHERE:
        setattr(RunLog, f"test_{name.replace('/', '_')}", test_of(name, path))


if __name__ == "__main__":
    main()
