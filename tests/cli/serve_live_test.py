"""`outrider serve` from outside: many viewers of one mission, some of which stall, leave and come back."""
import socket

from building import write_building
from mcap_log import McapLog
from serve_case import Serve
from server_client import Server, WebSocket
from tool import costly_cases, main


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
            numbers = [message["seq"] for message in told if message["type"] != "log"]
            self.assertEqual(numbers, sorted(set(numbers)))
            self.assertEqual(told[-1]["seq"], server.json("GET", f"/api/v1/runs/{run}")["seq"])
            self.assertEqual({message["type"] for message in told}, {"state", "progress", "log", "end"})
            self.assertEqual([message["from"] for message in told if message["type"] == "log"], [0])
            self.assertTrue(told[-1]["has_log"] and told[-1]["has_result"])

            log = McapLog(one.log)
            self.assertTrue(log.complete)
            self.assertEqual(log.attachments["run.json"], server.request("GET", f"/api/v1/runs/{run}/result")[2])
            self.assertGreater(len(log.of("/pose")), 10)
            stored = server.request("GET", f"/api/v1/runs/{run}/log")[2]
            self.assertEqual((stored[:8], stored[-8:]), (one.log[:8], one.log[-8:]))

            # A second viewer comes when it is over, leaves in the middle, and comes back for the rest.
            two.send({"type": "watch", "run": run, "from": 0})
            begin = [two.receive() for _ in range(2)]
            while len(two.log) < 1000:
                two.log += two.next()[1]
            two.close()
            seen = [message for message in begin if "seq" in message]
            with WebSocket(server) as again:
                again.send({"type": "watch", "run": run, "from": seen[-1]["seq"], "log": 1000})
                rest = again.until("end")
            self.assertEqual(two.log[:1000] + again.log, one.log)
            steady = [m for m in told if m["type"] not in ("progress", "log")]
            self.assertEqual([m for m in seen + rest if m["type"] not in ("progress", "log")], steady)

    def test_the_log_comes_while_the_mission_runs(self):
        scenario = write_building(self)
        with Server(self.folder) as server, WebSocket(server) as viewer:
            run = self.started(server, {"text": scenario})
            viewer.send({"type": "watch", "run": run})
            for time_s in (1, 2):
                server.pass_on(time=time_s)
                while max((one.time_ns for one in McapLog(viewer.log).messages), default=0) < 1e9 * (time_s - 0.5):
                    opcode, data = viewer.next()
                    viewer.log += data if opcode == 2 else b""
                self.still_running(server, run)
            self.assertGreater(len(McapLog(viewer.log).of("/pose")), 0)
            self.assertEqual(server.json("GET", f"/api/v1/runs/{run}/log", status=404)["code"], "not_found")
            server.json("DELETE", f"/api/v1/runs/{run}")
            self.assertEqual(viewer.until("end")[-1]["state"], "cancelled")

    def test_parts_of_a_log(self):
        size = 3 << 30  # a hole, which takes no place on the disk
        with open(self.folder / "long.mcap", "wb") as file:
            file.truncate(size - 4)
            file.seek(size - 4)
            file.write(b"tail")
        with Server(self.folder) as server:
            files = self.valid("Files", server.json("GET", "/api/v1/files"))["files"]
            self.assertEqual([(one["path"], one["bytes"]) for one in files if one["kind"] == "log"], [("long.mcap", size)])
            status, headers, body = server.request("GET", "/api/v1/files/long.mcap", Range="bytes=-8")
            self.assertEqual((status, body), (206, b"\0\0\0\0tail"))
            self.assertEqual(headers["content-range"], f"bytes {size - 8}-{size - 1}/{size}")
            status, headers, body = server.request("HEAD", "/api/v1/files/long.mcap")
            self.assertEqual((status, headers["content-length"], headers["accept-ranges"]), (200, str(size), "bytes"))
            status, headers, body = server.request("GET", "/api/v1/files/long.mcap", Range=f"bytes={size}-")
            self.assertEqual((status, headers["content-range"]), (416, f"bytes */{size}"))

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
                run = server.json("POST", "/api/v1/runs", {"scenario": "court.yaml"}, status=202)["id"]
                for viewer in viewers:
                    viewer.send({"type": "watch", "run": run, "from": 0})
                for viewer in viewers:
                    stalled.frame(10, b"")  # whoever says nothing either would soon be sent away
                    self.assertEqual(viewer.until("end")[-1]["run"], run)
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
                        last = viewer.receive().get("seq", last)
                        last = 0 if last == server.json("GET", f"/api/v1/runs/{run}")["seq"] else last
            server.json("GET", "/api/v1/version")

if __name__ == "__main__":
    main()
