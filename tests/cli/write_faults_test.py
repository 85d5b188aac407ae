"""A disk that is full, or fails, and a lack of memory at each point of writing a run: the old folder stays whole, or the new
one is, and one sentence says which. Under `make soak` at every point of all, else at a seeded part of the allocations."""
import errno
import os
import random
import re
import shutil
import subprocess
import unittest

from tool import PAGE, TOOL, ToolTest, costly_cases, in_soak, main

LIBRARY = os.environ.get("OUTRIDER_FAILING_CALLS", "")
PLAN = ["plan", "small.map", "--from", "0.5,0.5", "--threads", "1", "--out", "out", *PAGE]
OLD, NEW = [*PLAN, "--to", "5.5,0.5"], [*PLAN, "--to", "5.5,3.5"]
DISK = {"open": errno.ENOSPC, "write": errno.ENOSPC, "short_write": 0, "fsync": errno.EIO, "close": errno.EIO,
        "rename": errno.EIO, "link": errno.ENOSPC, "fork": errno.EAGAIN}


@unittest.skipUnless(os.path.exists(LIBRARY), "OUTRIDER_FAILING_CALLS names no library")
class WriteFaults(ToolTest):
    def setUp(self):
        super().setUp()
        self.old, self.new = self.whole(OLD), self.whole(NEW)
        self.assertEqual(set(self.old), set(self.new))
        self.assertIn("run.mcap", self.new)
        self.assertTrue(all(self.old[name] != self.new[name] for name in ("run.json", "run.mcap", "run.svg")))

    def files(self):
        return {str(path.relative_to(self.folder / "out")): path.read_bytes()
                for path in (self.folder / "out").rglob("*") if path.is_file()}

    def whole(self, words):
        result = self.run_tool(*words)
        self.assertEqual(result.returncode, 0, result.stderr)
        return self.files()

    def run_with(self, call, at, lasts=False, folder=True):
        """The run with a call that fails, over the old folder or none. Returns it with the number of calls."""
        shutil.rmtree(self.folder / "out", ignore_errors=True)
        if folder:
            (self.folder / "out").mkdir()
            for name, content in self.old.items():
                (self.folder / "out" / name).write_bytes(content)
        environment = {**os.environ, "LD_PRELOAD": LIBRARY, "FAIL_CALL": call, "FAIL_AT": str(at), "FAIL_BENEATH": "out",
                       "FAIL_ERROR": str(DISK.get(call, errno.ENOMEM)), "FAIL_COUNT": str(self.folder / "count")}
        if lasts:
            environment["FAIL_LASTS"] = "1"
        result = subprocess.run([TOOL, *NEW], cwd=self.folder, env=environment, capture_output=True, text=True,
                                errors="replace", stdin=subprocess.DEVNULL, timeout=60)
        count = self.folder / "count"
        return result, int(count.read_text()) if count.exists() else 0

    def judge(self, result, folder, statuses, said):
        """Whole is the folder, and one sentence says what went wrong."""
        with self.subTest(said):
            self.assertIn(result.returncode, (0, *statuses), result.stderr)
            self.assertIn(self.files(), (self.old if folder else {}, self.new), f"half-written: {result.stderr}")
            if result.returncode == 0:
                self.assertEqual(self.files(), self.new)
                self.assertEqual(result.stderr, "")
            else:
                sentence = self.sentence(result)
                self.assertRegex(sentence, re.compile("cannot be written|not enough memory|no memory"))
                if 2 not in statuses:
                    self.assertNotEqual(self.files(), self.new, "it was written all the same")

    def test_the_disk_fails_at_each_point(self):
        failures = 0
        for call, error in DISK.items():
            calls = self.run_with(call, 0)[1]
            self.assertGreater(calls, 0, call)
            for at in range(1, calls + 1):
                for folder in (True, False):
                    for lasts in (False, True):
                        if call == "rename" and lasts and at > 1:
                            continue  # nothing brings the old names back then
                        if not in_soak() and (folder == lasts) == at % 2:
                            continue
                        result = self.run_with(call, at, lasts, folder)[0]
                        self.judge(result, folder, () if error == 0 or call == "fork" else (3,),
                                   (call, at, lasts, folder))
                        failures += result.returncode == 3
        self.assertGreater(failures, 20)

    def test_memory_ends_at_each_point(self):
        calls = self.run_with("malloc", 0)[1]
        self.assertGreater(calls, 100)
        most = costly_cases(16)
        points = range(1, calls + 1) if most >= 1000 else random.Random(62).sample(range(1, calls + 1), most)
        failures = 0
        for at in points:
            for lasts in (True, False):
                folder = at % 2 == 0
                result = self.run_with("malloc", at, lasts, folder)[0]
                if lasts:  # where not even a destructor finds memory, the log stays as after a kill
                    (self.folder / "out/running.mcap").unlink(missing_ok=True)
                self.judge(result, folder, (2, 3), ("malloc", at, lasts, folder))
                failures += lasts and result.returncode != 0
        self.assertGreater(failures, len(points) // 2)


if __name__ == "__main__":
    main()
