"""`outrider convert`: the messages of a run as JSON lines and as numpy arrays say the same."""
import base64
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy

TOOL = os.environ["OUTRIDER"]
SCENARIO = pathlib.Path(__file__).parents[2] / "scenarios" / "waypoints" / "closed_loop.yaml"
NOT_FINITE = {"NaN": float("nan"), "Infinity": float("inf"), "-Infinity": float("-inf")}


def convert(*arguments):
    return subprocess.run([TOOL, "convert", *map(str, arguments)], capture_output=True, text=True)


class Convert(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.folder_of_run = pathlib.Path(cls.folder.name) / "run"
        subprocess.run([TOOL, "run", SCENARIO, "--out", cls.folder_of_run],
                       check=True, capture_output=True)
        cls.lines = cls.folder_of_run / "run.jsonl"
        cls.npz = cls.folder_of_run / "run.npz"
        for path in (cls.lines, cls.npz):
            done = convert(cls.folder_of_run, path)
            assert done.returncode == 0, done.stderr

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def same(self, value, record, arrays, path):
        """Asserts that a value of JSON is that of a field of a record; `path` is its place."""
        if isinstance(value, dict):
            self.assertEqual(list(value), list(record.dtype.names), path)
            for name in value:
                self.same(value[name], record[name], arrays, f"{path}/{name}")
            return
        if record.dtype.names == ("begin", "end"):  # a sequence
            elements = arrays[path][record["begin"]:record["end"]]
            if isinstance(value, str):  # of bytes
                value = list(base64.b64decode(value))
            self.assertEqual(len(value), len(elements), path)
            for inner, element in zip(value, elements):
                self.same(inner, element, arrays, path)
        elif isinstance(value, list):
            self.assertEqual(len(value), len(record), path)
            for inner, element in zip(value, record):
                self.same(inner, element, arrays, path)
        elif record.dtype.kind == "f":
            numpy.testing.assert_equal(record.dtype.type(NOT_FINITE.get(value, value)), record, path)
        else:
            self.assertEqual(value, record.item(), path)

    def test_every_message_is_the_same_in_both(self):
        arrays = dict(numpy.load(self.npz))
        rows = {}
        count = 0
        for line in self.lines.read_text().splitlines():
            message = json.loads(line)
            name = message["topic"][1:]
            row = rows[name] = rows.get(name, -1) + 1
            record = arrays[name][row]
            self.assertEqual(record["time_ns"], message["time_ns"])
            self.same(message["message"], record["message"], arrays, name)
            count += 1
        self.assertGreater(count, 100)
        self.assertGreater(len(rows), 5)
        for name, row in rows.items():
            self.assertEqual(len(arrays[name]), row + 1, name)

    def test_poses_are_columns(self):
        """The path driven, from the array, has the length that run.json states."""
        arrays = numpy.load(self.npz)
        position = arrays["pose"]["message"]["pose"]["position"]
        length = numpy.hypot(numpy.diff(position["x"]), numpy.diff(position["y"])).sum()
        metrics = json.loads((self.folder_of_run / "run.json").read_text())["metrics"]
        self.assertAlmostEqual(length, metrics["driven_m"], delta=0.01 * length)

    def test_the_same_log_gives_the_same_bytes(self):
        for path in (self.lines, self.npz):
            again = self.folder_of_run / ("again" + path.suffix)
            self.assertEqual(convert(self.folder_of_run / "run.mcap", again).returncode, 0)
            self.assertEqual(again.read_bytes(), path.read_bytes())

    def test_a_topic_is_selected(self):
        path = self.folder_of_run / "tf.npz"
        self.assertEqual(convert(self.folder_of_run, path, "--topic", "/tf").returncode, 0)
        self.assertEqual({name.split("/")[0] for name in numpy.load(path)}, {"tf"})

    def test_bad_requests_are_refused_and_leave_nothing(self):
        other = self.folder_of_run / "other.txt"
        other.write_text("no log\n")
        log, new = self.folder_of_run, self.folder_of_run / "new"
        for arguments, sentence in (((log, f"{new}.npz", "--topic", "/nowhere"), "no topic '/nowhere'"),
                                    ((other, f"{new}.jsonl"), "not a log"),
                                    ((log, f"{new}.zip"), ".npz"),
                                    ((log, "/nowhere/new.jsonl"), "make it first"),
                                    ((log, "/nowhere/new.npz"), "make it first")):
            done = convert(*arguments)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(sentence, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertEqual(list(self.folder_of_run.glob("new*")), [])


if __name__ == "__main__":
    unittest.main()
