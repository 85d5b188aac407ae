"""Runs the tool as a stranger would, in a folder of its own with a small yard."""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import unittest

from mcap_log import McapLog

TOOL = os.environ["OUTRIDER"]
SOURCE = pathlib.Path(os.environ["OUTRIDER_SOURCE"])
DATA = pathlib.Path(os.environ.get("OUTRIDER_DATA") or SOURCE.parent / "shared" / "data")

# However busy the machine is, nothing that is waited for takes longer; who waits, waits for an event.
PATIENCE_S = 400

WALL = """<model name="{name}"><static>true</static><pose>{x} {y} 0.5 0 0 0</pose><link name="link">
<collision name="body"><geometry><box><size>{sx} {sy} 1</size></box></geometry></collision></link></model>
"""
FLOOR = """<model name="floor"><static>true</static><link name="link"><collision name="body">
<geometry><plane><normal>0 0 1</normal><size>20 20</size></plane></geometry></collision></link></model>
"""


def until(what, ask):
    """Asks again and again until the answer is true, and returns it."""
    end = time.monotonic() + PATIENCE_S
    while not (answer := ask()):
        if time.monotonic() > end:
            raise AssertionError(f"{what} does not come")
        time.sleep(0.01)
    return answer


def costly_cases(usual):
    """As testing::costly_cases() of the C++ tests."""
    return max(1, int(usual * float(os.environ.get("OUTRIDER_CASES") or 1)))


def in_soak():
    """True under `make soak`, which takes all cases and not a part."""
    return costly_cases(1) > 1


def world(*models):
    return ('<?xml version="1.0"?>\n<sdf version="1.6">\n<world name="court">\n<gravity>0 0 -9.8</gravity>\n'
            + "".join(models) + "</world>\n</sdf>\n")


def wall(name, x, y, sx, sy):
    return WALL.format(name=name, x=x, y=y, sx=sx, sy=sy)


FENCE = [wall("north", 0, 3, 6, 0.2), wall("south", 0, -3, 6, 0.2), wall("east", 3, 0, 0.2, 6),
         wall("west", -3, 0, 0.2, 6)]
YARD = world(FLOOR, *FENCE, wall("crate", 1, 1, 0.5, 0.5))
TARGETS = "type=1 x=-1.5 y=1\ntype=4 x=1 y=1 z=1\nname=fox size=0.3,0.3,0.3 x=1.8 y=1.9\n"
COARSE = ["--plan-resolution", "0.2", "--plan-iterations", "50", "--plan-refinements", "0"]

# A plan view: 6 x 4 cells with a wall from the top that leaves a gap in the lowest row.
MAP = "type octile\nheight 4\nwidth 6\nmap\n...@..\n...@..\n...@..\n......\n"


# A tool that was built without npm has no page, and says so.
NO_PAGE = "built without the page"
PAGE = [] if NO_PAGE in subprocess.run([TOOL, "replay", "none.json", "--html", "none.html"], capture_output=True,
                                       text=True, stdin=subprocess.DEVNULL, timeout=PATIENCE_S).stderr else ["--html"]


def flat(answer):
    """The answer with its metrics beside its other keys, and the path of its log."""
    return {**answer["metrics"], **answer, "log": answer["files"].get("log")}


class ToolTest(unittest.TestCase):
    maxDiff = None
    refused_in_text = set()  # the verbs

    def setUp(self):
        self.home = tempfile.TemporaryDirectory(prefix="outrider-cli-")
        self.addCleanup(self.home.cleanup)
        self.folder = pathlib.Path(self.home.name)
        self.write("yard.sdf", YARD)
        self.write("targets.txt", TARGETS)
        self.write("small.map", MAP)

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return name

    def run_tool(self, *args, timeout=PATIENCE_S):
        return subprocess.run([TOOL, *map(str, args)], cwd=self.folder, capture_output=True, text=True,
                              errors="replace", stdin=subprocess.DEVNULL, timeout=timeout)

    def tree(self):
        """Every file and folder with its bytes."""
        return {path.relative_to(self.folder): path.read_bytes() if path.is_file() else None
                for path in sorted(self.folder.rglob("*"))}

    def result_of(self, folder):
        """The run.json of a run."""
        return json.loads((self.folder / folder / "run.json").read_text())

    def log_of(self, folder):
        """The run.mcap of a run."""
        return McapLog((self.folder / folder / "run.mcap").read_bytes())

    def same_run(self, a, b):
        """Both runs left the same bytes."""
        for name in ("run.json", "run.mcap"):
            self.assertEqual((self.folder / a / name).read_bytes(), (self.folder / b / name).read_bytes(), (a, b, name))

    def same_mission(self, a, b):
        """Both runs came to the same, and logged the same messages; their settings may differ."""
        came_to = []
        for folder in (a, b):
            came_to.append(self.result_of(folder))
            del came_to[-1]["settings"]
        self.assertEqual(*came_to)
        self.assertEqual(self.log_of(a).messages, self.log_of(b).messages)

    def json_of(self, result):
        """The one object on standard output."""
        lines = result.stdout.splitlines()
        self.assertEqual(len(lines), 1, result.stdout + result.stderr)

        def no_constant(name):
            raise AssertionError(f"{name} is no JSON")

        return json.loads(lines[0], parse_constant=no_constant)

    def sentence(self, result):
        """Returns the line that standard error has beside warnings."""
        lines = [line for line in result.stderr.splitlines() if not line.startswith("outrider: warning: ")]
        self.assertEqual(len(lines), 1, result.stderr)
        self.assertTrue(lines[0].startswith("outrider: "), lines[0])
        self.assertNotIn("this is a bug", lines[0])
        return lines[0]

    def refused(self, *args, says, status=2):
        """Refused with one sentence that holds all of `says`, and as JSON; nothing is written. The first time that a
        verb is refused, and under `make soak` each time, it is refused as text too."""
        before = self.tree()
        forms = [] if args[:1] in (("schema",), ("serve",)) else [["--json"]]
        if not forms or args[:1] not in self.refused_in_text or in_soak():
            forms.append([])
            self.refused_in_text.add(args[:1])
        for json_flag in forms:
            result = self.run_tool(*args[:1], *json_flag, *args[1:])
            self.assertEqual(result.returncode, status, result.stderr)
            sentence = self.sentence(result)
            for word in says:
                self.assertIn(word, sentence)
            if json_flag:
                fault = self.json_of(result)
                self.assertEqual(fault["status"], "refused" if status == 2 else "not_done")
                self.assertIn(fault["reason"], sentence)
                self.assertIn(fault["where"], sentence)
                self.assertTrue(fault["code"])
            else:
                self.assertEqual(result.stdout, "")
        self.assertEqual(self.tree(), before, "something was written")

    def guard(self, *args):
        """Arguments of a guard mission in the small yard; later ones do not replace these."""
        given = [str(a) for a in args]
        base = {"--world": "yard.sdf", "--targets": "targets.txt", "--start": "0,-2,90"}
        words = ["guard"]
        for flag, value in base.items():
            if flag not in given:
                words += [flag, value]
        for flag, value in zip(COARSE[::2], COARSE[1::2]):
            if flag not in given:
                words += [flag, value]
        return words + given


def main():
    """Runs the tests of a script; with the word 2/3 the second third of each class of them."""
    part, parts = 1, 1
    if len(sys.argv) > 1 and re.fullmatch(r"\d+/\d+", sys.argv[1]):
        part, parts = map(int, sys.argv.pop(1).split("/"))

    class Part(unittest.TestLoader):
        def getTestCaseNames(self, case):
            return super().getTestCaseNames(case)[part - 1::parts]

    unittest.main(verbosity=1, testLoader=Part())
