"""What the tests of `outrider serve` share: a folder with a small yard, and messages that keep their schemas."""
import time

from schema_check import refusals, schemas
from tool import ToolTest

ROOM = "(0,0) (6,0) (6,4) (0,4)\n---\n(2,1) (3,1) (3,3) (2,3)\n---\n(1,2) (5,2)\n"
COURT = "job: guard\nworld: yard.sdf\ntargets: targets.txt\nstart: 0,-2,90\nseed: 4\nplan:\n  resolution: 0.2\n  iterations: 50\n  refinements: 0\n"
# Plans for a quarter of a minute or more; whoever needs that asserts still_running().
LONG = (COURT.replace("resolution: 0.2", "resolution: 0.01").replace("iterations: 50", "iterations: 10000000")
        .replace("refinements: 0", "refinements: 20"))


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

    def started(self, server, request):
        """The id of a long mission that has begun."""
        run = server.json("POST", "/api/v1/runs", request, status=202)["id"]
        while server.json("GET", f"/api/v1/runs/{run}")["state"] == "queued":
            time.sleep(0.01)
        self.still_running(server, run)
        return run

    def still_running(self, server, run):
        """The premise of a test that ends a mission: it has not ended of itself."""
        state = server.json("GET", f"/api/v1/runs/{run}")
        self.assertEqual(state["state"], "running", state)

    def fault(self, answer, code):
        fault = self.valid("Error", answer)
        self.assertEqual(fault["code"], code)
        return fault["error"]
