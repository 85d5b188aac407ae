"""run.py BUILD OUT [NAME...]: runs the benchmarks in BUILD, and writes OUT/NAME.json for each: what was run, on which machine,
at which commit, and what it measured. The docs site draws the folder. $OUTRIDER_DATA adds those on published data.

The programs are those of bench/ (Google Benchmark, or text) and `outrider bench`, whose suites run short here.
"""

import datetime
import json
import os
import pathlib
import platform
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
SUITES = {  # arguments of `outrider bench`; {data} needs published data
    "guard": "guard --seeds 1",
    "guard_teams": "guard --seeds 3 --robots 2 --data {data}/guard",
    "drive": "drive --seeds 2",
    "cover": "cover --seeds 1",
    "explore": "explore --seeds 1",
    "path": "path --data {data}/grids --queries 20 --maps arena,den312d,lak303d",
    "pursuit_maps": "pursuit --data {data}/pursuit --maps map3 --limit 10",
    "slam": "slam --data {data}/slam/posegraph",
}


def machine() -> dict[str, object]:
    models = [line.split(":", 1)[1].strip() for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines()
              if line.startswith("model name")]
    return {"processor": models[0] if models else platform.processor(), "cores": os.cpu_count(),
            "system": platform.freedesktop_os_release().get("PRETTY_NAME", platform.system()), "load": os.getloadavg()[0]}


def commit() -> str:
    described = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=ROOT, capture_output=True, text=True,
                               check=False)
    return described.stdout.strip() or "unknown"


def flags_of(command: list[str]) -> list[str]:
    """$BENCH_FLAGS, for programs of Google Benchmark."""
    program = ROOT / command[0]
    google = program.is_file() and any(mark in program.read_bytes() for mark in (b"libbenchmark.so", b"benchmark_out"))
    return ["--benchmark_out_format=json", *os.environ.get("BENCH_FLAGS", "").split()] if google else []


def plans(build: pathlib.Path) -> dict[str, list[str]]:
    """The commands by name, as one types them in the root of the sources."""
    shown = os.path.relpath(build, ROOT)
    commands = {one.name.removeprefix("bench_"): [f"{shown}/bench/{one.name}"]
                for one in sorted((build / "bench").glob("bench_*")) if one.is_file()}
    if "peers" in commands:
        commands["peers"].append("--json")
    if (build / "bench/call_bench").exists():
        commands["networkx"] = ["/usr/bin/python3", "bench/networkx_peer.py", "--json"]
        commands["python"] = ["/usr/bin/python3", "bench/python_calls.py", f"{shown}/bench/call_bench"]
    commands["page"] = ["node", "web/tests/run.mjs", "tests/browser/bench.mjs"]
    data = os.environ.get("OUTRIDER_DATA")
    for name, arguments in SUITES.items():
        if "{data}" not in arguments or data:
            commands[f"suite_{name}"] = [f"{shown}/outrider", "bench", *arguments.format(data=data).split(), "--json"]
    return commands


def measure(command: list[str], build: pathlib.Path) -> tuple[int, dict[str, object]]:
    """Runs a command, shows what it prints, and returns its status and what it measured."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder, "out.json")
        flags = flags_of(command)
        given = [*command, *flags, f"--benchmark_out={out}"] if flags else command
        environment = os.environ | {"PYTHONPATH": str(build / "python"), "OUTRIDER": str(build / "outrider"),
                                    "OUTRIDER_SOURCE": str(ROOT)}
        done = subprocess.run(given, cwd=ROOT, env=environment, stdout=subprocess.PIPE, text=True, check=False)
        if out.exists():
            keep = ("name", "real_time", "cpu_time", "time_unit", "iterations", "label")
            rows = [{key: row[key] for key in keep if key in row} for row in json.loads(out.read_text())["benchmarks"]
                    if "real_time" in row]
            print(done.stdout, end="")
            return done.returncode, {"benchmarks": rows}
        if "--json" in command:
            return done.returncode, {"rows": json.loads(done.stdout)["rows"]} if done.stdout else {}
        print(done.stdout, end="")
        return done.returncode, {"lines": done.stdout.splitlines()}


def main() -> int:
    build, out = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    out.mkdir(parents=True, exist_ok=True)
    failed = []
    for name, command in plans(build).items():
        if sys.argv[3:] and name not in sys.argv[3:]:
            continue
        told = " ".join([*command, *flags_of(command)[1:]]).replace(os.environ.get("OUTRIDER_DATA") or "\0", "$OUTRIDER_DATA")
        print(f"== {told}", flush=True)
        where, begin = machine(), time.monotonic()
        status, measured = measure(command, build)
        if status == 77:  # it needs what is not installed
            continue
        if status not in (0, 1 if name.startswith("suite_") else 0):  # a suite says with 1 that not every run was done
            failed.append(name)
        if not any(measured.values()):
            continue
        result = {"name": name, "command": told, "machine": where, "commit": commit(),
                  "date": datetime.date.today().isoformat(), "seconds": round(time.monotonic() - begin, 1)} | measured
        (out / f"{name}.json").write_text(json.dumps(result, indent=1) + "\n")
    if failed:
        print(f"failed: {', '.join(failed)}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
