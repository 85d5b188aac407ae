"""Sweeps: one table, from one process, from many, from killed ones, with MPI and with Dask; and what is refused."""
import csv
import functools
import hashlib
import importlib.util
import json
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

from tool import SOURCE, TOOL, ToolTest, main, until

PLAN = 'job: plan\nmap: small.map\nfrom: "0.5,0.5"\nto: "5.5,0.5"\nplanner: theta_star\n'
VARY = ["--vary", "to=uniform(0.5,5.5),uniform(0.5,3.5)", "--vary", "planner=a_star,theta_star"]
SWEEP = ["sweep", "plan.yaml", "--runs", "100", "--seed", "7", *VARY, "--chunk-runs", "20"]
# A drive takes a second, so there is time to kill something.
DRIVE = SOURCE / "scenarios/waypoints/open_loop.yaml"


def masked(feature):
    return {**os.environ, "GLIBC_TUNABLES": f"glibc.cpu.hwcaps=-{feature}"}


def has_fma():
    try:
        return " fma " in pathlib.Path("/proc/cpuinfo").read_text()
    except OSError:
        return False


class Sweep(ToolTest):
    def setUp(self):
        super().setUp()
        self.write("plan.yaml", PLAN)

    def table(self, folder):
        return (self.folder / folder / "table.csv").read_bytes()

    def sweep(self, *args, status=0):
        result = self.run_tool(*SWEEP, *args)
        self.assertEqual(result.returncode, status, result.stderr)
        return result

    @functools.cached_property
    def once(self):
        """The table of one process that computes everything."""
        self.sweep("--out", "once")
        return self.table("once")

    def test_a_table_a_summary_and_what_was_computed(self):
        answer = self.json_of(self.sweep("--out", "once", "--json"))
        table = self.table("once")
        self.assertEqual(answer["status"], "done")
        self.assertEqual(answer["metrics"], {"runs": 200, "chunks": 10, "missing_chunks": 0})
        self.assertEqual(answer["table_sha256"], hashlib.sha256(table).hexdigest())
        rows = list(csv.DictReader(table.decode().splitlines()))
        self.assertEqual([row["run"] for row in rows], [str(i) for i in range(200)])
        done = sum(row["status"] == "done" for row in rows)
        self.assertTrue(0 < done < 200)
        self.assertEqual(answer["summary"]["sides"][0]["done"]["hits"], done)
        self.assertEqual(json.loads((self.folder / "once/summary.json").read_text()), answer["summary"])
        manifest = json.loads((self.folder / "once/manifest.json").read_text())
        self.assertEqual(manifest["inputs"], {"small.map": hashlib.sha256(
            (self.folder / "small.map").read_bytes()).hexdigest()})
        text = self.sweep("--out", "once").stdout
        self.assertIn(f"200 runs: {done / 2:.1f} %", text)
        self.assertIn("table.csv", text)

    def test_a_run_of_the_table_can_be_repeated(self):
        self.write("park.yaml", (SOURCE / "scenarios/waypoints/open_loop.yaml").read_bytes().replace(
            b"calibration.yaml", str(SOURCE / "scenarios/waypoints/calibration.yaml").encode()))
        self.assertEqual(self.run_tool("sweep", "park.yaml", "--runs", "2", "--out", "out").returncode, 0)
        row = list(csv.DictReader(self.table("out").decode().splitlines()))[1]
        alone = self.json_of(self.run_tool("run", "park.yaml", "--seed", row["seed"], "--json"))
        self.assertEqual(alone["status"], row["status"])
        for name, value in alone["metrics"].items():
            if name in row and value is not None:
                self.assertEqual(float(row[name]), value, name)

    def test_threads_and_chunks_do_not_matter(self):
        for words in (["--threads", "1"], ["--threads", "5"], ["--chunk-runs", "1000"], ["--chunk-runs", "7"]):
            shutil.rmtree(self.folder / "other", ignore_errors=True)
            command = [word for word in SWEEP if word not in ("--chunk-runs", "20")] if "--chunk-runs" in words else SWEEP
            result = self.run_tool(*command, *words, "--out", "other")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(self.table("other"), self.once, words)

    def test_worlds_are_read_by_many_threads(self):
        """Reading SDF mutes the standard error of the process, which threads share."""
        tables = []
        for threads in ("1", "8"):
            result = self.run_tool("sweep", SOURCE / "scenarios/arena/shortest.yaml", "--vary", "sight=modelled", "--runs",
                                   "16", "--threads", threads, "--out", threads)
            self.assertEqual(result.returncode, 0, result.stderr)
            tables.append(self.table(threads))
        self.assertEqual(*tables)

    def test_chunks_in_any_order_then_merge(self):
        for chunk in ("9", "3..5", "0", "1..2", "6..8"):
            self.sweep("--out", "parts", "--chunks", chunk)
            self.assertFalse((self.folder / "parts/table.csv").exists())
        first = self.run_tool("sweep", "parts", "--merge", "--json")
        self.assertEqual(self.json_of(first)["table_sha256"], hashlib.sha256(self.once).hexdigest())
        self.assertEqual(self.table("parts"), self.once)
        before = (self.folder / "parts/chunks/000003.csv").read_bytes()
        (self.folder / "parts/chunks/000003.csv").unlink()
        self.refused("sweep", "parts", "--merge", says=["missing: 3"])
        self.assertEqual(self.run_tool("sweep", "parts").returncode, 0)
        self.assertEqual((self.folder / "parts/chunks/000003.csv").read_bytes(), before)

    def test_processes_that_are_killed_and_a_resumption(self):
        command = [TOOL, "sweep", str(DRIVE), "--runs", "24", "--chunk-runs", "2", "--threads", "1", "--out"]
        subprocess.run([*command, "once"], cwd=self.folder, check=True, capture_output=True)
        chunks = self.folder / "out/chunks"

        def killed_in_between():
            """Kills two at their first chunk. They may have been faster; then there is nothing to resume."""
            shutil.rmtree(self.folder / "out", ignore_errors=True)
            workers = [subprocess.Popen([*command, "out"], cwd=self.folder, stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL) for _ in range(2)]
            until("a chunk", lambda: list(chunks.glob("*.csv")))
            for worker in workers:
                worker.kill()
            for worker in workers:
                worker.wait()
            return 0 < len(list(chunks.glob("*.csv"))) < 12

        until("a sweep that was killed in between", killed_in_between)
        workers = [subprocess.Popen([*command, "out"], cwd=self.folder, stdout=subprocess.DEVNULL,
                                    stderr=subprocess.PIPE) for _ in range(2)]
        for worker in workers:
            error = worker.communicate()[1]
            self.assertEqual(worker.returncode, 0, error)
        self.assertEqual(self.table("out"), self.table("once"))
        self.assertEqual([path.name for path in chunks.iterdir() if path.suffix != ".csv"], [])

    def test_it_ends_soon_when_asked_and_continues(self):
        command = [TOOL, "sweep", str(DRIVE), "--runs", "400", "--chunk-runs", "2", "--out", "out"]

        def ended_in_between():
            """Ends it at its first chunk. It may have been faster; then it is asked too late."""
            shutil.rmtree(self.folder / "out", ignore_errors=True)
            worker = subprocess.Popen(command, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            until("a chunk", lambda: list((self.folder / "out").glob("chunks/*.csv")))
            worker.terminate()
            error = worker.communicate()[1]
            self.assertIn(worker.returncode, (0, 1), error)
            return worker.returncode == 1 and error

        error = until("a sweep that was ended in between", ended_in_between)
        self.assertIn("the same command continues it", error)

    def test_failures_are_kept(self):
        self.write("wall.map", "type octile\nheight 3\nwidth 5\nmap\n..@..\n..@..\n..@..\n")
        self.write("wall.yaml", PLAN.replace("small.map", "wall.map").replace("5.5,0.5", "4.5,0.5"))
        result = self.run_tool("sweep", "wall.yaml", "--vary", "to=1.5,1.5;4.5,1.5", "--keep", "failures", "--out", "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("1 not_done", result.stdout)
        kept = self.folder / "out/failures"
        self.assertEqual([path.name for path in kept.iterdir()], ["1"])
        self.assertEqual(self.result_of("out/failures/1")["status"], "not_done")
        alone = self.run_tool("run", "wall.yaml", "--to", "4.5,1.5", "--out", "alone")
        self.assertEqual(alone.returncode, 1)
        self.same_run("alone", "out/failures/1")

    def test_two_sides_are_compared_on_the_same_seeds(self):
        words = [word for word in SWEEP[:6]] + VARY[:2] + ["--compare", "planner=a_star,theta_star", "--out", "out"]
        answer = self.json_of(self.run_tool(*words, "--json"))
        paired = answer["summary"]["paired"]
        self.assertEqual(paired["done"]["only_a"] + paired["done"]["only_b"], 0)
        length = paired["metrics"]["length_m"]
        rows = list(csv.DictReader(self.table("out").decode().splitlines()))
        pairs = [(float(b["length_m"]) - float(a["length_m"])) for a, b in zip(rows[::2], rows[1::2]) if a["length_m"]]
        self.assertEqual(length["pairs"], len(pairs))
        self.assertEqual(length["less"], sum(d < 0 for d in pairs))
        self.assertEqual(length["more"], 0)
        try:
            from scipy.stats import wilcoxon
        except ImportError:
            return
        self.assertAlmostEqual(length["wilcoxon_p"], wilcoxon(pairs).pvalue, places=12)

    @unittest.skipUnless(has_fma(), "the processor has no FMA to mask")
    def test_a_worker_that_computes_otherwise_is_refused(self):
        self.assertTrue(self.once)
        for words in ([*SWEEP, "--out", "once"], ["sweep", "once"], ["sweep", "once", "--chunks", "3"]):
            result = subprocess.run([TOOL, *words], cwd=self.folder, env=masked("FMA"), capture_output=True, text=True)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn("this machine computes sin, ", self.sentence(result))
        self.assertEqual(self.table("once"), self.once)

    def test_what_was_changed_is_named(self):
        self.assertTrue(self.once)
        self.refused(*SWEEP[:-2], "--out", "once", says=["--chunk-runs", "'20' there, '1000' here"])
        self.refused("sweep", "once", "--seed", "3", says=["--seed", "leave the flag out"])
        self.write("small.map", (self.folder / "small.map").read_text().replace("@", ".", 1))
        self.refused("sweep", "once", says=["the input small.map", "once/manifest.json"])
        self.write("plan.yaml", PLAN + "radius: 0.1\n")
        self.refused("sweep", "once", says=["the scenario", "once/manifest.json"])

    def test_bad_input_gets_a_sentence(self):
        for words, says in (
                (["--runs", "0"], ["--runs", "'0'"]),
                (["--runs", "1e12"], ["--runs", "'1e12'"]),
                (["--seed", "-1"], ["--seed", "'-1'"]),
                (["--seed", "1e19"], ["--seed", "'1e19'"]),
                (["--seed", "1.5"], ["--seed", "'1.5'"]),
                (["--runs", "1000000000000"], ["--runs", "'1000000000000'"]),
                (["--vary", "plannr=a,b"], ["plannr", "did you mean 'planner'"]),
                (["--vary", "radius"], ["--vary", "KEY=VALUES"]),
                (["--vary", "radius=gauss(0,1)"], ["radius", "'gauss'", "normal"]),
                (["--vary", "radius=uniform(3,1)"], ["radius", "low < high"]),
                (["--vary", "radius=-1,1"], ["radius", "'-1'"]),
                (["--vary", "map=none.map,small.map"], ["none.map", "no such file"]),
                (["--runs", "10000000", "--vary", "radius=1,2"], ["radius", "at most 10000000 runs"]),
                (["--compare", "planner=a_star"], ["--compare", "two different"]),
                (["--chunks", "1"], ["--chunks", "'1'", "0 to 0"]),
                (["--chunks", "a..b"], ["--chunks", "'a..b'"]),
                (["--chunks", "0", "--merge"], ["--chunks", "--merge"]),
                (["--keep", "all"], ["--keep", "'all'"]),
                (["--emit", "pbs"], ["--emit", "'pbs'"]),
                (["--out", "small.map"], ["small.map"]),
                (["--out", "."], ["other files"]),
                (["--threads", "-1"], ["--threads", "'-1'"])):
            self.refused("sweep", "plan.yaml", *words, says=says)
        self.refused("sweep", "none.yaml", says=["none.yaml"])
        self.refused("sweep", "small.map", says=["small.map"])
        (self.folder / "empty").mkdir()
        self.refused("sweep", "empty", says=["empty/manifest.json"])
        if os.geteuid() != 0:
            (self.folder / "empty").chmod(0o500)
            self.refused("sweep", "plan.yaml", "--out", "empty/out", says=["nothing may be written"])

    def test_a_damaged_chunk_is_named(self):
        self.assertTrue(self.once)
        path = self.folder / "once/chunks/000004.csv"
        path.write_bytes(path.read_bytes().replace(b"done", b"gone", 1))
        self.refused("sweep", "once", "--merge", says=["once/chunks/000004.csv", "damaged", "run the sweep again"])
        self.assertEqual(self.table("once"), self.once)

    def test_chunks_and_manifests_of_two_sweeps_are_not_mixed(self):
        other = [word if word != "7" else "8" for word in SWEEP]
        self.assertEqual(self.run_tool(*other, "--out", "other").returncode, 0)
        self.assertTrue(self.once)
        mine = (self.folder / "once/chunks/000004.csv").read_bytes()
        shutil.copy(self.folder / "other/chunks/000004.csv", self.folder / "once/chunks/000004.csv")
        for words in (["sweep", "once"], ["sweep", "once", "--merge"], [*SWEEP, "--out", "once"],
                      ["sweep", "once", "--chunks", "4"]):
            self.refused(*words, says=["once/chunks/000004.csv", "the seed of its first run ('", "remove the chunk"])
        (self.folder / "once/chunks/000004.csv").write_bytes(mine)
        path = self.folder / "once/manifest.json"
        text = path.read_text()
        (self.folder / "once/chunks/000009.csv").unlink()  # left to compute with what the manifest says
        for old, new, says in (('"seed": 7', '"seed": 8', "the seed of its first run"),
                               ("uniform(0.5,5.5)", "uniform(0.5,5.4)", "the to of its first run"),
                               ("a_star,theta_star", "theta_star,a_star", "the planner of its first run")):
            self.assertIn(old, text)
            path.write_text(text.replace(old, new))
            self.refused("sweep", "once", says=["once/chunks/000000.csv", says, "restore manifest.json"])
        for value in ("-1", "1e19", "1.5", "10000000000000000000", "7.0", "null", "[7]"):
            path.write_text(text.replace('"seed": 7', f'"seed": {value}'))
            self.refused("sweep", "once", says=["once/manifest.json", "seed '", "whole number", "restore the file"])
        path.write_text(text)
        self.assertEqual(self.run_tool("sweep", "once").returncode, 0)
        self.assertEqual(self.table("once"), self.once)

    def test_a_job_array_of_slurm(self):
        """The script, run as Slurm runs it: one task after another with its number in the environment."""
        shutil.copytree(self.folder, self.folder / "it's here")
        result = subprocess.run([TOOL, *SWEEP, "--emit", "slurm", "--out", "array"], cwd=self.folder / "it's here",
                                capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        script = self.folder / "it's here/array/sweep.sbatch"
        self.assertIn("#SBATCH --array=0-9\n", script.read_text())
        for task in (9, 2, 0, 1, 3, 4, 5, 6, 7, 8):
            subprocess.run(["sh", str(script)], check=True, capture_output=True, cwd="/",
                           env={**os.environ, "SLURM_ARRAY_TASK_ID": str(task)})
        merged = subprocess.run([TOOL, "sweep", "array", "--merge"], cwd=self.folder / "it's here", capture_output=True)
        self.assertEqual(merged.returncode, 0, merged.stderr)
        self.assertEqual(self.table("it's here/array"), self.once)

    @unittest.skipUnless(shutil.which("mpirun"), "mpirun is not installed")
    def test_mpirun(self):
        root = ["--allow-run-as-root"] if os.geteuid() == 0 else []
        result = subprocess.run(["mpirun", *root, "--oversubscribe", "-np", "4", TOOL, *SWEEP, "--out", "mpi"],
                                cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.table("mpi"), self.once)


if __name__ == "__main__":
    main()
