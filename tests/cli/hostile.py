"""Makes hostile files of small valid ones, gives each to the verb that reads it, and judges how it ended.

It has to end by itself with a status of 0 to 3, with one sentence of at most 400 characters where it refuses, and within
10 s of processor time and 1 GiB of memory. The kernel measures both; other work on the machine does not count.
"""
import os
import random
import re
import resource
import select
import struct
import subprocess

from tool import TOOL

MOST_S, MOST_KIB, MOST_CHARACTERS = 10, 1 << 20, 400
CUTS = 50
NUMBERS = [b"0", b"-1", b"1e308", b"-1e308", b"1e-320", b"nan", b"inf", b"4294967295", b"4294967296", b"18446744073709551616", b"", b"x",
           b"0x10", b"9" * 100_000]
LENGTHS = {4: [0, 0xFFFFFFFF, 0x7FFFFFFF, 0x80000000], 8: [0, (1 << 64) - 1, (1 << 63) - 1, 1 << 63]}


def cuts(data):
    for i in range(CUTS):
        yield f"cut {i}/{CUTS}", data[:len(data) * i // CUTS]


def flips(data, rng, count):
    for i in range(count):
        flipped = bytearray(data)
        places = [rng.randrange(len(data) * 8) for _ in range(1 if i % 3 else 8)]
        for place in places:
            flipped[place // 8] ^= 1 << place % 8
        yield f"flip {places}", bytes(flipped)


def lengths(data, rng, count):
    """Each field of 4 or 8 bytes, in either order, that may be a length made 0, the largest, and negative."""
    found = []
    for size, values in LENGTHS.items():
        for order in "<>":
            letter = order + {4: "I", 8: "Q"}[size]
            found += [(at, letter, value) for at in range(len(data) - size + 1)
                      if 0 < struct.unpack_from(letter, data, at)[0] <= 2 * len(data) for value in values]
    for at, letter, value in rng.sample(found, min(count, len(found))):
        yield f"length {letter}{value:x} at {at}", data[:at] + struct.pack(letter, value) + data[at + struct.calcsize(letter):]


def numbers(data, rng, count):
    """A number of a text replaced by a strange one."""
    found = [(each.span(), value) for each in re.finditer(rb"[-+]?\d+(\.\d+)?([eE][-+]?\d+)?", data) for value in NUMBERS]
    for (begin, end), value in rng.sample(found, min(count, len(found))):
        yield f"number at {begin}: {value[:20].decode()}", data[:begin] + value + data[end:]


def lines(data, rng, count):
    """Lines left out, given twice, a thousand times, very long, and in another order."""
    rows = data.splitlines(keepends=True)
    for _ in range(count):
        at, other = rng.randrange(len(rows)), rng.randrange(len(rows))
        kind = rng.choice(["without", "twice", "often", "long", "other order"])
        new = {"without": [], "twice": [rows[at]] * 2, "often": [rows[at]] * 1000, "long": [rows[at].rstrip(b"\n") * 2000 + b"\n"],
               "other order": [rows[other], rows[at]]}[kind]
        yield f"line {at} {kind} ({other})", b"".join(rows[:at] + new + rows[at + 1:])


def variants(seed, rng, share=1.0):
    """Some hostile variants of a valid file: (label, content)."""
    count = max(1, round(30 * share))
    made = [*cuts(seed.content)] if share >= 1 else rng.sample([*cuts(seed.content)], max(1, round(CUTS * share)))
    made += flips(seed.content, rng, count)
    if seed.binary:
        made += lengths(seed.content, rng, 2 * count)
    else:
        made += numbers(seed.content, rng, count)
        made += lines(seed.content, rng, count // 2 + 1)
    return made


class Ended:
    """How a run of the tool ended, and what is wrong with that."""

    def __init__(self, status, usage, output):
        self.status, self.output = status, output
        self.processor_s, self.memory_kib = usage.ru_utime + usage.ru_stime, usage.ru_maxrss
        self.wrong = ", ".join(self.complaints())

    def complaints(self):
        if os.WIFSIGNALED(self.status):
            yield f"signal {os.WTERMSIG(self.status)} after {self.processor_s:.1f} s of processor"
            return
        code = os.WEXITSTATUS(self.status)
        if code not in (0, 1, 2, 3):
            yield f"status {code}"
        if self.processor_s > MOST_S:
            yield f"{self.processor_s:.1f} s of processor"
        if self.memory_kib > MOST_KIB:
            yield f"{self.memory_kib >> 10} MiB"
        rows = self.output.splitlines()
        if any(len(row) > MOST_CHARACTERS for row in rows):
            yield f"a sentence of {max(map(len, rows))} characters"
        said = [row for row in rows if not row.startswith("outrider: warning: ")]
        if code >= 2 and len(said) != 1:
            yield f"{len(said)} sentences"
        if "this is a bug" in self.output:
            yield "it says that this is a bug"


def run(words, folder, patience_s=600):
    """Runs the tool with limits, and waits for it; it is killed when it does nothing for very long."""
    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (MOST_S + 1, MOST_S + 2))
        resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30))
        resource.setrlimit(resource.RLIMIT_FSIZE, (2 << 30, 2 << 30))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    errors = folder / "stderr.txt"
    with open(errors, "wb") as stderr:
        process = subprocess.Popen([TOOL, *words], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=stderr,
                                   preexec_fn=limit)
        ended = os.pidfd_open(process.pid)
        if not select.select([ended], [], [], patience_s)[0]:
            process.kill()
        os.close(ended)
        _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return Ended(status, usage, errors.read_text(errors="replace"))


def try_file(folder, file, content, words):
    """Gives a hostile file to the tool. The valid one is put back if there was one."""
    path = folder / file
    before = path.read_bytes() if path.exists() else None
    path.write_bytes(content)
    try:
        return run(words, folder)
    finally:
        if before is None:
            path.unlink(missing_ok=True)
        else:
            path.write_bytes(before)


def generator(seed, name):
    return random.Random(f"{seed} {name}")
