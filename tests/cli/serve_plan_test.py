"""`outrider serve` from outside: maps and plans, and scenarios that answer as the page does."""
import base64
import struct
import zlib

from serve_case import ROOM, Serve
from server_client import Server
from tool import MAP, YARD, main


def small_png(width, height, values):
    """A grey PNG of 8 bits."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + bytes(values[width * y:width * (y + 1)]) for y in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def untimed(answer):
    """Returns an answer of `plan --json`, from the tool or the server, without times on the wall, files and the view."""
    metrics = {name: value for name, value in answer["metrics"].items() if name not in ("planning_s", "building_s")}
    rows = [{name: value for name, value in row.items() if name not in ("time_s", "build_s")} for row in answer["rows"]]
    return {name: answer[name] for name in ("status", "job", "reason", "warnings")} | {"metrics": metrics, "rows": rows}


class Plans(Serve):
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
            self.assertAlmostEqual(plan["metrics"]["length_m"], 5 + 3 * 2 ** 0.5)
            rows = plan["view"]["trace"]["rows"]
            self.assertEqual(len(rows), plan["metrics"]["expansions"])
            for row in rows:
                self.assertAlmostEqual(row[4], row[5] + row[6])
            # As the tool itself has it.
            tool = self.json_of(self.run_tool("plan", "small.map", "--from", "0.5,3.5", "--to", "5.5,3.5", "--planner",
                                              "a_star", "--model", "cells", "--json"))
            self.assertEqual(set(plan), {*tool, "view"})
            self.assertEqual(untimed(plan), untimed(tool))
            shut = {**question, "edits": [{"block": [3, 0, 1, 1]}]}
            none = self.valid("Plan", server.json("POST", "/api/v1/plan", shut))
            self.assertEqual((none["status"], none["rows"][0]["status"]), ("not_done", "no_path"))
            opened = {**question, "edits": [{"block": [3, 0, 1, 1]}, {"free": [3, 3, 1, 1]}]}
            self.assertAlmostEqual(server.json("POST", "/api/v1/plan", opened)["metrics"]["length_m"], 5.0)
            blocked = server.json("POST", "/api/v1/plan", {**question, "start": [3.5, 3.5]})
            self.assertEqual((blocked["status"], blocked["rows"][0]["status"]), ("not_done", "start_blocked"))

            room = self.valid("Map", server.json("POST", "/api/v1/maps", {"path": "room.txt"}))
            question = {"map": room["id"], "start": [1, 2], "goal": [5, 2], "planner": "visibility_graph",
                        "radius_m": 0.1, "legs": True}
            straight = self.valid("Plan", server.json("POST", "/api/v1/plan", {**question, "edits": [{"remove": 0}]}))
            self.assertAlmostEqual(straight["metrics"]["length_m"], 4.0)
            round_it = self.valid("Plan", server.json("POST", "/api/v1/plan", {**question, "trace": 1000}))
            self.assertGreater(round_it["metrics"]["length_m"], 4.0)
            trace = round_it["view"]["trace"]
            self.assertEqual(len(trace["rows"]), round_it["metrics"]["expansions"])
            ends = [trace["places"][row[0]] for row in (trace["rows"][0], trace["rows"][-1])]
            self.assertEqual(ends, [question["start"], question["goal"]])
            opened = dict(zip(trace["openings"][::2], trace["openings"][1::2]))
            for i, row in enumerate(trace["rows"]):
                self.assertLessEqual(opened[row[0]], i)

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
                self.assertEqual(untimed(tool), untimed(plan), question)
                self.assertTrue((self.folder / f"out_{i}/run.svg").is_file())
                # Opened again it is the same question.
                shown = self.valid("Scenario", server.json("GET", f"/api/v1/scenarios/{path}"))
                again = {name: shown[name] for name in ("start", "goal", "planner", "options", "model", "radius_m", "resolution_m")}
                again = server.json("POST", "/api/v1/plan", {"map": shown["map"]["id"], **again})
                self.assertEqual(untimed(again), untimed(plan))
            kinds = {file["path"]: (file["kind"], file.get("job")) for file in server.json("GET", "/api/v1/files")["files"]}
            self.assertEqual(kinds["case_0.yaml"], ("scenario", "plan"))
            self.assertEqual(kinds["case_0_map.yaml"][0], "map")
        self.refused("run", "case_0.yaml", "--seed", "3", says=["--seed", "plan"])
        self.write("broken.yaml", "job: plan\nmap: small.map\nfrom: 0.5,3.5\nto: 9\n")
        self.refused("run", "broken.yaml", says=["to", "x,y"])

    def test_a_map_of_every_kind_is_read_as_it_is_dropped(self):
        """The bytes that the page sends when a file is dropped; a broken one is refused with a sentence that names it."""
        pgm = b"P5\n4 3\n255\n" + bytes([254] * 5 + [0] * 2 + [254] * 5)
        png = small_png(4, 3, [254] * 5 + [0] * 2 + [254] * 5)
        yaml = "image: {}\nresolution: 0.5\norigin: [1, 2, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
        runs = [0, 5, 1, 2, 0, 5]
        good = [([("m.yaml", yaml.format("m.pgm")), ("m.pgm", pgm)], "grid"), ([("m.png", png), ("m.yaml", yaml.format("m.png"))], "grid"),
                ([("m.png", png)], "grid"), ([("m.pgm", pgm)], "grid"), ([("small.map", MAP)], "grid"), ([("small", MAP)], "grid"),
                ([("room.txt", ROOM)], "polygons"), ([("yard.sdf", YARD)], "polygons")]
        broken = [([("m.yaml", yaml.format("m.pgm"))], "m.pgm", "no such file"), ([("m.yaml", "image: [")], "m.yaml", "YAML"),
                  ([("m.png", png[:40])], "m.png", ""), ([("m.pgm", pgm[:-3])], "m.pgm", ""), ([("a.map", MAP[:-3])], "a.map", ""),
                  ([("room.txt", "(0,0) (1\n---\n")], "room.txt:1", "is no corner"), ([("w.sdf", "<sdf><model")], "w.sdf", ""),
                  ([("a.jpg", b"\xff\xd8\xff\xe0")], "a.jpg", "what kind of map")]
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

if __name__ == "__main__":
    main()
