"""Sweeps on a cluster of Dask: each chunk of `outrider sweep` is a task.

    python3 -m outrider.sweep --scheduler tcp://host:8786 scenario.yaml --runs 100000 --seed 7 --out out

What follows the address is that of `outrider sweep`; a folder of a sweep is continued. Workers need the tool and
the folder under the same names. Dask repeats the chunks of workers that it loses, and its dashboard shows them.
"""

from __future__ import annotations

import argparse
import importlib
import json
import os
import shutil
import subprocess
import sys
import time
from typing import Any


def _distributed() -> Any:
    """The module distributed, which has no types."""
    try:
        return importlib.import_module("distributed")
    except ImportError as missing:
        raise ImportError("outrider.sweep needs Dask; install the package python3-distributed, or "
                          "'pip install distributed'") from missing


def _answer(command: list[str], working_folder: str) -> dict[str, Any]:
    """The JSON object that the tool prints. What it refuses is a ValueError with its sentence."""
    done = subprocess.run([*command, "--json"], cwd=working_folder, capture_output=True, text=True, check=False)
    try:
        answer: dict[str, Any] = json.loads(done.stdout)
    except ValueError:
        raise RuntimeError(f"{command[0]} ended with status {done.returncode}: {done.stderr.strip()}") from None
    if done.returncode != 0:
        where = answer.get("where")
        raise ValueError(f"{where}: {answer['reason']}" if where else answer["reason"])
    return answer


def compute_chunk(tool: str, folder: str, working_folder: str, chunk: int) -> int:
    """Computes one chunk, with one thread. Waits for it if another process computes it: one that a lost worker has
    left behind, for instance."""
    command = [tool, "sweep", folder, "--chunks", str(chunk), "--threads", "1"]
    while _answer(command, working_folder)["reason"]:
        time.sleep(0.5)
    return chunk


def run_sweep(scheduler: str, words: list[str], tool: str = "outrider") -> dict[str, Any]:
    """Runs `outrider sweep WORDS` on a cluster and returns what it prints with --json in the end. Refusals are of
    the class ValueError."""
    dask = _distributed()
    here = os.getcwd()
    begun = _answer([tool, "sweep", *words, "--emit", "chunks"], here)
    folder = begun["files"]["folder"]
    with dask.Client(scheduler) as client:
        tasks = [client.submit(compute_chunk, tool, folder, here, chunk, pure=False) for chunk in begun["missing"]]
        for count, task in enumerate(dask.as_completed(tasks), 1):
            task.result()
            if sys.stderr.isatty():
                print(f"\r{count} of {len(tasks)} chunks", end="", file=sys.stderr)
    return _answer([tool, "sweep", folder, "--merge"], here)


def main(words: list[str]) -> int:
    """The command line. Returns the exit status: 0 done, 2 refused."""
    parser = argparse.ArgumentParser(prog="python3 -m outrider.sweep", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scheduler", required=True, metavar="ADDRESS", help="of Dask, such as tcp://host:8786")
    parser.add_argument("--tool", default=os.environ.get("OUTRIDER") or shutil.which("outrider") or "outrider",
                        metavar="FILE", help="the command outrider, on all workers [%(default)s]")
    arguments, rest = parser.parse_known_args(words)
    try:
        answer = run_sweep(arguments.scheduler, rest, arguments.tool)
    except (ValueError, RuntimeError, OSError, ImportError) as refusal:
        print(f"outrider: {refusal}", file=sys.stderr)
        return 2
    print(json.dumps(answer))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
