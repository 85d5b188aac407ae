"""`outrider serve` from outside: a yard that was changed is run as it was shown."""
import math

from mcap_log import targets_of
from serve_case import Serve
from server_client import Server
from tool import main


class Yards(Serve):
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
        # A yard with nothing moved is the same mission; one with something moved is another.
        for name in ("court", "same", "moved"):
            self.json_of(self.run_tool("run", f"{name}.yaml", "--json", "--out", name))
        self.same_mission("court", "same")
        self.assertIn("new", targets_of(self.log_of("moved")))
    def placed(self, thing):
        """The polygons of a thing where it stands, as the page draws them."""
        c, s = math.cos(thing["turn_rad"]), math.sin(thing["turn_rad"])
        (mx, my), (x, y) = thing["middle"], thing["place"]
        return [[[x + c * (u - mx) - s * (v - my), y + s * (u - mx) + c * (v - my)] for u, v in polygon]
                for polygon in thing["polygons"]]

    def test_things_that_were_moved_stand_there_when_it_is_run(self):
        """The page draws before it saves what the log of the saved scenario has."""
        with Server(self.folder) as server:
            shown = self.valid("Scenario", server.json("GET", "/api/v1/scenarios/court.yaml"))
            self.assertEqual([thing["name"] for thing in shown["things"]], ["north", "south", "east", "west", "crate"])
            crate = shown["things"][-1]
            crate.update(place=[-1, 0.5], turn_rad=0.7)
            preview = self.placed(crate)[0]
            fox = next(target for target in shown["targets"] if target["name"] == "fox")
            request = {"scenario": "court.yaml", "start": [0, -1.5], "heading_rad": 2, "removed": ["east"],
                       "targets": [{"name": "fox", "position": fox["position"][:2], "heading_rad": 0.5}],
                       "moved": [{"name": "crate", "place": crate["place"], "turn_rad": 0.7}]}
            server.json("PUT", "/api/v1/scenarios/turned.yaml", {"guard": request}, status=201)
            again = self.valid("Scenario", server.json("GET", "/api/v1/scenarios/turned.yaml"))
            self.assertEqual(again["map"]["polygons"]["boundary"], shown["map"]["polygons"]["boundary"])
            refused = server.json("PUT", "/api/v1/scenarios/x.yaml", {"guard": {**request, "removed": ["est"]}}, status=400)
            self.assertIn("near to it are 'east'", self.fault(refused, "bad_input"))
        text = (self.folder / "turned.yaml").read_text()
        self.assertRegex(text, r"moved: .?crate=-1,0.5,40\.1")
        self.assertRegex(text, r"removed: .?east")
        self.json_of(self.run_tool("run", "turned.yaml", "--json", "--out", "out"))
        log = self.log_of("out")
        solids = {solid.name: solid for solid in log.latest("/solids").solids}
        self.assertNotIn("east", solids)
        core = solids["crate"].footprint[0].points
        for x, y in preview:
            self.assertLess(min(math.hypot(x - one.x, y - one.y) for one in core), 1e-4, (preview, core))
        start = log.read("/pose")[0][1].pose.orientation
        self.assertAlmostEqual(2 * math.atan2(start.z, start.w), 2, 3)
        self.assertAlmostEqual(targets_of(log)["fox"].yaw, 0.5, 3)
        self.refused("run", "court.yaml", "--moved", "cratte=1,2,3", says=["moved", "cratte", "'crate'"])
        self.refused("run", "court.yaml", "--removed", "floor", says=["removed", "'floor'", "ground"])


if __name__ == "__main__":
    main()
