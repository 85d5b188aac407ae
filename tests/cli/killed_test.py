"""A run that is killed at any moment leaves a log that opens up to its last complete chunk."""
import random
import subprocess

from held_run import HeldRun
from tool import SOURCE, TOOL, ToolTest, costly_cases, main
from well_logged import well_logged

SCENARIO = SOURCE / "scenarios/explore/unknown_yard.yaml"


class Killed(ToolTest):
    def started(self, folder):
        return HeldRun("run", SCENARIO, "--out", folder, cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def test_the_log_opens_up_to_there(self):
        """It is killed when it has told a part of its log, and cannot go on to its end before somebody reads the rest."""
        with self.started("whole") as run:
            told_bytes = len(run.read(1 << 40))
        self.assertIn(run.returncode, (0, 1))
        well_logged(self, "whole")
        whole = (self.folder / "whole/run.mcap").read_bytes()
        rng = random.Random(11)
        replayed = 0
        for i in range(costly_cases(6)):
            with self.started(f"k{i}") as run:
                run.read(int(told_bytes * rng.uniform(0.0, 0.9)))
                run.kill()
            self.assertEqual(run.returncode, -9)
            log = self.folder / f"k{i}/running.mcap"
            if not log.exists():
                continue  # its mission had not begun
            self.assertEqual(whole[:log.stat().st_size], log.read_bytes(), "a part of the whole log")
            replay = self.run_tool("replay", f"k{i}")
            if log.stat().st_size == len(whole):
                self.assertEqual(replay.returncode, 0, "killed when its log was complete")
                self.assertNotIn("cut short", replay.stdout)
            elif replay.returncode == 0:
                replayed += 1
                self.assertIn("log ends early", replay.stderr)
                if "cut short" not in replay.stdout:
                    self.assertIn(b"run.json", log.read_bytes(), "only the index at its end is missing")
            else:
                self.assertEqual(replay.returncode, 2)
                self.assertIn("cut short before its first messages", replay.stderr)
        self.assertGreater(replayed, 1, "some had a complete chunk")

    def test_the_next_run_takes_the_file_over(self):
        (self.folder / "out").mkdir()
        (self.folder / "out/running.mcap").write_bytes(b"left by a run that was killed")
        self.assertEqual(self.run_tool(*self.guard("--out", "out")).returncode, 0)
        self.assertEqual([path.name for path in (self.folder / "out").glob("*.mcap")], ["run.mcap"])

    def test_two_runs_in_one_folder(self):
        """Each writes a log of its own; the one that ends last has its name."""
        runs = [subprocess.Popen([TOOL, *map(str, self.guard("--out", "out", "--seed", str(seed)))], cwd=self.folder,
                                 stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) for seed in (1, 2)]
        self.assertEqual([run.wait() for run in runs], [0, 0])
        self.assertEqual([path.name for path in (self.folder / "out").glob("*.mcap")], ["run.mcap"])
        self.assertEqual(self.run_tool("replay", "out").returncode, 0)

    def test_the_scenario_is_in_the_log(self):
        self.assertEqual(self.run_tool(*self.guard("--out", "out")).returncode, 0)
        data = (self.folder / "out/run.mcap").read_bytes()
        self.assertIn(b"scenario.yaml", data)
        self.assertIn(b'job: "guard"', data)


if __name__ == "__main__":
    main()
