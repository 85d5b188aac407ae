"""The line that says what long work is at: on a terminal, after a second, and nowhere else."""
import json
import os
import pathlib
import pty
import subprocess
import unittest

from tool import SOURCE, TOOL, ToolTest, main

# Some seconds of work in the bundled yard.
LONG = [TOOL, "run", str(SOURCE / "scenarios/yard/yard.yaml"), "--plan-resolution", "0.15", "--threads", "1"]


def run_on_terminal(words):
    """Status, standard output, and what a terminal that is standard error was sent."""
    master, slave = pty.openpty()
    process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=slave, stdin=subprocess.DEVNULL)
    os.close(slave)
    output = process.stdout.read()
    shown = b""
    try:
        while chunk := os.read(master, 4096):
            shown += chunk
    except OSError:  # the end of a terminal
        pass
    os.close(master)
    process.stdout.close()
    return process.wait(), output, shown


def has_terminals():
    """Whether the system can make one; a bare chroot cannot."""
    try:
        for end in pty.openpty():
            os.close(end)
    except OSError:
        return False
    return True


class Progress(ToolTest):
    @unittest.skipUnless(has_terminals(), "this system has no pseudo-terminals")
    def test_long_work_on_a_terminal(self):
        status, output, shown = run_on_terminal(LONG)
        self.assertIn(status, [0, 1])
        self.assertRegex(shown, rb"\r\x1b\[K\[[#.]{20}\] [a-z ]+, [1-9]\d* s")
        self.assertTrue(shown.endswith(b"\r\x1b[K"), shown[-80:])
        self.assertNotIn(b"\x1b", output)

    @unittest.skipUnless(has_terminals(), "this system has no pseudo-terminals")
    def test_short_work_on_a_terminal(self):
        status, _, shown = run_on_terminal([TOOL, "list"])
        self.assertEqual((status, shown), (0, b""))

    def test_no_terminal(self):
        result = self.run_tool(*LONG[1:], timeout=300)
        self.assertIn(result.returncode, [0, 1])
        self.assertEqual(result.stderr, "")
        self.assertNotIn("\x1b", result.stdout)

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
