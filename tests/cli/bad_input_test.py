"""Whatever is wrong with a request or a file: one sentence, exit status 2, nothing written."""
import fcntl
import gzip
import json
import os
import random
import resource
import subprocess
import time
import unittest

from held_run import HeldRun
from tool import FENCE, TARGETS, TOOL, YARD, ToolTest, costly_cases, main, world

SCENARIO = "job: guard\nworld: yard.sdf\ntargets: targets.txt\nstart: 0,-2,90\n"
GARBAGE = bytes(range(256)) * 8


class Words(ToolTest):
    def test_unknown_commands_and_flags_name_the_nearest(self):
        self.refused("gaurd", says=["'gaurd'", "'guard'", "outrider --help"])
        self.refused("guard", "--wrld", "x", says=["'--wrld'", "'--world'", "outrider guard --help"])
        self.refused("guard", "--robot-raduis=3", says=["'--robot-raduis'", "'--robot-radius'"])
        self.refused("plan", "small.map", "--form", "1,1", "--to", "2,2", says=["'--form'", "'--from'"])
        self.refused("guard", "extra", says=["'extra'", "outrider guard --help"])
        self.refused("replay", "a", "b", says=["'b'"])
        self.refused("-x", says=["'-x'"])
        self.refused("", says=["''"])

    def test_missing_words(self):
        self.refused(says=["--help"])
        self.refused("run", says=["scenario: it is missing"])
        self.refused("replay", says=["run: it is missing"])
        self.refused("plan", "small.map", "--from", "1,1", says=["to: it is missing"])
        self.refused("guard", "--seed", says=["--seed: its value is missing"])
        self.refused("guard", says=["world", "SDF"])
        self.refused("guard", "--world", "yard.sdf", says=["targets"])

    def test_a_flag_given_twice(self):
        self.refused("guard", "--seed", "1", "--seed", "2", says=["--seed", "2 times"])

    def test_values_that_are_none(self):
        for flag, value, remedy in [
                ("--seed", "x", "whole number from 0"), ("--seed", "-1", "whole number from 0"),
                ("--seed", "1.5", "whole number"), ("--seed", "1e30", "whole number"), ("--seed", "", "whole number"),
                ("--tries", "0", "from 1"), ("--tries", "99999999999999999999", "from 1 to 100"),
                ("--robot-radius", "-1", "from 0 to"), ("--robot-radius", "nan", "a number"),
                ("--robot-radius", "inf", "a number"), ("--robot-radius", "1e400", "a number"),
                ("--robot-radius", "0.2m", "a number"), ("--robot-speed", "0", "a number from"),
                ("--gun-pitch-high", "91", "deg"), ("--errors-speed", "0.6", "to 0.5"),
                ("--plan-resolution", "0", "from 0.005"), ("--plan-resolution", "1e-300", "from 0.005"),
                ("--plan-memory-cap", "0", "from 1"), ("--threads", "-1", "from 0 to 1024"),
                ("--threads", "nan", "from 0 to 1024")]:
            with self.subTest(flag=flag, value=value):
                self.refused(*self.guard(flag, value, "--out", "out"), says=[flag, f"'{value}'", remedy])
        self.refused(*self.guard("--targets-block=maybe"), says=["--targets-block", "'maybe'", "true or false"])

    def test_points_that_are_none(self):
        for value in ["nan,0,0", "0,inf,0", "1e9,0,0", "0,0", "0,0,0,0", "", "x", "0;0;0", "0,,0", "0,0,0 deg"]:
            with self.subTest(value=value):
                self.refused(*self.guard("--start", value, "--out", "out"), says=["start", f"'{value}'", "0,-9.5,90"])
        for value in ["0,0,1", "nan,0,1,1", "2,2,1,1", "1,1,1,1"]:
            with self.subTest(value=value):
                self.refused(*self.guard("--bounds", value, "--out", "out"), says=["bounds", f"'{value}'"])

    def test_pitches_the_wrong_way_round(self):
        self.refused(*self.guard("--gun-pitch-low", "10", "--gun-pitch-high", "-10", "--out", "out"),
                     says=["pitch_low", "swap"])

    def test_another_job(self):
        self.write("other.yaml", "job: explore\n")
        self.refused("guard", "--scenario", "other.yaml", says=["job", "'explore'", "guard"])
        self.write("other.yaml", "job: gaurd\n")
        self.refused("run", "other.yaml", says=["job", "'gaurd'", "did you mean 'guard'?"])

    def test_schema_of_an_unknown_form(self):
        self.refused("schema", "--as", "markdwn", says=["--as", "'markdwn'", "'markdown'"])


class Output(ToolTest):
    def test_a_page_without_a_folder(self):
        self.refused(*self.guard("--html"), says=["--html", "--out DIR"])
        self.refused(*self.guard("--out", ""), says=["--out", "''", "empty"])

    def test_a_folder_that_is_a_file(self):
        self.write("taken", "text")
        self.refused(*self.guard("--out", "taken"), says=["--out", "'taken'", "no folder"])
        self.refused(*self.guard("--out", "taken/deeper"), says=["--out", "'taken/deeper'", "no folder"])
        os.symlink("nowhere", self.folder / "dangling")
        self.refused(*self.guard("--out", "dangling"), says=["--out", "'dangling'"])

    @unittest.skipIf(os.geteuid() == 0, "root may write anywhere")
    def test_a_folder_that_is_closed(self):
        (self.folder / "closed").mkdir(mode=0o500)
        self.refused(*self.guard("--out", "closed/out"), says=["--out", "closed"])

    def test_refused_before_any_work(self):
        self.refused("guard", "--out", "yard.sdf", says=["--out"])

    def test_a_folder_in_the_place_of_a_file(self):
        (self.folder / "out" / "run.svg").mkdir(parents=True)
        self.refused(*self.guard("--out", "out"), says=["out/run.svg", "folder"])

    def test_standard_output_that_is_full(self):
        if os.path.exists("/dev/full"):
            with open("/dev/full", "w") as full:
                result = subprocess.run([TOOL, "list"], stdout=full, stderr=subprocess.PIPE, text=True)
            self.assertEqual(result.returncode, 3)
            self.assertIn("standard output", result.stderr)

    def test_a_full_disk_is_no_wrong_request_and_changes_nothing(self):
        first = self.run_tool(*self.guard("--out", "out"))
        self.assertIn(first.returncode, (0, 1))
        before = self.tree()
        full = subprocess.run([TOOL, *map(str, self.guard("--out", "out", "--seed", "9", "--json"))], cwd=self.folder,
                              capture_output=True, text=True,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (5000, 5000)))
        self.assertEqual(full.returncode, 3, full.stderr)
        self.assertEqual(self.tree(), before)
        said = json.loads(full.stdout)
        self.assertEqual((said["status"], said["code"]), ("not_written", "cannot_write"))
        self.assertIn("out/run", said["where"])

    def test_killed_while_it_writes(self):
        """All old files or all new ones; the two runs differ by their seed, which stands in each."""
        folder = self.folder / "out"
        self.assertIn(self.run_tool(*self.guard("--out", "out", "--seed", "1")).returncode, (0, 1))
        versions = [{path.name: path.read_bytes() for path in folder.iterdir()}]
        self.run_tool(*self.guard("--out", "other", "--seed", "2"))
        versions.append({path.name: path.read_bytes() for path in (self.folder / "other").iterdir()})
        self.assertEqual([name for name in versions[0] if versions[0][name] == versions[1][name]], [], "all differ")
        def started(seed):
            return HeldRun(*self.guard("--out", "out", "--seed", seed), cwd=self.folder, stdout=subprocess.DEVNULL,
                           stderr=subprocess.DEVNULL)

        # The files are written after the end of the log was told: that begins a measured time before the run is over.
        with started(1) as run:
            told_bytes = len(run.read(1 << 40))
        with started(1) as run:
            run.read(told_bytes)
            begin = time.monotonic()
        writing_s = time.monotonic() - begin
        rng = random.Random(5)
        killed = 0
        for i in range(costly_cases(10)):
            with started(1 + i % 2) as run:
                if i % 3:
                    run.read(told_bytes)
                    time.sleep(writing_s * rng.uniform(0.0, 1.0))
                else:
                    run.read(told_bytes // 2)  # it waits for somebody to read the rest
                run.kill()
            killed += run.returncode == -9
            lock = os.open(folder, os.O_RDONLY)
            fcntl.flock(lock, fcntl.LOCK_EX)  # the renaming may be under way
            os.close(lock)
            self.assertIn({path.name: path.read_bytes() for path in folder.iterdir() if path.suffix != ".part" and path.name != "running.mcap"}, versions)
        self.assertGreaterEqual(killed, costly_cases(10) / 3, "it was killed while it worked")
        self.run_tool(*self.guard("--out", "out", "--seed", "1"))
        self.assertEqual({path.name: path.read_bytes() for path in folder.iterdir()}, versions[0], "and nothing is left behind")


class Files(ToolTest):
    def refused_world(self, content, says):
        self.write("bad.sdf", content)
        self.refused(*self.guard("--world", "bad.sdf", "--out", "out"), says=says)

    def refused_targets(self, content, says):
        self.write("bad.txt", content)
        self.refused(*self.guard("--targets", "bad.txt", "--out", "out"), says=says)

    def test_missing_files_and_folders(self):
        (self.folder / "folder").mkdir()
        for flag in ["--world", "--targets", "--scenario"]:
            self.refused(*self.guard(flag, "none", "--out", "out"), says=["none", "no such file"])
            self.refused(*self.guard(flag, "folder", "--out", "out"), says=["folder"])
        self.refused("run", "none.yaml", says=["none.yaml", "no such file"])

    def test_garbage_as_every_kind_of_file(self):
        self.write("garbage", GARBAGE)
        for flag in ["--world", "--targets", "--scenario"]:
            self.refused(*self.guard(flag, "garbage", "--out", "out"), says=["garbage"])
        self.refused("replay", "garbage", "--svg", "p.svg", says=["garbage"])
        for kind in ["sdf", "world", "map", "yaml"]:
            name = self.write(f"garbage.{kind}", GARBAGE)
            self.refused("plan", name, "--from", "1,1", "--to", "2,2", "--out", "out", says=[name])

    def test_empty_files(self):
        self.write("empty", "")
        self.refused(*self.guard("--world", "empty"), says=["empty"])
        self.refused(*self.guard("--targets", "empty"), says=["empty"])
        self.refused("run", "empty", says=["empty", "job", "missing"])
        self.refused("replay", "empty", says=["empty"])

    def test_gzip_cut_short(self):
        for flag, content in [("--world", YARD), ("--targets", TARGETS * 50), ("--scenario", SCENARIO)]:
            self.write("cut.gz", gzip.compress(content.encode())[:-12])
            self.refused(*self.guard(flag, "cut.gz", "--out", "out"), says=["cut.gz", "gzip"])
            self.write("whole.gz", gzip.compress(content.encode()))
        self.assertEqual(self.run_tool(*self.guard("--scenario", "whole.gz")).returncode, 0)

    def test_worlds(self):
        self.refused_world(YARD.replace("</world>", ""), ["bad.sdf:"])
        self.refused_world("<html><body/></html>", ["bad.sdf", "<html>", "<sdf>"])
        self.refused_world(world(*FENCE), ["bad.sdf", "floor"])
        self.refused_world(world(), ["bad.sdf"])
        self.refused_world(YARD.replace("<pose>1 1 0.5", "<pose>nan 1 0.5"), ["bad.sdf", "nan"])
        self.refused_world(YARD.replace("<pose>1 1 0.5", "<pose>1e300 1 0.5"), ["bad.sdf"])
        self.refused_world(YARD.replace("<size>0.5 0.5", "<size>inf 0.5"), ["bad.sdf"])
        self.refused_world(YARD.replace("<size>0.5 0.5", "<size>-0.5 0.5"), ["bad.sdf", "crate", "size", "above 0"])
        self.refused_world(YARD.replace("<gravity>0 0 -9.8", "<gravity>0 0 nan"), ["bad.sdf", "gravity"])
        self.refused_world(YARD.replace("<gravity>0 0 -9.8", "<gravity>3 0 -9.8"), ["bad.sdf", "gravity"])

    def test_targets(self):
        self.refused_targets("# none\n", ["bad.txt"])
        self.refused_targets("type=9 x=0 y=0\n", ["bad.txt:1", "9"])
        self.refused_targets(TARGETS + "type=1 x=nan y=0\n", ["bad.txt:4", "nan"])
        self.refused_targets(TARGETS + "type=1 x=1e99 y=0\n", ["bad.txt:4", "1e99"])
        self.refused_targets("type=1 x=0\n", ["bad.txt:1", "y"])
        self.refused_targets("type=1 x=0 y=0 w=2\n", ["bad.txt:1", "w"])
        self.refused_targets("name=a x=0 y=0 size=0,1,1\n", ["bad.txt:1", "0,1,1"])
        self.refused_targets("name=a type=1 x=0 y=0\nname=a type=1 x=1 y=0\n", ["bad.txt:2", "a"])
        self.refused_targets("type=1 x=0 y=0\n" * 100_001, ["bad.txt", "100"])

    def test_a_target_inside_a_wall(self):
        self.refused_targets("name=mole type=1 x=1 y=1 z=0.2\n", ["mole", "crate", "move it out"])

    def test_starts(self):
        self.refused(*self.guard("--start", "1,1,0", "--out", "out"), says=["start", "(1, 1)", "obstacle"])
        self.refused(*self.guard("--start", "50,0,0", "--out", "out"), says=["start", "(50, 0)", "outside"])
        self.refused(*self.guard("--robot-radius", "50", "--out", "out"), says=["start", "50 m"])

    def test_a_resolution_beyond_the_memory_cap(self):
        self.refused(*self.guard("--plan-resolution", "0.01", "--plan-memory-cap", "1", "--out", "out"),
                     says=["plan.resolution", "0.01", "1 MiB", "coarser"])
        self.refused(*self.guard("--bounds", "-1e6,-1e6,1e6,1e6", "--plan-resolution", "0.005", "--out", "out"),
                     says=["plan.resolution", "MiB"])


class Scenarios(ToolTest):
    def refused_scenario(self, content, says):
        self.write("bad.yaml", content)
        self.refused("run", "bad.yaml", "--out", "out", says=["bad.yaml"] + says)

    def test_keys(self):
        self.refused_scenario(SCENARIO + "sed: 3\n", [":5", "'sed'", "'seed'"])
        self.refused_scenario(SCENARIO + "robot:\n  raduis: 3\n", [":6", "raduis", "'radius'"])
        self.refused_scenario(SCENARIO + "robt:\n  radius: 3\n", [":5", "'robt'", "'robot'"])
        self.refused_scenario(SCENARIO + "seed: 1\nseed: 2\n", [":6", "seed", "twice"])
        self.refused_scenario(SCENARIO + "robot: 3\n", ["robot", "section"])
        self.refused_scenario(SCENARIO + "seed: [1]\n", ["seed", "list"])
        self.refused_scenario(SCENARIO + "seed:\n", ["seed", "missing"])
        self.refused_scenario("- job\n", [])
        self.refused_scenario("job: guard\n---\njob: guard\n", [])
        self.refused_scenario("job: [", [])

    def test_values(self):
        self.refused_scenario(SCENARIO + "seed: 1.5\n", ["seed", "1.5", "whole number"])
        self.refused_scenario(SCENARIO + "robot:\n  radius: .nan\n", ["robot.radius", ".nan"])
        self.refused_scenario(SCENARIO + "robot:\n  radius: .inf\n", ["robot.radius", ".inf"])
        self.refused_scenario(SCENARIO + "robot:\n  radius: -1\n", ["robot.radius", "-1", "from 0"])
        self.refused_scenario(SCENARIO + "plan:\n  resolution: 1e-9\n", ["plan.resolution", "1e-9"])
        self.refused_scenario(SCENARIO + "targets_block: perhaps\n", ["targets_block", "perhaps", "true or false"])


if __name__ == "__main__":
    main()
