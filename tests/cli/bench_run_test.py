"""The files that `make bench` writes for the docs site: one a program and suite, with command, machine and commit."""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from tool import SOURCE, main

PROGRAMS = {
    "bench_table": "#!/bin/sh\necho 'a | b'\necho '1 | 2'\n",
    "bench_timed": "#!/bin/sh\n# libbenchmark.so\nfor a; do case $a in --benchmark_out=*) out=${a#*=};; esac; done\n"
                   "echo '{\"benchmarks\": [{\"name\": \"Call/3\", \"real_time\": 5.5, \"time_unit\": \"ns\", \"other\": 1}]}' >$out\n",
    "bench_broken": "#!/bin/sh\nexit 1\n",
    "outrider": "#!/bin/sh\necho \"{\\\"rows\\\": [{\\\"suite\\\": \\\"$2\\\", \\\"time_s\\\": 1.5}]}\"\nexit 1\n",
}


class BenchRun(unittest.TestCase):
    def test_a_file_for_each(self):
        with tempfile.TemporaryDirectory() as folder:
            build, out = pathlib.Path(folder, "build"), pathlib.Path(folder, "out")
            (build / "bench").mkdir(parents=True)
            for name, text in PROGRAMS.items():
                program = build / ("bench" if name.startswith("bench") else "") / name
                program.write_text(text)
                program.chmod(0o755)
            environment = {key: value for key, value in os.environ.items() if key != "OUTRIDER_DATA"}
            done = subprocess.run([sys.executable, "-B", SOURCE / "bench/run.py", build, out, "table", "timed", "broken",
                                   "suite_cover"], env=environment, capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (1, "failed: broken\n"))
            written = {path.stem: json.loads(path.read_text()) for path in out.iterdir()}
        self.assertEqual(set(written), {"table", "timed", "suite_cover"})
        self.assertEqual(written["table"]["lines"], ["a | b", "1 | 2"])
        self.assertEqual(written["timed"]["benchmarks"], [{"name": "Call/3", "real_time": 5.5, "time_unit": "ns"}])
        self.assertEqual(written["suite_cover"]["rows"], [{"suite": "cover", "time_s": 1.5}])
        self.assertTrue(written["suite_cover"]["command"].endswith("outrider bench cover --seeds 1 --json"))
        for one in written.values():
            self.assertTrue(one["commit"] and one["date"] and one["machine"]["processor"] and one["machine"]["cores"] >= 1)

    def test_what_the_sources_have_is_of_that_kind(self):
        results = sorted((SOURCE / "docs/benchmarks/results").glob("*.json"))
        self.assertGreater(len(results), 2)
        for path in results:
            one = json.loads(path.read_text())
            self.assertEqual(one["name"], path.stem)
            self.assertTrue(any(one.get(kind) for kind in ("benchmarks", "rows", "lines")) and one["command"] and one["machine"])
            self.assertNotRegex(path.read_text(), rf"(?<!\w){re.escape(str(SOURCE))}/")


if __name__ == "__main__":
    main()
