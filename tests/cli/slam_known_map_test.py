"""`outrider slam LOG --map MAP`: the robot of a laser log on a map that is known."""
import math

import laser_logs
from slam_case import SlamCase
from tool import DATA, SOURCE, flat, main


class SlamKnownMapTest(SlamCase):
    NAME = "freiburg-101"
    FIRST, CUT = 60, 90  # of the scans: where the log begins, and how many are missing later

    def steps(self):
        path = DATA / "slam" / "lidar" / f"{self.NAME}-corrected.log.gz"
        if not path.exists():
            self.skipTest(f"{path} is absent; set OUTRIDER_DATA")
        return laser_logs.read(path)

    def mapped(self, steps):
        """Maps the whole log; returns the position at each scan."""
        self.write("whole.log", laser_logs.text(steps))
        self.assertEqual(self.run_tool("slam", "whole.log", "--out", "whole").returncode, 0)
        return self.rows("whole")

    def located(self, log, *args, status="done"):
        run = self.run_tool("slam", log, "--map", "whole/map.yaml", "--out", "found", "--json", *args)
        found = flat(self.json_of(run))
        self.assertEqual((found["status"], run.returncode), (status, 0 if status == "done" else 1), run.stderr)
        return found

    def track(self):
        """(number of the scan, x, y) of each scan at which the robot was located."""
        lines = (self.folder / "found" / "track.csv").read_text().splitlines()[1:]
        return [(int(step), float(x), float(y)) for step, _, x, y, _ in (line.split(",") for line in lines)]

    def test_a_robot_that_is_carried_away_is_found_again(self):
        """The poses are those of the mapping, which knew the whole log; before it is found, none is given."""
        steps = self.steps()
        path = self.mapped(steps)
        at = self.FIRST + 60
        apart = math.dist(path[at - 1], path[at + self.CUT])
        self.assertGreater(apart, 4.0, "it is carried beyond what a scan is searched in")
        cut = laser_logs.without(steps, at, self.CUT)[self.FIRST:]
        cut[0] = cut[0].moved(motion=(0.0, 0.0, 0.0))
        self.write("cut.log", laser_logs.text(cut))
        found = self.located("cut.log")
        self.assertEqual((found["times_lost"], found["times_located"]), (1, 2))
        track = self.track()
        self.assertEqual(len(track), found["steps_located"])
        was_carried = at - self.FIRST
        for step, x, y in track:
            then = step + self.FIRST + (self.CUT if step >= was_carried else 0)
            self.assertLess(math.dist((x, y), path[then]), 0.15, step)
        without = set(range(len(cut))) - {step for step, _, _ in track}
        after = [step for step in without if step >= was_carried]
        self.assertTrue(after and len(after) < 25, "some scans tell that it was carried, others where to")
        self.assertIn("lost", self.sentences("found"))

    def sentences(self, folder):
        return " ".join(f"{event.name} {event.msg}" for _, event in self.log_of(folder).read("/rosout"))

    def test_the_log_shows_the_map_and_where_the_robot_was(self):
        steps = self.steps()[:150]
        self.mapped(steps)
        found = self.located("whole.log")
        track = [(x, y) for _, x, y in self.track()]
        log = self.log_of("found")
        self.assertEqual(len(log.of("/map")), 1)
        self.assertEqual(len(log.read("/belief")), found["steps_located"])
        self.assertEqual(len(log.of("/scan")), 150)
        self.assertEqual(len(track), found["steps_located"])
        self.assertTrue((self.folder / "found" / "trajectory.tum").read_text())
        first = (self.folder / "found" / "track.csv").read_bytes()
        self.located("whole.log")
        self.assertEqual((self.folder / "found" / "track.csv").read_bytes(), first)

    def test_on_the_map_of_another_building_it_is_nowhere(self):
        self.mapped(self.steps()[:60])
        office = laser_logs.read(SOURCE / "scenarios" / "slam" / "office.log.gz")[:200]
        self.write("office.log", laser_logs.text(office))
        found = self.located("office.log", status="not_done")
        self.assertEqual(found["steps_located"], 0)
        self.assertIn("no place of the map fits what it saw, or several do", found["reason"])

    def test_refusals(self):
        self.mapped(self.steps()[:40])
        self.refused("slam", SOURCE / "scenarios" / "slam" / "posts.dat", "--map", "whole/map.yaml",
                     says=["map: ", "only the robot of a laser log is localised on a map"])
        self.refused("slam", "whole.log", "--map", "none.yaml", says=["none.yaml"])
        self.refused("slam", "whole.log", "--map", SOURCE / "scenarios" / "maps" / "gallery.map",
                     says=["gallery.map: ", "no occupied and unknown cells"])
        self.write("empty.yaml", "image: empty.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n"
                                 "occupied_thresh: 0.65\nfree_thresh: 0.196\n")
        self.write("empty.pgm", "P2 2 2 255 254 254 254 254\n")
        self.refused("slam", "whole.log", "--map", "empty.yaml", says=["empty.yaml: ", "no occupied cell beside a free one"])
        self.write("wide.yaml", (self.folder / "empty.yaml").read_text().replace("empty", "wide").replace("0.05", "10"))
        self.write("wide.pgm", "P2 60 1 255 0 " + "254 " * 58 + "0")
        self.refused("slam", "whole.log", "--map", "wide.yaml", says=["wide.yaml: ", "590 m by 0 m", "at most 500 m by 500 m"])


if __name__ == "__main__":
    main()
