"""`outrider serve` for Foxglove and Lichtblick: a client written from the published protocol watches a mission.

Source: docs/spec.md of https://github.com/foxglove/ws-protocol.
"""
import json
import math
import os
import pathlib
import re
import socket
import struct

from building import write_building
from mcap_log import pose_stamped
from serve_case import Serve
from server_client import Server, WebSocket
from tool import main, until

SUBPROTOCOL = "foxglove.websocket.v1"


class Client(WebSocket):
    """One who speaks the protocol."""

    def __init__(self, server, query="", path="/", offers=SUBPROTOCOL, **headers):
        super().__init__(server, query, hello=False, path=path, Sec_WebSocket_Protocol=offers, **headers)
        self.channels, self.messages, self.clock, self.statuses = {}, {}, None, []
        if self.status == 101:
            self.info = self.until("serverInfo")

    def take(self):
        """Takes the next message: its op, or the id of the subscription that it has data of."""
        opcode, data = self.next()
        if opcode == 1:
            message = json.loads(data)
            if message["op"] == "advertise":
                self.channels |= {channel["id"]: channel for channel in message["channels"]}
            elif message["op"] == "unadvertise":
                for one in message["channelIds"]:
                    del self.channels[one]
            elif message["op"] == "status":
                self.statuses.append(message)
            self.last = message
            return message["op"]
        if data[0] == 2:
            clock = struct.unpack("<Q", data[1:])[0]
            assert self.clock is None or clock > self.clock, (clock, self.clock)
            self.clock = clock
            return "time"
        assert data[0] == 1, data[0]
        subscription, time_ns = struct.unpack_from("<IQ", data, 1)
        self.messages.setdefault(subscription, []).append((time_ns, data[13:]))
        return subscription

    def until(self, op):
        while self.take() != op:
            pass
        return self.last

    def channel(self, topic):
        """The id of a channel, once it is advertised."""
        while True:
            for one in self.channels.values():
                if one["topic"] == topic:
                    return one["id"]
            self.take()

    def subscribe(self, **channels):
        self.send({"op": "subscribe", "subscriptions": [{"id": int(name[1:]), "channelId": one} for name, one in channels.items()]})

    def count(self, subscription, count):
        """The first messages of a subscription."""
        while len(self.messages.get(subscription, [])) < count:
            self.take()
        return self.messages[subscription][:count]


class Foxglove(Serve):
    def test_a_running_mission(self):
        with Server(self.folder) as server, Client(server) as client:
            self.assertEqual(client.info["capabilities"], ["time"])
            self.assertIn(f"Sec-WebSocket-Protocol: {SUBPROTOCOL}", client.head)
            client.until("advertise")
            self.assertEqual(client.channels, {}, "no mission runs")
            run = self.started(server, {"text": write_building(self, rooms=2)})
            server.pass_on(time=0)
            scene = client.channel("/run")
            server.pass_on(time=1)
            pose = client.channel("/pose")
            self.still_running(server, run)
            server.pass_on()
            for one in client.channels.values():
                self.assertEqual((one["encoding"], one["schemaEncoding"]), ("cdr", "ros2msg"))
                self.assertRegex(one["schemaName"], r"^[a-z0-9_]+/msg/[A-Za-z0-9]+$")
                self.assertTrue(one["schema"])
            self.assertEqual(client.channels[pose]["schemaName"], "geometry_msgs/msg/PoseStamped")
            client.subscribe(_5=pose, _6=scene)
            poses = client.count(5, 100)
            self.assertEqual(client.messages[6][0][0], 0, "what stands still is a message at time 0")
            before = None
            for time_ns, data in poses:
                stamp, frame, x, y, z, qx, qy, qz, qw = pose_stamped(data)
                self.assertEqual(frame, "map")
                self.assertAlmostEqual(stamp, 1e-9 * time_ns, 6)
                self.assertAlmostEqual(math.hypot(qx, qy, qz, qw), 1.0, 9)
                self.assertTrue(0 < x < 8 and 0 < y < 8, (x, y))
                if before:
                    self.assertGreaterEqual(time_ns, before[0])
                    self.assertLess(math.hypot(x - before[1], y - before[2]), 0.3)
                before = (time_ns, x, y)
            client.send({"op": "unsubscribe", "subscriptionIds": [5, 6]})
            while not any("has ended" in status["message"] for status in client.statuses):
                client.take()  # a client that does not read is sent away
            ended = server.wait(run)
            self.assertIn(ended["state"], ("done", "not_done"), ended)

            # The next mission replaces its channels.
            old = dict(client.channels)
            server.json("POST", "/api/v1/runs", {"scenario": "court.yaml"}, status=202)
            self.assertEqual(sorted(client.until("unadvertise")["channelIds"]), sorted(old))
            self.assertNotIn(client.channel("/pose"), old)
            with Client(server, query=f"?run={run}", path="/foxglove") as late:
                late.channel("/pose")
                late.subscribe(_1=late.channel("/pose"))
                self.assertEqual(late.count(1, 100), poses, "a run that has ended can still be read")

    def sockets(self, server):
        """How many sockets the server has open."""
        count = 0
        for link in pathlib.Path(f"/proc/{server.process.pid}/fd").iterdir():
            try:
                count += os.readlink(link).startswith("socket:")
            except FileNotFoundError:
                pass  # it was closed meanwhile
        return count

    def result_of_run(self, server, run):
        server.wait(run)
        return server.request("GET", f"/api/v1/runs/{run}/result")[2]

    def test_stalled_clients_cost_a_mission_nothing(self):
        """Clients ask for all of a mission, read nothing, and say often that they are there: it ends before they go."""
        scenario = write_building(self, rooms=4)  # a log of more bytes than connections hold
        with Server(self.folder) as server:
            alone = server.json("POST", "/api/v1/runs", {"text": scenario}, status=202)["id"]
            result = self.result_of_run(server, alone)
            stalled = [Client(server) for _ in range(2)]
            page = WebSocket(server)
            for one in (*stalled, page):
                one.connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            run = self.started(server, {"text": scenario})
            server.pass_on(time=0)
            page.send({"type": "watch", "run": run})
            for one in stalled:
                one.until("unadvertise")  # of the mission before
                one.channel("/pose")
                one.subscribe(**{f"_{number}": number for number in one.channels})
            server.pass_on()

            def ended():
                for one in (*stalled, page):
                    one.frame(10, b"")
                return server.json("GET", f"/api/v1/runs/{run}")["state"] != "running"

            until("the end of the mission", ended)
            self.assertEqual(self.result_of_run(server, run), result)
            until("nobody but them, and the socket at which it listens", lambda: self.sockets(server) == 2 + len(stalled))
            until("the end of those who do not read", lambda: self.sockets(server) == 1)
            for one in (*stalled, page):
                one.close()

    def test_who_may(self):
        with Server(self.folder) as server:
            for offers, spoken in [("foxglove.sdk.v1", "foxglove.sdk.v1"), (SUBPROTOCOL, SUBPROTOCOL),
                                   ("foxglove.websocket.v1, foxglove.sdk.v1", "foxglove.sdk.v1")]:
                with Client(server, offers=offers) as client:
                    self.assertEqual(re.search(r"Sec-WebSocket-Protocol: (\S+)", client.head)[1], spoken)
            self.assertEqual(Client(server, offers="mqtt").status, 400)
            self.assertEqual(Client(server, query="?run=absent").status, 404)
            self.assertEqual(Client(server, path="/other").status, 404)
            self.assertEqual(Client(server, Origin="https://app.foxglove.dev").status, 403)
            self.assertEqual(Client(server, Host="evil.example").status, 403)
        token = "0123456789abcdef"
        with Server(self.folder, "--token", token) as server:
            self.assertEqual(Client(server).status, 401)
            with Client(server, query=f"?token={token}", Origin="https://app.foxglove.dev") as client:
                self.assertEqual(client.status, 101)

    def test_nonsense(self):
        with Server(self.folder) as server:
            for text in (b"", b"[]", b"{", b"\xff"):
                with Client(server) as client:
                    client.frame(1, text)
                    with self.assertRaises(ConnectionError):
                        while True:
                            client.take()
            with Client(server) as client:
                client.frame(2, b"\x01\x00\x00\x00\x00data")  # nothing can be published here
                with self.assertRaises(ConnectionError):
                    while True:
                        client.take()
            with Client(server) as client:
                client.send({"op": "subscribe", "subscriptions": [{"id": -1, "channelId": "x"}]})
                self.assertEqual(client.until("status")["level"], 2)
                client.send({"op": "clientInfo"})
                client.send({"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 1}]})
                client.send({"op": "subscribe"})
                self.assertEqual(client.until("status")["level"], 2)


if __name__ == "__main__":
    main()
