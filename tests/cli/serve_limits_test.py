"""`outrider serve` under those who ask for too much: bounded in all, and quick for everybody else."""
import os
import pathlib
import resource
import subprocess

import serve_load
from serve_case import Serve
from server_client import Server
from serve_load import MIB, memory_mib, settled_memory_mib
from tool import TOOL, main, until

# The memory that the server may hold, whatever is done to it. A sanitizer keeps what was freed, to watch it.
SANITIZED = b"libasan" in subprocess.run(["ldd", TOOL], capture_output=True, check=True).stdout
MOST_MIB = 3000 if SANITIZED else 300


class Limits(Serve):
    def check_memory(self, server):
        self.assertLess(settled_memory_mib(server, MOST_MIB), MOST_MIB)

    def answers(self, server):
        server.json("GET", "/api/v1/version")

    def test_readers_that_stall(self):
        (self.folder / "large.json").write_bytes(b"x" * (60 * MIB))
        with Server(self.folder) as server:
            readers = serve_load.stalled_readers(server, "large.json", 20)
            for reader in readers:
                self.assertEqual(reader.recv(12), b"HTTP/1.1 200", "the premise: they are being served")
            self.answers(server)
            self.assertLess(memory_mib(server), MOST_MIB)
            for reader in readers:
                reader.close()
            status, headers, body = server.request("GET", "/api/v1/files/large.json")
            self.assertEqual((status, len(body)), (200, 60 * MIB))

    def test_half_requests(self):
        with Server(self.folder) as server:
            connections = serve_load.half_requests(server, 320)
            self.answers(server)
            self.check_memory(server)
            for connection in connections:
                connection.close()

    def test_more_connections_than_there_are_places(self):
        _, most = resource.getrlimit(resource.RLIMIT_NOFILE)
        if most < 1500:
            self.skipTest("this machine allows too few open files")
        resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))
        with Server(self.folder) as server:
            connections = [server.connect() for _ in range(400)]
            connections += serve_load.half_requests(server, 800)
            self.answers(server)  # those that have waited longest give way
            for connection in connections:
                connection.close()

    def test_small_files_that_unpack_to_large_ones(self):
        with Server(self.folder) as server:
            statuses = serve_load.packed_maps(server, 10)
            self.assertTrue(set(statuses) <= {400, 503}, statuses)
            self.check_memory(server)

    def test_text_that_becomes_many_values(self):
        with Server(self.folder) as server:
            statuses = serve_load.many_values(server, 10)
            self.assertTrue(set(statuses) <= {400, 503}, statuses)
            self.check_memory(server)

    def test_a_small_world_of_many_models(self):
        self.write("crowd.sdf", serve_load.crowded_world(200))
        self.assertLess((self.folder / "crowd.sdf").stat().st_size, 50_000)
        with Server(self.folder) as server:
            status, _, body = server.request("POST", "/api/v1/maps", {"path": "crowd.sdf"})
            self.assertIn(status, (200, 400, 503), body[:300])
            self.check_memory(server)

    def reader_pids(self, server):
        children = pathlib.Path(f"/proc/{server.process.pid}/task").glob("*/children")
        return [int(pid) for child in children for pid in child.read_text().split()]

    def test_nobody_reads_on_for_a_client_that_has_left(self):
        with Server(self.folder) as server:
            server.hold("serve-reader")
            with server.connect() as connection:
                body = b'{"path": "yard.sdf"}'
                connection.sendall(b"POST /api/v1/maps HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: application/json\r\n"
                                   b"Content-Length: %d\r\n\r\n" % len(body) + body)
                until("a reader", lambda: self.reader_pids(server))
            until("the end of the reader", lambda: not self.reader_pids(server))

    def test_a_flood_without_the_token_starves_nobody_who_has_it(self):
        token = "0123456789abcdef"
        with Server(self.folder, "--token", token) as server:
            def flood():
                statuses = serve_load.together(8, lambda: [server.request("GET", "/api/v1/version")[0] for _ in range(100)])
                return {status for some in statuses for status in some}

            self.assertEqual(until("a flood that is held back", lambda: (got := flood()) != {401} and got), {401, 429})
            for _ in range(50):
                server.json("GET", "/api/v1/version", Authorization="Bearer " + token)

    def test_it_ends_at_once_whatever_is_under_way(self):
        server = Server(self.folder)
        run = self.started(server, {"scenario": "long.yaml"})
        connections = serve_load.half_requests(server, 20)
        self.still_running(server, run)
        self.assertEqual(server.end(), 0)
        for connection in connections:
            try:
                self.assertEqual(connection.recv(12), b"", "it has waited for the rest")
            except ConnectionResetError:
                pass
            connection.close()

    def test_mixed_load(self):
        seconds = float(os.environ.get("OUTRIDER_LOAD_SECONDS") or 5)
        found = serve_load.mixed_load(self.folder, seconds)
        self.assertLess(found["worst_mib"], MOST_MIB, found)


if __name__ == "__main__":
    main()
