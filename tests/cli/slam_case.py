"""The base of the tests of `outrider slam`: runs, their results, and the checks of a log."""
import math

from mcap_log import xyz
from tool import ToolTest, flat

KEYS = {"landmark_rmse_m", "landmark_rmse_aligned_m", "ate_m", "cost", "steps", "time_s", "max_step_s"}
MACHINE_TIMES = {"time_s", "max_step_s", "median_step_s", "real_time_factor"}  # printed, and in no file


def path_of(path):
    """(time, x, y) of each pose of a nav_msgs/Path."""
    return [(one.header.stamp.sec + one.header.stamp.nanosec / 1e9, *xyz(one.pose.position)[:2]) for one in path.poses]


class SlamCase(ToolTest):
    def result(self, *args):
        run = self.run_tool("slam", *args, "--json")
        self.assertEqual(run.returncode, 0, run.stderr)
        found = flat(self.json_of(run))
        self.assertEqual((found["status"], found["job"]), ("done", "slam"))
        self.assertLessEqual(KEYS, set(found))
        return found

    def rows(self, folder):
        """The columns x, y of track.csv."""
        lines = (self.folder / folder / "track.csv").read_text().splitlines()
        at = lines[0].split(",").index("x")
        return [[float(value) for value in line.split(",")[at:at + 2]] for line in lines[1:]]

    def check_log(self, found, folder, track):
        """The files say what was printed, and the settled path is that of track.csv."""
        result, log = self.result_of(folder), self.log_of(folder)
        self.assertEqual((result["job"], result["status"]), ("slam", found["status"]))
        self.assertEqual(found["log"], f"{folder}/run.mcap")
        for name, value in found.items():
            if isinstance(value, (int, float)) and name not in MACHINE_TIMES:
                self.assertEqual(result["metrics"][name], value, name)
        self.assertFalse(MACHINE_TIMES & {name for name, value in result["metrics"].items() if value is not None})
        settled, beliefs = path_of(log.latest("/trajectory")), log.read("/belief")
        self.assertEqual(len(settled), len(beliefs))
        self.assertEqual(len(log.of("/odom")), len(beliefs))
        self.assertEqual(len(settled), len(track))
        for (_, *place), (x, y) in zip(settled, track):
            self.assertLess(math.dist(place, (x, y)), 2e-6)
        self.assertEqual([time for time, _ in beliefs], [time for time, *_ in settled])
        info = log.latest("/run")
        self.assertTrue(all(info.low.x < x < info.high.x and info.low.y < y < info.high.y for _, x, y in settled))
        return log

    def done(self, *args):
        run = self.run_tool("slam", *args, "--json")
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        return flat(self.json_of(run))

    def doubtful(self, *args):
        run = self.run_tool("slam", *args, "--json")
        self.assertEqual(run.returncode, 1, run.stderr)
        found = flat(self.json_of(run))
        self.assertEqual(found["status"], "doubtful")
        return found
