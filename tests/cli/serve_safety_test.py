"""`outrider serve` from outside: whom it refuses, and that nothing that is sent breaks it."""
import os
import pathlib
import socket
import time

from serve_case import Serve
from server_client import Server, WebSocket
from tool import in_soak, main, until


class Safety(Serve):
    def test_hosts_and_origins(self):
        with Server(self.folder) as server:
            own = f"http://127.0.0.1:{server.port}"
            for host in ("evil.example", "127.0.0.1.evil.example", "", None, f"10.0.0.1:{server.port}",
                         "localhost:80@evil.example", "[::1].evil.example", "127.0.0.1:x"):
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

    def test_pages_of_other_sites_cost_nothing(self):
        with Server(self.folder) as server:
            for headers in ({"Origin": "http://evil.example"}, {"Sec_Fetch_Site": "cross-site"}, {"Sec_Fetch_Site": "same-site"}):
                for path in ("files", "files/court.yaml", "scenes/court.yaml", "scenarios/court.yaml", "catalogue", "runs"):
                    self.fault(server.json("GET", "/api/v1/" + path, status=403, **headers), "forbidden")
                self.assertNotEqual(server.request("GET", "/", **headers)[0], 403, "a link to the page")
            server.json("GET", "/api/v1/files", Sec_Fetch_Site="same-origin")

    def test_headers_that_two_programs_would_read_in_two_ways(self):
        with Server(self.folder) as server:
            def status(*lines):
                return int(server.raw("\r\n".join(["GET /api/v1/version HTTP/1.1", *lines, "", ""]).encode()).split()[1])
            own = f"Host: 127.0.0.1:{server.port}"
            self.assertEqual(status(own), 200)
            self.assertEqual(status(own, "Accept: a", "Accept: b"), 200)
            for lines in ((own, "Host: evil.example"), ("Host: evil.example", own), (own, own), (own, "X: a", " b"), (own, "X: a", "\tb"),
                          (" " + own, own), (own, "Origin: http://evil.example", f"Origin: http://127.0.0.1:{server.port}"),
                          (own, "Authorization: Bearer a", "Authorization: Bearer b")):
                self.assertEqual(status(*lines), 400, lines)
            with server.connect() as connection:  # in pieces
                for part in ("GET /api/v1/ver", f"sion HTTP/1.1\r\n{own}\r", "\n\r", "\n"):
                    connection.sendall(part.encode())
                    time.sleep(0.05)
                self.assertEqual(connection.recv(12), b"HTTP/1.1 200")

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
                    try:
                        connection.sendall(data)
                        connection.shutdown(socket.SHUT_WR)
                        connection.recv(65536)
                    except TimeoutError:
                        raise
                    except OSError:
                        pass  # it had enough before everything was sent
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
            if in_soak():  # they are let go after ten seconds
                for connection in idle:
                    while connection.recv(4096):
                        pass
            for connection in idle:
                connection.close()

    def children(self, server):
        """The processes of the server, once there is one: a run is "running" a moment before its process exists."""
        def found():
            pids = []
            for task in pathlib.Path(f"/proc/{server.process.pid}/task").glob("*/children"):
                try:
                    pids += [int(pid) for pid in task.read_text().split()]
                except (FileNotFoundError, ProcessLookupError):
                    pass  # that thread has ended
            return pids

        return until("a process", found)

    def test_kill_and_restart_on_the_same_port(self):
        server = Server(self.folder)
        with WebSocket(server):
            run = self.started(server, {"scenario": "long.yaml"})
            missions = self.children(server)
            self.assertEqual(len(missions), 1)
            self.still_running(server, run)
            server.end(kill=True)
        until("the end of the mission after that of its server", lambda: not pathlib.Path(f"/proc/{missions[0]}/exe").exists())
        with Server(self.folder, port=server.port) as again:
            self.assertEqual([(one["id"], one["state"]) for one in again.json("GET", "/api/v1/runs")["runs"]], [(run, "cut_short")])
            self.refused("serve", ".", "--port", again.port, says=["--port", str(again.port), "taken"])

    def test_refusals(self):
        self.refused("serve", "absent", says=["DIR", "absent", "no folder"])
        self.refused("serve", "--listen", "0.0.0.0", says=["--listen", "--token"])
        self.refused("serve", "--token", "short", says=["--token", "16"])
        self.refused("serve", "--listen", "nowhere", "--token", "0123456789abcdef", says=["--listen", "nowhere"])
        self.refused("serve", "--port", "70000", says=["--port", "65535"])

if __name__ == "__main__":
    main()
