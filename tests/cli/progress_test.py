"""The line that says what long work is at: on a terminal, after a second, and nowhere else."""
import json
import os
import pathlib
import pty
import re
import subprocess
import time
import unittest

from held_run import HeldRun

from tool import SOURCE, TOOL, ToolTest, main

YARD = ["run", str(SOURCE / "scenarios/yard/yard.yaml"), "--plan-resolution", "0.4", "--plan-iterations", "20",
        "--plan-aim-step", "0.3", "--plan-pitch-step", "10"]


def run_on_terminal(words, expected):
    """Status, standard output, and what a terminal that is standard error was sent. The run is held until what is
    expected was sent."""
    master, slave = pty.openpty()
    shown = b""
    with HeldRun(*words, stdout=subprocess.PIPE, stderr=slave) as run:
        os.close(slave)
        try:
            while True:
                if re.search(expected, shown):
                    run.let_go()
                shown += os.read(master, 4096)
        except OSError:  # the end of a terminal
            pass
        output = run.stdout.read()
    os.close(master)
    return run.returncode, output, shown


def has_terminals():
    """Returns true if the system can make one; a bare chroot cannot."""
    try:
        for end in pty.openpty():
            os.close(end)
    except OSError:
        return False
    return True


class Progress(ToolTest):
    @unittest.skipUnless(has_terminals(), "this system has no pseudo-terminals")
    def test_long_work_on_a_terminal(self):
        line = rb"\r\x1b\[K\[[#.]{20}\] [a-z ]+, [1-9]\d* s"
        status, output, shown = run_on_terminal(YARD, line)
        self.assertIn(status, [0, 1])
        self.assertRegex(shown, line)
        self.assertIn(b"] loading, 1 s", shown, "it is held before its first step")
        self.assertTrue(shown.endswith(b"\r\x1b[K"), shown[-80:])
        self.assertNotIn(b"\x1b", output)

    @unittest.skipUnless(has_terminals(), "this system has no pseudo-terminals")
    def test_short_work_on_a_terminal(self):
        status, _, shown = run_on_terminal(["list"], b"")
        self.assertEqual((status, shown), (0, b""))

    def test_no_terminal(self):
        with HeldRun(*YARD, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as run:
            time.sleep(1.5)  # a terminal would have a line by then
            run.let_go()
            output, errors = run.communicate()
        self.assertIn(run.returncode, [0, 1])
        self.assertEqual(errors, "")
        self.assertNotIn("\x1b", output)

    def test_names_are_told_as_json(self):
        """A name with quotes and a backslash stays one; each line is JSON."""
        name = 'a "quoted\\ graph.g2o'
        (self.folder / "graphs").mkdir()
        self.write(f"graphs/{name}", "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n")
        ours, its = os.pipe()
        subprocess.run([TOOL, "bench", "slam", "--data", "graphs"], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                       stdin=subprocess.DEVNULL, pass_fds=[its], env={**os.environ, "OUTRIDER_PROGRESS": str(its)}, check=False)
        os.close(its)
        with open(ours, encoding="utf-8") as told:
            lines = [json.loads(line) for line in told]
        self.assertIn(name, {pathlib.Path(line["name"]).name for line in lines})


if __name__ == "__main__":
    main()
