"""`outrider serve` and those who may write into its folder: what they put there costs little, and leads nowhere.

No test here measures time: they count processes, bytes, memory and processor time.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

from serve_case import COURT, Serve
from server_client import Server
from serve_load import MIB
from tool import main, until
from witness import Witness

MOST_MIB = 150  # that the server itself ever held; a bomb took 300 and more
SECRET = b"secret of the outside"

# Exchanges two names of a folder until its input ends.
EXCHANGE = """
import ctypes, os, select, sys
libc = ctypes.CDLL(None, use_errno=True)
folder = os.open(sys.argv[1], os.O_DIRECTORY)
one, two = sys.argv[2].encode(), sys.argv[3].encode()
print(libc.renameat2(folder, one, folder, two, 2), flush=True)
while not select.select([sys.stdin], [], [], 0)[0]:
    libc.renameat2(folder, one, folder, two, 2)
"""


def status_of(server, key):
    """A number of /proc/PID/status, such as VmHWM in KiB."""
    lines = pathlib.Path(f"/proc/{server.process.pid}/status").read_text().splitlines()
    return int(next(line for line in lines if line.startswith(key + ":")).split()[1])


def processor_s(server):
    """Processor time of the server itself."""
    fields = pathlib.Path(f"/proc/{server.process.pid}/stat").read_text().rpartition(")")[2].split()
    return sum(map(int, fields[11:13])) / os.sysconf("SC_CLK_TCK")


def children(server):
    found = []
    for task in pathlib.Path(f"/proc/{server.process.pid}/task").glob("*/children"):
        try:
            found += task.read_text().split()
        except OSError:
            pass  # that thread has ended
    return found


class Exchange:
    """Somebody who exchanges two names of a folder all the time."""

    def __init__(self, folder, one, two):
        self.process = subprocess.Popen([sys.executable, "-c", EXCHANGE, str(folder), one, two], text=True,
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        assert self.process.stdout.readline() == "0\n", "the premise: names can be exchanged here"

    def __enter__(self):
        return self

    def __exit__(self, *unused):
        self.process.communicate("stop", timeout=30)


class Strangers(Serve):
    def setUp(self):
        super().setUp()
        outside = tempfile.TemporaryDirectory(prefix="outrider-outside-")
        self.addCleanup(outside.cleanup)
        self.outside = pathlib.Path(outside.name)

    def stays_small(self, server):
        self.assertLess(status_of(server, "VmHWM") / 1024, MOST_MIB)

    def test_scenarios_that_are_bombs(self):
        with Server(self.folder) as server:
            for i in range(4):
                bomb = "a: " + "{["[i % 2] * (MIB - 3)
                server.json("PUT", f"/api/v1/files/bomb{i}.yaml", bomb.encode(), status=201)
            before_s = processor_s(server)
            waiting = []
            for _ in range(40):
                waiting.append(server.connect())
                waiting[-1].sendall(f"GET /api/v1/files HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\n\r\n".encode())
                server.json("GET", "/api/v1/version")
            for connection in waiting:
                connection.close()
            until("the end of the readers", lambda: not children(server))
            self.assertLess(processor_s(server) - before_s, 3)
            self.stays_small(server)
            evil = {"Origin": "http://evil.com", "Sec_Fetch_Site": "cross-site"}
            self.assertEqual(server.request("GET", "/api/v1/files", **evil)[0], 403)
            self.assertEqual(children(server), [])
            kinds = {file["path"]: file["kind"] for file in server.json("GET", "/api/v1/files")["files"]}
            self.assertEqual((kinds["court.yaml"], kinds["bomb0.yaml"]), ("scenario", "other"))
            for text in ("a: " + "{" * (MIB - 3), "job: [" + "[" * 1000):
                server.json("POST", "/api/v1/runs", {"text": text}, status=400)
            self.stays_small(server)

    def kept_run(self, name, **changes):
        state = {"id": name, "scenario": "court.yaml", "job": "guard", "seed": 4, "state": "done", "error": "", "where": "",
                 "began_s": 1_700_000_000, "took_s": 1, "summary": {"status": "done"}} | changes
        folder = self.folder / ".outrider/runs" / name
        folder.mkdir(parents=True)
        (folder / "state.json").write_text(json.dumps(state))
        return folder

    def test_states_of_runs_that_are_bombs(self):
        honest = [f"1a-{i}" for i in range(20)]
        for name in honest:
            self.kept_run(name)
        bomb = {"rows": [[]] * 330_000}
        for i in range(40):
            folder = self.kept_run(f"1b-{i}", summary=bomb)
        self.assertLess((folder / "state.json").stat().st_size, 1.4 * MIB)
        text = (folder / "state.json").read_text().replace(" ", "")
        for i in range(40):
            (self.folder / f".outrider/runs/1b-{i}/state.json").write_text(text.replace("1b-39", f"1b-{i}"))
        self.assertLess(len(text), MIB, "the premise: it is short enough to be read")
        with Server(self.folder) as server:
            runs = server.json("GET", "/api/v1/runs")["runs"]
            self.assertEqual(sorted(run["id"] for run in runs), sorted(honest))
            self.assertLess(processor_s(server), 3)
            self.stays_small(server)

    def precious(self):
        """A folder outside as a run might be, which nobody may read or change."""
        for name in ("run.json", "run.mcap", "live.mcap", "running.mcap", "run.svg", "state.json", ".lock"):
            (self.outside / name).write_bytes(SECRET)
        return {path.name: (path.read_bytes(), path.stat().st_ino, path.stat().st_mode) for path in self.outside.iterdir()}

    def untouched(self, before):
        after = {path.name: (path.read_bytes(), path.stat().st_ino, path.stat().st_mode) for path in self.outside.iterdir()}
        self.assertEqual(after, before)

    def test_a_run_that_has_ended_is_replaced_by_a_link(self):
        before = self.precious()
        with Server(self.folder) as server:
            run = server.json("POST", "/api/v1/runs", {"scenario": "court.yaml"}, status=202)["id"]
            server.wait(run)
            folder = self.folder / ".outrider/runs" / run
            folder.rename(folder.with_name("away"))
            folder.symlink_to(self.outside)
            witness = Witness(self.outside)
            self.addCleanup(witness.close)
            for what in ("log", "result"):
                status, _, body = server.request("GET", f"/api/v1/runs/{run}/{what}")
                self.assertEqual(status, 200, "it holds its own folder")
                self.assertNotIn(SECRET, body)
            inside = folder.with_name("away")
            (inside / "run.json").unlink()
            (inside / "run.json").symlink_to(self.outside / "run.json")
            self.assertEqual(server.request("GET", f"/api/v1/runs/{run}/result")[0], 404)
            self.assertEqual(witness.opened(), set())
        (self.outside / "state.json").write_text((inside / "state.json").read_text())
        before["state.json"] = ((self.outside / "state.json").read_bytes(), *before["state.json"][1:])
        with Server(self.folder) as server:
            self.assertEqual(server.json("GET", "/api/v1/runs")["runs"], [])
            self.assertEqual(server.request("GET", f"/api/v1/runs/{run}/log")[0], 404)
        self.untouched(before)

    def test_the_folder_of_a_mission_is_replaced_before_it_begins(self):
        before = self.precious()
        with Server(self.folder, "--jobs", "1") as server:
            first = self.started(server, {"scenario": "long.yaml"})
            away, links, log = [server.json("POST", "/api/v1/runs", {"scenario": "court.yaml"}, status=202)["id"]
                                for _ in range(3)]
            runs = self.folder / ".outrider/runs"
            (runs / away).rename(runs / "away")
            (runs / away).symlink_to(self.outside)
            for name in before:
                link = runs / (log if name == "running.mcap" else links) / name
                link.unlink(missing_ok=True)
                link.symlink_to(self.outside / name)
            self.still_running(server, first)
            server.json("DELETE", f"/api/v1/runs/{first}")
            for run, states in ((away, ("done", "not_done")), (links, ("done", "not_done")), (log, ("failed",))):
                self.assertIn(server.wait(run)["state"], states)
                body = server.request("GET", f"/api/v1/runs/{run}/result")[2]
                self.assertNotIn(SECRET, body)
            self.assertEqual(json.loads((runs / "away/run.json").read_text())["job"], "guard", "it wrote to its own folder")
        self.untouched(before)

    def test_the_folder_of_a_mission_is_exchanged_while_it_runs(self):
        before = self.precious()
        runs = self.folder / ".outrider/runs"
        runs.mkdir(parents=True)
        (runs / "link").symlink_to(self.outside)
        with Server(self.folder, "--jobs", "1") as server:
            first = self.started(server, {"scenario": "long.yaml"})
            for _ in range(5):
                run = server.json("POST", "/api/v1/runs", {"scenario": "court.yaml"}, status=202)["id"]
                with Exchange(runs, run, "link"):
                    if first:
                        self.still_running(server, first)
                        server.json("DELETE", f"/api/v1/runs/{first}")
                        first = None
                    self.assertIn(server.wait(run)["state"], ("done", "not_done"))
                    for what in ("log", "result"):
                        self.assertNotIn(SECRET, server.request("GET", f"/api/v1/runs/{run}/{what}")[2])
        self.untouched(before)

    def test_a_folder_is_exchanged_while_files_are_saved(self):
        (self.folder / "a").mkdir()
        (self.folder / "b").symlink_to(self.outside)
        grid = {"resolution_m": 1, "width": 2, "height": 1, "runs": [0, 2]}
        plan = {"plan": {"grid": grid, "start": [0.5, 0.5], "goal": [1.5, 0.5], "radius_m": 0}}
        statuses = []
        with Server(self.folder) as server, Exchange(self.folder, "a", "b"):
            for i in range(1100):
                path, body = (f"scenarios/a/y{i}.yaml", plan) if i % 11 == 0 else (f"files/a/x{i}.yaml", "job: guard\n")
                statuses.append(server.request("PUT", "/api/v1/" + path, body)[0])
                if i % 10 == 0:
                    self.assertNotIn(SECRET, server.request("GET", f"/api/v1/files/a/x{i}.yaml")[2])
        self.assertEqual(list(self.outside.iterdir()), [])
        self.assertEqual(set(statuses), {201, 404}, "the premise: it met both, and nothing else came of it")


if __name__ == "__main__":
    main()
