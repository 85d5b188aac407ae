"""The base of the tests of `outrider serve`: a folder with a small yard, and messages that keep their schemas."""
from schema_check import refusals, schemas
from tool import ToolTest, until

ROOM = "(0,0) (6,0) (6,4) (0,4)\n---\n(2,1) (3,1) (3,3) (2,3)\n---\n(1,2) (5,2)\n"
COURT = "job: guard\nworld: yard.sdf\ntargets: targets.txt\nstart: 0,-2,90\nseed: 4\nplan:\n  resolution: 0.2\n  iterations: 50\n  refinements: 0\n"


class Serve(ToolTest):
    def setUp(self):
        super().setUp()
        self.write("court.yaml", COURT)
        self.write("long.yaml", COURT)  # for started()
        self.write("room.txt", ROOM)
        self.write(".hidden.yaml", "job: guard\n")

    def valid(self, name, value):
        """The message keeps the schema of that name."""
        self.assertEqual(refusals(schemas()["$defs"][name], value), [], f"{name}: {str(value)[:300]}")
        return value

    def started(self, server, request):
        """The id of a mission that has begun, and waits from its first message on until the test passes on more."""
        server.hold(request.get("scenario", "unsaved"))
        run = server.json("POST", "/api/v1/runs", request, status=202)["id"]
        until("its begin", lambda: server.json("GET", f"/api/v1/runs/{run}")["state"] != "queued")
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
