"""The line that says what long work is at: on a terminal, after a second, and nowhere else."""
import os
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


if __name__ == "__main__":
    main()
