"""Stands between `outrider serve` and a mission, or a process that reads files for it, which a test holds.

    held_mission.py HOLDS TOOL run SCENARIO WORD...
    held_mission.py HOLDS TOOL serve-reader

If the folder HOLDS has a pipe for the scenario, named as it is with "+" for "/", nothing of what the mission tells comes
through, and the mission soon waits: it does so while the descriptor of its log is full (docs/server.md). Each line that
the test writes into the pipe lets more through, {"time": 1.5, "step": 3}: messages up to a time of the mission, and
progress up to a step; of what a line does not name all comes through. When the server ends the mission, by SIGTERM, the
rest comes through. A reader with a pipe of its name waits for a line. Without a pipe this becomes the tool.
"""
import ctypes
import fcntl
import json
import math
import os
import select
import signal
import struct
import sys
import zlib

MAGIC_BYTES, MESSAGE, CHUNK, MESSAGE_INDEX = 8, 5, 6, 7


def records(data):
    """Splits MCAP records: their opcodes and bytes, and the bytes that are left."""
    found, at = [], 0
    while len(data) >= at + 9 and len(data) >= (end := at + 9 + struct.unpack_from("<Q", data, at + 1)[0]):
        found.append((data[at], data[at:end]))
        at = end
    return found, data[at:]


def chunk_of(parts):
    """Returns the chunk of some records, which have times."""
    body = b"".join(part for _, part in parts)
    times = [time for time, _ in parts]
    content = struct.pack("<QQQIIQ", min(times), max(times), len(body), zlib.crc32(body), 0, len(body)) + body
    return struct.pack("<BQ", CHUNK, len(content)) + content


class Log:
    """The log on its way through: its messages up to a time."""

    def __init__(self):
        self.left, self.waiting, self.begun = b"", [], False

    def add(self, data, most):
        self.left += data
        if self.begun and most == math.inf:
            return
        if not self.begun and len(self.left) >= MAGIC_BYTES:
            self.waiting.append((0, self.left[:MAGIC_BYTES], False))
            self.left, self.begun = self.left[MAGIC_BYTES:], True
        if not self.begun:
            return
        found, self.left = records(self.left)
        for opcode, record in found:
            if opcode == CHUNK:
                compression = struct.unpack_from("<I", record, 9 + 28)[0]
                time = struct.unpack_from("<Q", record, 9)[0]
                for inner, part in records(record[9 + 32 + compression + 8:])[0]:
                    if inner == MESSAGE:
                        time = struct.unpack_from("<Q", part, 9 + 6)[0]
                    self.waiting.append((time, part, True))
            elif opcode != MESSAGE_INDEX:  # which is of a chunk as it was
                self.waiting.append((0, record, False))

    def taken(self, most):
        """Takes what may pass."""
        if most == math.inf and not self.waiting:  # what comes now need not be looked at
            out, self.left = self.left, b""
            return out
        count = next((i for i, (time, _, _) in enumerate(self.waiting) if 1e-9 * time > most), len(self.waiting))
        passes, self.waiting = self.waiting[:count], self.waiting[count:]
        out, parts = b"", []
        for time, part, of_chunk in passes:
            if of_chunk:
                parts.append((time, part))
                continue
            out += (chunk_of(parts) if parts else b"") + part
            parts = []
        return out + (chunk_of(parts) if parts else b"")


class Lines:
    """The progress on its way through: its lines up to a step."""

    def __init__(self):
        self.left, self.waiting = b"", []

    def add(self, data, _):
        *lines, self.left = (self.left + data).split(b"\n")
        self.waiting += lines

    def taken(self, most):
        count = next((i for i, line in enumerate(self.waiting) if json.loads(line)["step"] > most), len(self.waiting))
        passes, self.waiting = self.waiting[:count], self.waiting[count:]
        return b"".join(line + b"\n" for line in passes)


def write(descriptor, data):
    while data:
        data = data[os.write(descriptor, data):]


def start(tool, words, streams):
    """Starts the mission: its process, and for each descriptor to which it tells something the end to read from."""
    pipes = {descriptor: os.pipe() for descriptor in streams}
    child = os.fork()
    if child == 0:
        ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG: it ends as this does
        for descriptor, (_, end) in pipes.items():
            fcntl.fcntl(end, fcntl.F_SETPIPE_SZ, 4096)
            os.dup2(end, descriptor)
        os.execv(tool, [tool, *words])
    for _, end in pipes.values():
        os.close(end)
    return child, {ours: descriptor for descriptor, (ours, _) in pipes.items()}


def main():
    holds, tool, *words = sys.argv[1:]
    pipe = os.path.join(holds, words[words[0] == "run"].replace("/", "+"))
    held = os.path.exists(pipe)
    commands = os.open(pipe, os.O_RDWR | os.O_CLOEXEC) if held else None
    if held and words[0] != "run":
        os.read(commands, 4096)
    if not held or words[0] != "run":
        os.execv(tool, [tool, *words])
    woken, wakes = os.pipe2(os.O_CLOEXEC | os.O_NONBLOCK)
    signal.set_wakeup_fd(wakes)
    signal.signal(signal.SIGTERM, lambda *_: None)
    most = {"time": -1.0, "step": 0.0}
    streams = {int(os.environ["OUTRIDER_LIVE"]): ("time", Log()), int(os.environ["OUTRIDER_PROGRESS"]): ("step", Lines())}
    child, sources = start(tool, words, streams)
    ended = set()
    while ended != set(sources) or any(stream.waiting for _, stream in streams.values()):
        hungry = [source for source, descriptor in sources.items() if source not in ended and not streams[descriptor][1].waiting]
        for ready in select.select([commands, woken, *hungry], [], [])[0]:
            if ready == woken:
                most = dict.fromkeys(most, math.inf)
                os.read(woken, 64)
            elif ready == commands:
                for line in os.read(commands, 4096).splitlines():
                    asked = json.loads(line)
                    most = {name: asked.get(name, math.inf) for name in most}
            elif data := os.read(ready, 65536):
                name, stream = streams[sources[ready]]
                stream.add(data, most[name])
            else:
                ended.add(ready)
        for descriptor, (name, stream) in streams.items():
            if passes := stream.taken(most[name]):
                write(descriptor, passes)
    sys.exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) & 0xff)


if __name__ == "__main__":
    main()
