"""A small HTTP and WebSocket client on bare sockets, which can also do what no browser would."""
import atexit
import base64
import functools
import hashlib
import json
import os
import pathlib
import re
import shutil
import socket
import struct
import subprocess
import sys
import tempfile

from tool import PATIENCE_S, SOURCE, TOOL, until

HELD_MISSION = SOURCE / "tests/support/held_mission.py"


@functools.cache
def own_copy():
    """A copy of the tool in a folder for temporary files."""
    home = tempfile.mkdtemp(prefix="outrider-tool-")
    atexit.register(shutil.rmtree, home)
    return shutil.copy(TOOL, home)


class Server:
    """`outrider serve` on a port of its own, ended with the block. A test can hold its missions."""

    def __init__(self, folder, *words, port=0, **variables):
        self.home = tempfile.TemporaryDirectory(prefix="outrider-held-")
        tool = pathlib.Path(self.home.name) / "outrider"
        tool.hardlink_to(own_copy())
        self.process = subprocess.Popen([tool, "serve", str(folder), "--port", str(port), *words],
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL,
                                        text=True, env=os.environ | variables)
        first = self.process.stdout.readline()
        found = re.search(r"http://([^:/\]]+|\[.*\]):(\d+)/", first)
        if not found:
            raise AssertionError(first + self.process.stderr.read())
        self.port = int(found[2])
        # From now on each program that it starts comes by this.
        between = tool.with_name("between")
        between.write_text(f'#!/bin/sh\nexec {sys.executable} -ESB {HELD_MISSION} {self.home.name} {TOOL} "$@"\n')
        between.chmod(0o700)
        between.rename(tool)

    def hold(self, scenario="unsaved"):
        """From now on missions of this scenario, or "serve-reader", wait for pass_on()."""
        if not self._hold(scenario).exists():
            os.mkfifo(self._hold(scenario))

    def pass_on(self, scenario="unsaved", **most):
        """Lets a mission that is held go on up to a `time` or a `step`, or to its end."""
        pipe = os.open(self._hold(scenario), os.O_WRONLY)  # waits until the mission has begun
        os.write(pipe, json.dumps(most).encode() + b"\n")
        os.close(pipe)

    def _hold(self, scenario):
        return pathlib.Path(self.home.name) / scenario.replace("/", "+")

    def __enter__(self):
        return self

    def __exit__(self, *unused):
        self.end()

    def end(self, kill=False):
        if self.process.poll() is None:
            self.process.kill() if kill else self.process.terminate()
        status = self.process.wait()
        self.process.stdout.close()
        self.process.stderr.close()
        self.home.cleanup()
        return status

    def connect(self):
        return socket.create_connection(("127.0.0.1", self.port), timeout=PATIENCE_S)

    def raw(self, data):
        """Everything that is answered to these bytes."""
        with self.connect() as connection:
            try:
                connection.sendall(data)
            except OSError:
                pass  # it had enough
            chunks = []
            try:
                while chunk := connection.recv(65536):
                    chunks.append(chunk)
            except ConnectionResetError:
                pass
            return b"".join(chunks)

    def request(self, method, path, body=None, **headers):
        """(status, headers, body) of one request; an object is sent as JSON, and a header of None is left out."""
        data = b""
        if body is not None:
            data = body if isinstance(body, bytes) else body.encode() if isinstance(body, str) else json.dumps(body).encode()
        lines = {"Host": f"127.0.0.1:{self.port}"}
        if isinstance(body, (dict, list)):
            lines["Content-Type"] = "application/json"
        if body is not None:
            lines["Content-Length"] = str(len(data))
        lines.update({name.replace("_", "-"): value for name, value in headers.items()})
        head = f"{method} {path} HTTP/1.1\r\n" + "".join(
            f"{name}: {value}\r\n" for name, value in lines.items() if value is not None)
        answer = self.raw(head.encode() + b"\r\n" + data)
        top, _, rest = answer.partition(b"\r\n\r\n")
        if not top:
            return 0, {}, b""
        first, *others = top.decode().split("\r\n")
        return int(first.split()[1]), {k.lower(): v for k, v in (line.split(": ", 1) for line in others)}, rest

    def json(self, method, path, body=None, status=200, **headers):
        got, _, text = self.request(method, path, body, **headers)
        if got != status:
            raise AssertionError(f"{method} {path}: {got} instead of {status}: {text[:500]}")
        return json.loads(text)

    def wait(self, run):
        """The run, once it has ended."""
        def ended():
            state = self.json("GET", f"/api/v1/runs/{run}")
            return state["state"] not in ("queued", "running") and state

        return until(f"the end of run {run}", ended)


class WebSocket:
    """One end of /api/v1/live, or of another place; `log` gathers the binary messages that receive() passes."""

    def __init__(self, server, query="", hello=True, path="/api/v1/live", **headers):
        self.connection = server.connect()
        self.buffer = b""
        self.log = b""
        self.head = ""
        key = base64.b64encode(os.urandom(16)).decode()
        lines = {"Host": f"127.0.0.1:{server.port}", "Upgrade": "websocket", "Connection": "Upgrade",
                 "Sec-WebSocket-Key": key, "Sec-WebSocket-Version": "13"}
        lines.update({name.replace("_", "-"): value for name, value in headers.items()})
        head = f"GET {path}{query} HTTP/1.1\r\n" + "".join(f"{k}: {v}\r\n" for k, v in lines.items())
        self.connection.sendall(head.encode() + b"\r\n")
        answer = self.head = self._until(b"\r\n\r\n").decode()
        self.status = int(answer.split()[1])
        if self.status != 101:
            self.close()
            return
        wanted = base64.b64encode(hashlib.sha1((key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11").encode()).digest())
        assert wanted.decode() in answer, answer
        if hello:
            assert self.receive()["type"] == "hello"

    def __enter__(self):
        return self

    def __exit__(self, *unused):
        self.close()

    def close(self):
        self.connection.close()

    def _more(self):
        chunk = self.connection.recv(65536)
        if not chunk:
            raise ConnectionError("the server closed the connection")
        self.buffer += chunk

    def _until(self, mark):
        while mark not in self.buffer:
            self._more()
        found, _, self.buffer = self.buffer.partition(mark)
        return found

    def _take(self, count):
        while len(self.buffer) < count:
            self._more()
        taken, self.buffer = self.buffer[:count], self.buffer[count:]
        return taken

    def frame(self, opcode, data, last=True, length=None):
        size = len(data) if length is None else length
        head = bytes([(0x80 if last else 0) | opcode])
        if size < 126:
            head += bytes([0x80 | size])
        elif size < 65536:
            head += bytes([0xfe]) + struct.pack(">H", size)
        else:
            head += bytes([0xff]) + struct.pack(">Q", size)
        mask = b"\x05\x06\x07\x08"
        masked = bytes(byte ^ mask[i % 4] for i, byte in enumerate(data))
        self.connection.sendall(head + mask + masked)

    def send(self, message):
        self.frame(1, json.dumps(message).encode())

    def next(self):
        """(opcode, data) of the next message: 1 text, 2 binary."""
        while True:
            first, second = self._take(2)
            size = second & 0x7f
            if size == 126:
                size = struct.unpack(">H", self._take(2))[0]
            elif size == 127:
                size = struct.unpack(">Q", self._take(8))[0]
            data = self._take(size)
            if first & 0x0f == 8:
                raise ConnectionError("the server ended the connection")
            if first & 0x0f in (1, 2):
                return first & 0x0f, data
            if first & 0x0f == 9:
                self.frame(10, data)

    def receive(self):
        """The next message that is text."""
        while True:
            opcode, data = self.next()
            if opcode == 1:
                return json.loads(data)
            self.log += data

    def until(self, kind):
        """All messages up to the first of this type."""
        messages = []
        while not messages or messages[-1]["type"] != kind:
            messages.append(self.receive())
        return messages
