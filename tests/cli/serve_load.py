"""Strangers and clumsy programs visit `outrider serve`, as functions; each returns what it saw.

Run as a program it mixes all of them for so many seconds and tells the memory that the server took:
    OUTRIDER=build/outrider OUTRIDER_SOURCE=. python3 tests/cli/serve_load.py 600
"""
import base64
import gzip
import json
import pathlib
import random
import socket
import sys
import tempfile
import threading
import time

from server_client import Server, WebSocket
from tool import FLOOR, until, world

MIB = 1 << 20
ROOM = {"grid": {"resolution_m": 1, "width": 40, "height": 30, "runs": [0, 600, 1, 5, 0, 595]}}
CYLINDER = ("<model name='c{i}'><static>true</static><pose>{x} {y} 0.5 0 0 0</pose><link name='l'><collision name='c'>"
            "<geometry><cylinder><radius>0.1</radius><length>1</length></cylinder></geometry></collision></link></model>")


def memory_mib(server):
    """Returns the memory of the server itself, without the processes that it started."""
    status = pathlib.Path(f"/proc/{server.process.pid}/status").read_text()
    return int(status.split("VmRSS:")[1].split()[0]) / 1024


def settled_memory_mib(server, most):
    """The same once memory that nobody uses was given back."""
    return until(f"memory of at most {most} MiB", lambda: (now := memory_mib(server)) <= most and now)


def version_time_s(server):
    begin = time.monotonic()
    server.json("GET", "/api/v1/version")
    return time.monotonic() - begin


def stalled_readers(server, path, count):
    """Connections that ask for a large file and read nothing of it."""
    connections = []
    for _ in range(count):
        connection = socket.socket()
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        connection.connect(("127.0.0.1", server.port))
        connection.sendall(f"GET /api/v1/files/{path} HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n".encode())
        connections.append(connection)
    return connections


def half_requests(server, count):
    """Connections that never say all of what they want."""
    connections = []
    for i in range(count):
        connection = server.connect()
        connection.sendall(b"GET /api/v1/version HTTP/1.1\r\nHost: 127" if i % 2 else
                           b"POST /api/v1/plan HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 1000\r\n\r\n{")
        connections.append(connection)
    return connections


def packed_maps(server, count, mib=100):
    """Small gzip files that are large once they are unpacked; the statuses."""
    bomb = gzip.compress(b"type octile\nheight 1\nwidth 1\nmap\n" + b"." * (mib * MIB))
    return together(count, lambda: server.request("POST", "/api/v1/maps?name=a.map.gz", bomb)[0])


def crowded_world(count):
    """Little text, many models."""
    return world(FLOOR, *(CYLINDER.format(i=i, x=0.5 * (i % 50), y=0.5 * (i // 50)) for i in range(count)))


def many_values(server, count):
    """JSON that is small as text and large as values."""
    body = b'{"grid":[' + b"0," * 1_900_000 + b"0]}"
    return together(count, lambda: server.request("POST", "/api/v1/maps", body, Content_Type="application/json")[0])


def together(count, act):
    results = []
    threads = [threading.Thread(target=lambda: results.append(act())) for _ in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return results


def ordinary_use(server, rng):
    """Plans as a page does."""
    map_id = server.json("POST", "/api/v1/maps", ROOM)["id"]
    for _ in range(5):
        ask = {"map": map_id, "start": [1, 1], "goal": [rng.randrange(2, 38) + 0.5, 28.5], "radius_m": 0,
               "planner": rng.choice(["a_star", "jps", "theta_star"])}
        assert server.json("POST", "/api/v1/plan", ask)["status"] == "done"
    server.json("GET", "/api/v1/files")
    server.json("GET", "/api/v1/catalogue")
    with WebSocket(server) as viewer:
        viewer.send({"type": "plan", "id": 1, "request": {"map": map_id, "start": [1, 1], "goal": [30, 20], "radius_m": 0}})
        while viewer.receive()["type"] != "plan":
            pass


def patient(act):
    """Until it is answered: what is refused for a while (429, 503) is asked again."""
    def answer():
        try:
            return [act()]
        except (AssertionError, ConnectionError, OSError):
            return []

    return until("an answer", answer)[0]


def mixed_load(folder, seconds):
    """All of it at random. The largest memory after an attack, and the longest wait for /version, in MiB and s."""
    rng = random.Random(7)
    (folder / "large.json").write_bytes(b"x" * (60 * MIB))
    (folder / "crowd.sdf").write_text(crowded_world(150))
    attacks = {
        "stalled readers": lambda server: stalled_readers(server, "large.json", 20),
        "half requests": lambda server: half_requests(server, 320),
        "packed maps": lambda server: packed_maps(server, 4) and [],
        "many values": lambda server: many_values(server, 4) and [],
        "a crowded world": lambda server: server.request("POST", "/api/v1/maps", {"path": "crowd.sdf"}) and [],
    }
    worst_mib, slowest_s, counts = 0.0, 0.0, dict.fromkeys(attacks, 0)
    with Server(folder) as server:
        end = time.monotonic() + seconds
        requests = 0
        while time.monotonic() < end:
            name = rng.choice(list(attacks))
            connections = attacks[name](server)
            counts[name] += 1
            slowest_s = max(slowest_s, patient(lambda: version_time_s(server)))
            for _ in range(20):
                patient(lambda: ordinary_use(server, rng))
                requests += 9
            for connection in connections:
                connection.close()
            worst_mib = max(worst_mib, settled_memory_mib(server, 300))
        return {"requests": requests, "attacks": counts, "worst_mib": round(worst_mib), "slowest_s": round(slowest_s, 3)}


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as home:
        found = mixed_load(pathlib.Path(home), float(sys.argv[1]))
    print(json.dumps(found))
    sys.exit(0 if found["worst_mib"] < 300 and found["slowest_s"] < 5 else 1)
