"""`outrider serve` from outside: what it answers, whom it refuses, and that nothing that is sent breaks it."""
import base64
import json
import os
import pathlib
import socket
import struct
import time
import unittest
import zlib

from schema_check import refusals, schemas
from server_client import Server, WebSocket
from tool import MAP, YARD, ToolTest, costly_cases, main

ROOM = "(0,0) (6,0) (6,4) (0,4)\n---\n(2,1) (3,1) (3,3) (2,3)\n---\n(1,2) (5,2)\n"
COURT = "job: guard\nworld: yard.sdf\ntargets: targets.txt\nstart: 0,-2,90\nseed: 4\nplan:\n  resolution: 0.2\n  iterations: 50\n  refinements: 0\n"
LONG = COURT.replace("0.2", "0.03").replace("iterations: 50", "iterations: 100000000")


def small_png(width, height, values):
    """A grey PNG of 8 bits."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + bytes(values[width * y:width * (y + 1)]) for y in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class Serve(ToolTest):
    def setUp(self):
        super().setUp()
        self.write("court.yaml", COURT)
        self.write("long.yaml", LONG)
        self.write("room.txt", ROOM)
        self.write(".hidden.yaml", "job: guard\n")

    def valid(self, name, value):
        """The message keeps the schema of that name."""
        self.assertEqual(refusals(schemas()["$defs"][name], value), [], f"{name}: {str(value)[:300]}")
        return value

    def fault(self, answer, code):
        fault = self.valid("Error", answer)
        self.assertEqual(fault["code"], code)
        return fault["error"]


class Interface(Serve):
    def test_files(self):
        with Server(self.folder) as server:
            self.assertEqual(self.valid("Version", server.json("GET", "/api/v1/version"))["api"], 1)
            files = self.valid("Files", server.json("GET", "/api/v1/files"))
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
            self.assertEqual(server.json("POST", "/api/v1/version", "", status=405)["error"], "it takes GET")
            self.assertEqual(server.request("HEAD", "/api/v1/version")[2], b"")

    def test_nothing_outside_the_folder(self):
        with self.subTest("links"):
            (self.folder / "link.yaml").symlink_to("/etc/hostname")
            (self.folder / "out").symlink_to("/etc")
        outside = pathlib.Path(self.home.name + "-outside.yaml")
        self.addCleanup(lambda: outside.unlink(missing_ok=True))
        paths = ["../../etc/hostname", "%2e%2e/%2e%2e/etc/hostname", "..%2f..%2fetc%2fhostname", "/etc/hostname",
                 "%2fetc%2fhostname", ".hidden.yaml", "%2ehidden.yaml", "link.yaml", "out/hostname", "out/passwd",
                 "./court.yaml", "court.yaml%00.txt", "..\\court.yaml", "a/../court.yaml", "%zz", "", "//court.yaml",
                 f"../{outside.name}"]
        with Server(self.folder) as server:
            for path in paths:
                for method in ("GET", "PUT"):
                    body = "job: guard\n" if method == "PUT" else None
                    status = server.request(method, "/api/v1/files/" + path, body)[0]
                    self.assertIn(status, (400, 403, 404), (method, path))
            self.assertFalse(outside.exists())
            for text, where in [("image: /etc/hostname\nresolution: 1\norigin: [0,0,0]\n", "map.yaml"),
                                ("<sdf><uri>file:///etc/passwd</uri></sdf>", "a.sdf")]:
                answer = server.json("POST", f"/api/v1/maps?name={where}", text, status=400)
                self.assertIn("outside the folder", self.fault(answer, "bad_input"))
            for text in (COURT.replace("yard.sdf", "/etc/passwd"), COURT.replace("yard.sdf", "out/passwd")):
                answer = server.json("POST", "/api/v1/runs", {"text": text}, status=400)
                self.assertIn("outside the folder", self.fault(answer, "bad_input"))

    def test_maps_and_plans(self):
        with Server(self.folder) as server:
            catalogue = self.valid("Catalogue", server.json("GET", "/api/v1/catalogue"))
            self.assertIn("a_star", [planner["name"] for planner in catalogue["path_planners"]])
            cells = self.valid("Map", server.json("POST", "/api/v1/maps", {"path": "small.map"}))
            self.assertEqual(cells["grid"]["runs"], [0, 9, 1, 1, 0, 5, 1, 1, 0, 5, 1, 1, 0, 2])
            encoded = base64.b64encode(MAP.encode()).decode()
            for body in ({"files": [{"name": "a.map", "base64": encoded}]}, {"grid": cells["grid"]}):
                self.assertEqual(server.json("POST", "/api/v1/maps", body)["id"], cells["id"])
            self.assertEqual(server.json("POST", "/api/v1/maps?name=b.map", MAP)["id"], cells["id"])

            question = {"map": cells["id"], "start": [0.5, 3.5], "goal": [5.5, 3.5], "planner": "a_star"}
            plan = self.valid("Plan", server.json("POST", "/api/v1/plan", {**question, "trace": 100, "blocked": True}))
            self.assertAlmostEqual(plan["length_m"], 5 + 3 * 2 ** 0.5)
            rows = plan["trace"]["rows"]
            self.assertEqual(len(rows), plan["counters"]["expansions"])
            for row in rows:
                self.assertAlmostEqual(row[4], row[5] + row[6])
            # As the tool itself has it.
            tool = self.json_of(self.run_tool("plan", "small.map", "--from", "0.5,3.5", "--to", "5.5,3.5", "--planner",
                                              "a_star", "--model", "cells", "--json"))
            self.assertEqual(tool["metrics"]["cost_m"], plan["cost"])
            self.assertEqual(tool["waypoints"], plan["waypoints"])
            shut = {**question, "edits": [{"block": [3, 0, 1, 1]}]}
            none = self.valid("Plan", server.json("POST", "/api/v1/plan", shut))
            self.assertEqual((none["status"], none["code"]), ("not_done", "no_path"))
            opened = {**question, "edits": [{"block": [3, 0, 1, 1]}, {"free": [3, 3, 1, 1]}]}
            self.assertAlmostEqual(server.json("POST", "/api/v1/plan", opened)["length_m"], 5.0)
            blocked = server.json("POST", "/api/v1/plan", {**question, "start": [3.5, 3.5]})
            self.assertEqual((blocked["status"], blocked["code"]), ("refused", "start_blocked"))

            room = self.valid("Map", server.json("POST", "/api/v1/maps", {"path": "room.txt"}))
            question = {"map": room["id"], "start": [1, 2], "goal": [5, 2], "planner": "visibility_graph",
                        "radius_m": 0.1, "legs": True}
            straight = self.valid("Plan", server.json("POST", "/api/v1/plan", {**question, "edits": [{"remove": 0}]}))
            self.assertAlmostEqual(straight["length_m"], 4.0)
            self.assertGreater(self.valid("Plan", server.json("POST", "/api/v1/plan", question))["length_m"], 4.0)

            for wrong, says in [({"planner": "a_stra"}, "a_star"), ({"strat": [0, 0]}, "did you mean"), ({"start": 3}, "[x, y]"),
                                ({"map": "gone"}, "post it again"), ({"options": {"wieght": 2}}, "no such option"),
                                ({"edits": [{"block": [0, 0, 99, 1]}]}, "leaves the grid"), ({"trace": -1}, "whole number")]:
                base = {"map": cells["id"], "start": [0.5, 3.5], "goal": [5.5, 3.5], "planner": "a_star"}
                answer = server.json("POST", "/api/v1/plan", {**base, **wrong}, status=400)
                self.assertIn(says, self.fault(answer, "bad_input"))
            broken = server.json("POST", "/api/v1/maps?name=broken.map", "type octile\nheight 2\n", status=400)
            self.assertIn("broken.map", self.valid("Error", broken)["where"])

    def test_what_is_saved_plans_the_same(self):
        """A question that was drawn and saved has the same plan on the command line, on every kind of ground."""
        big = {"resolution_m": 0.25, "width": 24, "height": 16, "runs": [0, 24 * 16], "origin": [-1, 0.3]}
        wall = [{"block": [12, 0, 2, 13]}, {"block": [5, 6, 1, 9]}, {"free": [5, 8, 1, 1]}]
        turned = {**big, "yaw_rad": 0.4}
        room = {"boundary": [[0, 0], [6, 0], [6, 4], [0, 4]], "obstacles": [[[2, 1], [3, 1], [3, 3], [2, 3]]]}
        moved = [{"set": 0, "polygon": [[2.3, 0.4], [3.1, 0.6], [3, 3.2]]}, {"add": [[4, 2], [4.5, 2], [4.5, 3.7]]}]
        cells, polygons = {"grid": big, "edits": wall, "radius_m": 0.13}, {"polygons": room, "edits": moved, "radius_m": 0.13}
        ends = {"start": [0.31, 1.17], "goal": [4.6, 1.63]}
        cases = [{**cells, **ends, "planner": "theta_star"}, {**cells, **ends, "planner": "a_star", "model": "corners"},
                 {"grid": turned, "edits": wall, **ends, "goal": [3.2, 3.9], "radius_m": 0.05, "planner": "a_star"},
                 {**polygons, **ends, "planner": "visibility_graph"},
                 {**polygons, **ends, "planner": "theta_star", "resolution_m": 0.07},
                 {**cells, **ends, "planner": "safest", "options": {"kept": 0.7}}]
        with Server(self.folder) as server:
            for i, question in enumerate(cases):
                plan = self.valid("Plan", server.json("POST", "/api/v1/plan", question))
                self.assertEqual(plan["status"], "done", question)
                path = f"case_{i}.yaml"
                saved = server.json("PUT", f"/api/v1/scenarios/{path}", {"plan": question}, status=201)
                for name in self.valid("SavedScenario", saved)["files"]:
                    self.assertTrue((self.folder / name).is_file(), name)
                tool = self.json_of(self.run_tool("run", path, "--json", "--out", f"out_{i}"))
                row = tool["rows"][0] if "rows" in tool else tool
                self.assertEqual(row["waypoints"], plan["waypoints"], question)
                self.assertTrue((self.folder / f"out_{i}/plan.svg").is_file())
                # Opened again it is the same question.
                shown = self.valid("Scenario", server.json("GET", f"/api/v1/scenarios/{path}"))
                again = {name: shown[name] for name in ("start", "goal", "planner", "options", "model", "radius_m", "resolution_m")}
                again = server.json("POST", "/api/v1/plan", {"map": shown["map"]["id"], **again})
                self.assertEqual(again["waypoints"], plan["waypoints"])
                self.assertEqual(again["cost"], plan["cost"])
            kinds = {file["path"]: (file["kind"], file.get("job")) for file in server.json("GET", "/api/v1/files")["files"]}
            self.assertEqual(kinds["case_0.yaml"], ("scenario", "plan"))
            self.assertEqual(kinds["case_0_map.yaml"][0], "map")
        self.refused("run", "case_0.yaml", "--seed", "3", says=["--seed", "plan"])
        self.write("broken.yaml", "job: plan\nmap: small.map\nfrom: 0.5,3.5\nto: 9\n")
        self.refused("run", "broken.yaml", says=["--to", "x,y"])

    def test_a_yard_that_was_changed(self):
        with Server(self.folder) as server:
            shown = self.valid("Scenario", server.json("GET", "/api/v1/scenarios/court.yaml"))
            self.assertEqual([target["name"] for target in shown["targets"]], ["1_0", "4_0", "fox"])
            self.assertEqual(shown["start"], [0, -2])
            same = {"scenario": "court.yaml", "start": shown["start"],
                    "targets": [{"name": t["name"], "position": t["position"][:2]} for t in shown["targets"]]}
            saved = self.valid("SavedScenario", server.json("PUT", "/api/v1/scenarios/same.yaml", {"guard": same}, status=201))
            self.assertEqual(saved["files"], ["same_targets.txt", "same.yaml"])
            moved = {**same, "start": [1, -2], "boxes": [[-1, -0.5, 0, 0]],
                     "targets": [{"name": "fox", "position": [-1, 2]}, {"name": "1_0", "position": [-1.5, 1]}, {"name": "new", "position": [2, 0]}]}
            (self.folder / "deeper").mkdir()
            for path in ("moved.yaml", "deeper/moved.yaml"):
                server.json("PUT", f"/api/v1/scenarios/{path}", {"guard": moved}, status=201)
                again = self.valid("Scenario", server.json("GET", f"/api/v1/scenarios/{path}"))
                self.assertEqual({t["name"]: t["position"] for t in again["targets"]},
                                 {"fox": [-1, 2, 0], "1_0": [-1.5, 1, 0], "new": [2, 0, 0]})
                self.assertEqual(again["start"], [1, -2])
                self.assertEqual(len(again["map"]["polygons"]["obstacles"]), len(shown["map"]["polygons"]["obstacles"]) + 1)
            for wrong, says in [({"targets": []}, "1 to"), ({"boxes": [[0, 0, 0, 1]]}, "apart"),
                                ({"targets": [{"name": "a b", "position": [0, 0]}]}, "key=value"),
                                ({"targets": [{"name": "a", "position": [0, 0]}] * 2}, "another target")]:
                refused = server.json("PUT", "/api/v1/scenarios/x.yaml", {"guard": {**same, **wrong}}, status=400)
                self.assertIn(says, self.fault(refused, "bad_input"))
        # What was not moved is the same mission; what was is another.
        runs = {name: self.json_of(self.run_tool("run", f"{name}.yaml", "--json", "--out", name)) for name in ("court", "same", "moved")}
        reports = {name: (self.folder / name / "guard.json").read_text() for name in runs}
        self.assertEqual(*(reports[name].split('"settings"')[0] for name in ("court", "same")))
        self.assertIn("new", [target["name"] for target in json.loads(reports["moved"])["targets"]])

    def test_a_map_of_every_kind_is_read_as_it_is_dropped(self):
        """The bytes that the page sends when a file is dropped; a broken one is refused with a sentence that names it."""
        pgm = b"P5\n4 3\n255\n" + bytes([254] * 5 + [0] * 2 + [254] * 5)
        png = small_png(4, 3, [254] * 5 + [0] * 2 + [254] * 5)
        yaml = "image: {}\nresolution: 0.5\norigin: [1, 2, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
        runs = [0, 5, 1, 2, 0, 5]
        good = [([("m.yaml", yaml.format("m.pgm")), ("m.pgm", pgm)], "grid"), ([("m.png", png), ("m.yaml", yaml.format("m.png"))], "grid"),
                ([("m.png", png)], "grid"), ([("m.pgm", pgm)], "grid"), ([("small.map", MAP)], "grid"),
                ([("room.txt", ROOM)], "polygons"), ([("yard.sdf", YARD)], "polygons")]
        broken = [([("m.yaml", yaml.format("m.pgm"))], "m.pgm", "no such file"), ([("m.yaml", "image: [")], "m.yaml", "YAML"),
                  ([("m.png", png[:40])], "m.png", ""), ([("m.pgm", pgm[:-3])], "m.pgm", ""), ([("a.map", MAP[:-3])], "a.map", ""),
                  ([("room.txt", "(0,0) (1\n---\n")], "room.txt:1", "is no corner"), ([("w.sdf", "<sdf><model")], "w.sdf", ""),
                  ([("a.jpg", pgm)], "a.jpg", "what kind of map")]
        def body(files):
            return {"files": [{"name": name, "base64": base64.b64encode(data.encode() if isinstance(data, str) else data).decode()}
                              for name, data in files]}
        with Server(self.folder) as server:
            for files, kind in good:
                found = self.valid("Map", server.json("POST", "/api/v1/maps", body(files)))
                self.assertIn(kind, found, files[0][0])
                if files[0][0].startswith("m."):
                    self.assertEqual(found["grid"]["runs"], runs, files[0][0])
            for files, where, says in broken:
                answer = server.json("POST", "/api/v1/maps", body(files), status=400)
                self.assertIn(says, self.fault(answer, "bad_input"))
                self.assertIn(where, answer["where"] + answer["error"])
                self.assertNotIn("/tmp", answer["where"] + answer["error"])

    def test_runs(self):
        with Server(self.folder) as server:
            run = self.valid("Run", server.json("POST", "/api/v1/runs", {"scenario": "court.yaml", "seed": 9}, status=202))
            ended = self.valid("Run", server.wait(run["id"]))
            self.assertEqual((ended["job"], ended["seed"], ended["has_report"]), ("guard", 9, True))
            report = server.json("GET", f"/api/v1/runs/{run['id']}/report")
            direct = self.run_tool("run", "court.yaml", "--seed", "9", "--out", "out")
            self.assertEqual(ended["state"], "done" if direct.returncode == 0 else "not_done")
            self.assertEqual(server.request("GET", f"/api/v1/runs/{run['id']}/report")[2],
                             (self.folder / "out/guard.json").read_bytes())
            self.assertGreater(len(report["track"]), 1)

            unsaved = server.json("POST", "/api/v1/runs", {"text": COURT.replace("seed: 4", "seed: x")}, status=202)
            refused = server.wait(unsaved["id"])
            self.assertEqual((refused["state"], refused["where"][:8]), ("refused", "scenario"), refused)
            self.assertEqual([path.name for path in self.folder.glob(".outrider*")], [])
            self.assertEqual([run["id"] for run in self.valid("Runs", server.json("GET", "/api/v1/runs"))["runs"]],
                             [unsaved["id"], run["id"]])
            for wrong, status in [({"scenario": "absent.yaml"}, 404), ({}, 400), ({"text": "a: [", "folder": ""}, 400),
                                  ({"scenario": "court.yaml", "seed": -1}, 400)]:
                self.valid("Error", server.json("POST", "/api/v1/runs", wrong, status=status))
            server.json("GET", "/api/v1/runs/absent", status=404)

    def test_cancel_and_queue(self):
        with Server(self.folder, "--jobs", "1") as server:
            first = server.json("POST", "/api/v1/runs", {"scenario": "long.yaml"}, status=202)["id"]
            second = server.json("POST", "/api/v1/runs", {"scenario": "long.yaml"}, status=202)["id"]
            while server.json("GET", f"/api/v1/runs/{first}")["state"] == "queued":
                time.sleep(0.01)
            self.assertEqual(server.json("GET", f"/api/v1/runs/{second}")["state"], "queued")
            self.assertEqual(server.json("DELETE", f"/api/v1/runs/{second}")["state"], "cancelled")
            server.json("DELETE", f"/api/v1/runs/{first}")
            self.assertEqual(server.wait(first, 10)["state"], "cancelled")
            third = server.json("POST", "/api/v1/runs", {"scenario": "court.yaml"}, status=202)["id"]
            self.assertIn(server.wait(third)["state"], ("done", "not_done"))
            for _ in range(17):
                server.json("POST", "/api/v1/runs", {"scenario": "long.yaml"}, status=202)
                time.sleep(0.02 if _ == 0 else 0)
            full = [server.request("POST", "/api/v1/runs", {"scenario": "long.yaml"})[0] for _ in range(2)]
            self.assertIn(429, full)
            began = time.monotonic()
            self.assertEqual(server.end(), 0)
            self.assertLess(time.monotonic() - began, 15)


class Live(Serve):
    def test_two_viewers_and_coming_back(self):
        with Server(self.folder) as server, WebSocket(server) as one, WebSocket(server) as two:
            one.send({"type": "runs"})
            self.assertEqual(self.valid("LiveRuns", one.receive())["runs"], [])
            run = server.json("POST", "/api/v1/runs", {"scenario": "court.yaml"}, status=202)["id"]
            one.send({"type": "watch", "run": run, "from": 0})
            told = [message for message in one.until("end") if message["type"] != "runs"]
            for message in told:
                self.valid("Live" + message["type"].capitalize(), message)
            numbers = [message["seq"] for message in told]
            self.assertEqual(numbers, sorted(set(numbers)))
            self.assertEqual(told[-1]["seq"], server.json("GET", f"/api/v1/runs/{run}")["seq"])
            report = server.json("GET", f"/api/v1/runs/{run}/report")
            self.assertEqual([event for m in told if m["type"] == "events" for event in m["events"]], report["events"])
            self.assertEqual([row for m in told if m["type"] == "samples" for row in m["rows"]], report["track"])
            self.assertEqual({"state", "progress", "scene", "growth", "end"} - {message["type"] for message in told}, set())
            scene = next(message["report"] for message in told if message["type"] == "scene")
            self.assertEqual(scene["world"], report["world"])
            targets = [m["report"]["targets"] for m in told if m["type"] == "growth" and "targets" in m["report"]]
            self.assertEqual(targets[-1], report["targets"])

            # A second viewer comes when it is over, leaves in the middle, and comes back for the rest.
            two.send({"type": "watch", "run": run, "from": 0})
            begin = [two.receive() for _ in range(2)]
            two.close()
            with WebSocket(server) as again:
                again.send({"type": "watch", "run": run, "from": begin[-1]["seq"]})
                rest = again.until("end")
            steady = [m for m in told if m["type"] != "progress"]
            self.assertEqual([m for m in begin + rest if m["type"] != "progress"], steady)

    def test_plans_while_dragging(self):
        with Server(self.folder) as server, WebSocket(server) as viewer:
            cells = server.json("POST", "/api/v1/maps", {"path": "small.map"})["id"]
            for i in range(60):
                viewer.send({"type": "plan", "id": i, "request": {"map": cells, "start": [0.5, 3.5], "goal": [5.5, i % 4 + 0.5]}})
            answers = {}
            while 59 not in answers:
                answer = self.valid("LivePlan", viewer.receive())
                self.assertNotIn(answer["id"], answers)
                answers[answer["id"]] = answer
            self.assertEqual(sorted(answers), list(range(60)))
            self.assertEqual(answers[59]["result"]["status"], "done")
            viewer.send({"type": "plan", "id": 60, "request": {"map": cells}})
            self.assertEqual(self.valid("LiveError", viewer.receive())["id"], 60)
            viewer.send({"type": "dance"})
            self.assertIn("watch", self.valid("LiveError", viewer.receive())["error"])
            viewer.send({"type": "watch", "run": "absent"})
            self.assertIn("no such run", self.valid("LiveError", viewer.receive())["error"])
            viewer.frame(1, b'{"type":', last=False)
            viewer.frame(0, b'"ping","id":5}')
            self.assertEqual(self.valid("LivePong", viewer.receive()), {"type": "pong", "id": 5})

    def test_two_hundred_viewers_and_one_that_stalls(self):
        with Server(self.folder) as server:
            viewers = [WebSocket(server) for _ in range(199)]
            stalled = WebSocket(server)
            stalled.connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            try:
                big = server.json("POST", "/api/v1/maps", {"grid": {"resolution_m": 1, "width": 200, "height": 200, "runs": [0, 40000]}})["id"]
                for i in range(40):  # megabytes that it never reads
                    stalled.send({"type": "plan", "id": i, "request": {"map": big, "start": [1, 1], "goal": [199, 150],
                                                                       "planner": "dijkstra", "trace": 40000}})
                    time.sleep(0.002)
                began = time.monotonic()
                run = server.json("POST", "/api/v1/runs", {"scenario": "court.yaml"}, status=202)["id"]
                for viewer in viewers:
                    viewer.send({"type": "watch", "run": run, "from": 0})
                for viewer in viewers:
                    self.assertEqual(viewer.until("end")[-1]["run"], run)
                self.assertLess(time.monotonic() - began, 60)
                extra = [WebSocket(server, hello=False) for _ in range(60)]
                self.assertIn(503, [one.status for one in extra])
                for one in extra:
                    one.close()
            finally:
                for viewer in [*viewers, stalled]:
                    viewer.close()
            server.json("GET", "/api/v1/version")

    def test_many_reconnects(self):
        with Server(self.folder) as server:
            run = server.json("POST", "/api/v1/runs", {"scenario": "court.yaml"}, status=202)["id"]
            server.wait(run)
            last = 0
            for i in range(costly_cases(100) if costly_cases(100) <= 100 else 1000):
                with WebSocket(server) as viewer:
                    viewer.send({"type": "watch", "run": run, "from": last})
                    if i % 3:  # some leave at once
                        last = viewer.receive()["seq"]
                        last = 0 if last == server.json("GET", f"/api/v1/runs/{run}")["seq"] else last
            server.json("GET", "/api/v1/version")


class Safety(Serve):
    def test_hosts_and_origins(self):
        with Server(self.folder) as server:
            own = f"http://127.0.0.1:{server.port}"
            for host in ("evil.example", "127.0.0.1.evil.example", "", None, f"10.0.0.1:{server.port}"):
                self.assertIn(server.request("GET", "/api/v1/version", Host=host)[0], (400, 403), host)
            for host in (f"localhost:{server.port}", "127.0.0.1", f"[::1]:{server.port}"):
                self.assertEqual(server.request("GET", "/api/v1/version", Host=host)[0], 200, host)
            for origin, status in [("http://evil.example", 403), ("null", 403), (own + ".evil.example", 403), (own, 201)]:
                self.assertEqual(server.request("PUT", "/api/v1/files/o.yaml", "a: 1\n", Origin=origin)[0], status, origin)
                self.assertEqual((self.folder / "o.yaml").exists(), status == 201)
            for method, path in [("POST", "/api/v1/runs"), ("POST", "/api/v1/plan"), ("POST", "/api/v1/maps"),
                                 ("DELETE", "/api/v1/runs/x")]:
                self.assertEqual(server.request(method, path, "{}", Origin="http://evil.example")[0], 403)
            self.assertEqual(WebSocket(server, Origin="http://evil.example").status, 403)
            self.assertEqual(WebSocket(server, Host="evil.example").status, 403)
            with WebSocket(server, Origin=own) as viewer:
                self.assertEqual(viewer.status, 101)
            preflight = server.request("OPTIONS", "/api/v1/runs", Origin="http://evil.example",
                                       Access_Control_Request_Method="DELETE")
            self.assertNotIn("access-control-allow-origin", preflight[1])

    def test_token(self):
        token = "0123456789abcdef"
        with Server(self.folder, "--token", token) as server:
            for headers, query in [({}, ""), ({"Authorization": "Bearer wrong"}, ""), ({}, "?token=" + token[:-1]), ({}, "?token=")]:
                answer = server.json("GET", "/api/v1/version" + query, status=401, **headers)
                self.assertIn("token", self.fault(answer, "unauthorized"))
                self.assertEqual(WebSocket(server, query, **headers).status, 401)
            server.json("GET", "/api/v1/version", Authorization="Bearer " + token)
            server.json("GET", "/api/v1/version?token=" + token)
            with WebSocket(server, "?token=" + token) as viewer:
                self.assertEqual(viewer.status, 101)

    def test_sizes_and_garbage(self):
        with Server(self.folder) as server:
            huge = f"POST /api/v1/plan HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: {10**12}\r\n\r\n{{".encode()
            self.assertIn(b" 413 ", server.raw(huge).split(b"\r\n")[0])
            deep = "[" * 100_000
            self.assertIn("deep", server.json("POST", "/api/v1/plan", deep.encode(), status=400)["error"])
            long_header = server.request("GET", "/api/v1/version", X="y" * 100_000)[0]
            self.assertIn(long_header, (0, 400, 413, 414, 431))
            grid = {"resolution_m": 1, "width": 100000, "height": 100000, "runs": [0, 10**10]}
            self.assertIn("4 million", server.json("POST", "/api/v1/maps", {"grid": grid}, status=400)["error"])
            for data in (b"\0" * 1000, b"GET\r\n\r\n", b"\x16\x03\x01\x02\0\x01\0\x01\xfc\x03\x03", os.urandom(5000),
                         b"GET / HTTP/9.9\r\n\r\n", b"GET /api/v1/files/\xff\xfe HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n",
                         b"POST /api/v1/runs HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: -5\r\n\r\n",
                         b"POST /api/v1/plan HTTP/1.1\r\nHost: 127.0.0.1\r\nTransfer-Encoding: chunked\r\n\r\nzz\r\n"):
                with server.connect() as connection:
                    connection.sendall(data)
                    connection.shutdown(socket.SHUT_WR)
                    try:
                        connection.recv(65536)
                    except ConnectionResetError:
                        pass
            for opcode, data in ((1, b"\xff\xfe"), (1, b"[1]"), (2, b"{}"), (3, b"x"), (1, b"{" * 1000)):
                with WebSocket(server) as viewer:
                    viewer.frame(opcode, data)
                    with self.assertRaises(ConnectionError):
                        viewer.receive()
            with WebSocket(server) as viewer:  # a frame that claims to be as long as no memory is
                viewer.frame(1, b"x", length=2**62)
                with self.assertRaises(ConnectionError):
                    viewer.receive()
            server.json("GET", "/api/v1/version")

    def test_half_open_connections(self):
        with Server(self.folder) as server:
            idle = [server.connect() for _ in range(40)]
            for connection in idle[20:]:
                connection.sendall(b"POST /api/v1/plan HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 100\r\n\r\n{")
            server.json("GET", "/api/v1/version")
            if costly_cases(1) > 1:  # they are let go after ten seconds
                for connection in idle:
                    connection.settimeout(25)
                    while connection.recv(4096):
                        pass
            for connection in idle:
                connection.close()

    def test_kill_and_restart_on_the_same_port(self):
        server = Server(self.folder)
        with WebSocket(server):
            run = server.json("POST", "/api/v1/runs", {"scenario": "long.yaml"}, status=202)["id"]
            while server.json("GET", f"/api/v1/runs/{run}")["state"] == "queued":
                time.sleep(0.01)
            children = pathlib.Path(f"/proc/{server.process.pid}/task").glob("*/children")
            missions = [int(pid) for child in children for pid in child.read_text().split()]
            self.assertEqual(len(missions), 1)
            server.end(kill=True)
        end = time.monotonic() + 10
        while pathlib.Path(f"/proc/{missions[0]}/exe").exists() and time.monotonic() < end:
            time.sleep(0.02)
        self.assertFalse(pathlib.Path(f"/proc/{missions[0]}/exe").exists(), "the mission outlived its server")
        with Server(self.folder, port=server.port) as again:
            self.assertEqual(again.json("GET", "/api/v1/runs"), {"runs": []})
            again.json("GET", f"/api/v1/runs/{run}", status=404)
            self.refused("serve", ".", "--port", again.port, says=["--port", str(again.port), "taken"])

    def test_refusals(self):
        self.refused("serve", "absent", says=["DIR", "absent", "no folder"])
        self.refused("serve", "--listen", "0.0.0.0", says=["--listen", "--token"])
        self.refused("serve", "--token", "short", says=["--token", "16"])
        self.refused("serve", "--listen", "nowhere", "--token", "0123456789abcdef", says=["--listen", "nowhere"])
        self.refused("serve", "--port", "70000", says=["--port", "65535"])


if __name__ == "__main__":
    main()
