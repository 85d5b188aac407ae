"""`outrider serve` from outside: its files and its missions."""
import gzip
import pathlib
import urllib.request

from serve_case import COURT, Serve
from server_client import Server, WebSocket
from tool import PATIENCE_S, main


class Interface(Serve):
    def test_files(self):
        with Server(self.folder) as server:
            self.assertEqual(self.valid("Version", server.json("GET", "/api/v1/version"))["api"], 1)
            files = self.valid("Files", server.json("GET", "/api/v1/files"))
            scene = self.valid("Scene", server.json("GET", "/api/v1/scenes/court.yaml"))
            self.assertEqual((scene["start"], len(scene["targets"])), ([0, -2], 3))
            kinds = {file["path"]: file["kind"] for file in files["files"]}
            self.assertEqual(kinds, {"court.yaml": "scenario", "long.yaml": "scenario", "room.txt": "map",
                                     "small.map": "map", "targets.txt": "other", "yard.sdf": "map"})
            status, headers, body = server.request("GET", "/api/v1/files/court.yaml")
            self.assertEqual((status, body.decode()), (200, COURT))
            self.assertEqual(headers["x-content-type-options"], "nosniff")
            self.assertIn("default-src 'none'", headers["content-security-policy"])
            saved = server.json("PUT", "/api/v1/files/new.yaml", "job: guard\n", status=201)
            self.assertEqual(self.valid("Saved", saved), {"path": "new.yaml", "bytes": 11})
            server.json("PUT", "/api/v1/files/new.yaml", "job: drive\n")
            self.assertEqual((self.folder / "new.yaml").read_text(), "job: drive\n")
            refused = server.json("PUT", "/api/v1/files/new.yaml", "x", status=412, If_None_Match="*")
            self.fault(refused, "precondition_failed")
            self.fault(server.json("PUT", "/api/v1/files/room.txt", "x", status=403), "forbidden")
            self.assertEqual(server.json("GET", "/api/v1/files/absent.yaml", status=404)["code"], "not_found")
            self.assertEqual(server.json("POST", "/api/v1/version", "", status=405)["error"], "expected GET")
            self.assertEqual(server.request("HEAD", "/api/v1/version")[2], b"")

    def test_long_answers_are_compressed(self):
        self.write("large.sdf", (self.folder / "yard.sdf").read_text() + "<!-- " + "fence " * 1000 + "-->")
        def fetched(path, **headers):
            asked = urllib.request.Request(f"http://127.0.0.1:{server.port}/{path}", headers={name.replace("_", "-"): value for name, value in headers.items()})
            with urllib.request.urlopen(asked, timeout=PATIENCE_S) as answer:
                return answer.status, answer.headers, answer.read()
        with Server(self.folder) as server:
            for path in ("api/v1/catalogue", "api/v1/files/large.sdf"):
                _, plain_headers, plain = fetched(path, Accept_Encoding="identity")
                self.assertEqual((plain_headers["Content-Encoding"], plain_headers["Vary"]), (None, "Accept-Encoding"), path)
                _, headers, packed = fetched(path, Accept_Encoding="gzip, deflate")
                self.assertEqual((headers["Content-Encoding"], headers["Vary"], int(headers["Content-Length"])), ("gzip", "Accept-Encoding", len(packed)), path)
                self.assertEqual(gzip.decompress(packed), plain, path)
                self.assertLess(2 * len(packed), len(plain), path)
                head = server.request("HEAD", "/" + path, Accept_Encoding="gzip")[1]
                self.assertEqual((head["content-encoding"], head["content-length"]), ("gzip", str(len(packed))), path)
            whole = (self.folder / "large.sdf").read_bytes()
            status, headers, part = fetched("api/v1/files/large.sdf", Accept_Encoding="gzip", Range="bytes=100-3099")
            self.assertEqual((status, headers["Content-Encoding"], headers["Content-Range"], part), (206, None, f"bytes 100-3099/{len(whole)}", whole[100:3100]))
            self.assertEqual(fetched("api/v1/version", Accept_Encoding="gzip")[1]["Content-Encoding"], None, "it is short")

    def test_nothing_outside_the_folder(self):
        with self.subTest("links"):
            (self.folder / "link.yaml").symlink_to("/etc/hostname")
            (self.folder / "out").symlink_to("/etc")
        outside = pathlib.Path(self.home.name + "-outside.yaml")
        self.addCleanup(lambda: outside.unlink(missing_ok=True))
        paths = ["../../etc/hostname", "%2e%2e/%2e%2e/etc/hostname", "..%2f..%2fetc%2fhostname", "/etc/hostname",
                 "%2fetc%2fhostname", ".hidden.yaml", "%2ehidden.yaml", "link.yaml", "out/hostname", "out/passwd",
                 "./court.yaml", "court.yaml%00.txt", "..\\court.yaml", "a/../court.yaml", "%zz", "%ff.yaml", "a%1b.yaml", "", "//court.yaml",
                 f"../{outside.name}"]
        with Server(self.folder) as server:
            for path in paths:
                for method in ("GET", "PUT"):
                    body = "job: guard\n" if method == "PUT" else None
                    status = server.request(method, "/api/v1/files/" + path, body)[0]
                    self.assertIn(status, (400, 403, 404), (method, path))
            self.assertFalse(outside.exists())

    def test_runs(self):
        with Server(self.folder) as server:
            run = self.valid("Run", server.json("POST", "/api/v1/runs", {"scenario": "court.yaml", "seed": 9}, status=202))
            ended = self.valid("Run", server.wait(run["id"]))
            self.assertEqual((ended["job"], ended["seed"], ended["has_log"], ended["has_result"]),
                             ("guard", 9, True, True))
            direct = self.run_tool("run", "court.yaml", "--seed", "9", "--out", "out")
            self.assertEqual(ended["state"], "done" if direct.returncode == 0 else "not_done")
            for what, name in (("log", "run.mcap"), ("result", "run.json")):
                status, headers, body = server.request("GET", f"/api/v1/runs/{run['id']}/{what}")
                self.assertEqual((status, body), (200, (self.folder / "out" / name).read_bytes()), what)
            self.assertEqual(server.request("GET", f"/api/v1/runs/{run['id']}/log", Range="bytes=0-7")[2], (self.folder / "out/run.mcap").read_bytes()[:8])

            unsaved = server.json("POST", "/api/v1/runs", {"text": COURT.replace("seed: 4", "seed: x")}, status=202)
            refused = server.wait(unsaved["id"])
            self.assertEqual((refused["state"], refused["where"][:8]), ("refused", "scenario"), refused)
            self.assertEqual([path.name for path in self.folder.glob(".outrider*")], [".outrider"])
            self.assertEqual(sorted(path.name for path in (self.folder / ".outrider/runs").iterdir()),
                             sorted([run["id"], unsaved["id"]]))
            self.assertEqual([run["id"] for run in self.valid("Runs", server.json("GET", "/api/v1/runs"))["runs"]],
                             [unsaved["id"], run["id"]])
            for wrong, status in [({"scenario": "absent.yaml"}, 404), ({}, 400), ({"text": "a: [", "folder": ""}, 400),
                                  ({"scenario": "court.yaml", "seed": -1}, 400)]:
                self.valid("Error", server.json("POST", "/api/v1/runs", wrong, status=status))
            server.json("GET", "/api/v1/runs/absent", status=404)

    def test_runs_are_there_again_after_a_restart(self):
        with Server(self.folder) as server:
            done = server.json("POST", "/api/v1/runs", {"scenario": "court.yaml"}, status=202)["id"]
            before = server.wait(done)
            log = server.request("GET", f"/api/v1/runs/{done}/log")[2]
            cut = self.started(server, {"scenario": "long.yaml"})
            server.end(kill=True)
        with Server(self.folder) as server:
            runs = {run["id"]: run for run in self.valid("Runs", server.json("GET", "/api/v1/runs"))["runs"]}
            self.assertEqual(set(runs), {done, cut})
            self.assertEqual(runs[done] | {"seq": 0, "progress": None}, before | {"seq": 0, "progress": None})
            self.assertEqual((runs[done]["seed"], runs[cut]["state"], runs[cut]["took_s"]), (4, "cut_short", None))
            self.assertEqual(server.request("GET", f"/api/v1/runs/{done}/log")[2], log)
            with WebSocket(server) as watcher:
                watcher.send({"type": "watch", "run": cut, "from": 0})
                end = self.valid("LiveEnd", watcher.until("end")[-1])
                self.assertEqual(end["state"], "cut_short")
            again = server.json("POST", "/api/v1/runs", {"scenario": "court.yaml", "seed": before["seed"]}, status=202)["id"]
            self.assertEqual(server.wait(again)["state"], before["state"])
            self.assertEqual(server.request("GET", f"/api/v1/runs/{again}/log")[2], log, "the same seed, the same bytes")

    def test_cancel_and_queue(self):
        with Server(self.folder, "--jobs", "1") as server:
            first = self.started(server, {"scenario": "long.yaml"})
            second = server.json("POST", "/api/v1/runs", {"scenario": "long.yaml"}, status=202)["id"]
            self.assertEqual(server.json("GET", f"/api/v1/runs/{second}")["state"], "queued")
            self.assertEqual(server.json("DELETE", f"/api/v1/runs/{second}")["state"], "cancelled")
            self.still_running(server, first)
            server.json("DELETE", f"/api/v1/runs/{first}")
            self.assertEqual(server.wait(first)["state"], "cancelled")
            third = server.json("POST", "/api/v1/runs", {"scenario": "court.yaml"}, status=202)["id"]
            self.assertIn(server.wait(third)["state"], ("done", "not_done"))
            fourth = self.started(server, {"scenario": "long.yaml"})
            for _ in range(16):
                server.json("POST", "/api/v1/runs", {"scenario": "long.yaml"}, status=202)
            full = [server.request("POST", "/api/v1/runs", {"scenario": "long.yaml"})[0] for _ in range(2)]
            self.assertEqual(full, [429, 429])
            self.still_running(server, fourth)
            self.assertEqual(server.end(), 0)

if __name__ == "__main__":
    main()
