"""Stops runs with Ctrl-C or SIGTERM at chosen moments, and checks what they leave behind."""
import dataclasses
import json
import os
import pathlib
import select
import signal
import subprocess
import tempfile
import time

from tool import SOURCE, TOOL

WITHIN_S = 1.0  # of processor time, by all threads: what a run may still work after a signal
MOST_S = 60.0  # whatever takes longer is killed


def scenarios():
    """Every published scenario."""
    return sorted((SOURCE / "scenarios").rglob("*.yaml"))


def scenario_jobs():
    """The scenarios that name a job, with it: the rest are maps and calibrations."""
    for path in scenarios():
        for line in path.read_text().splitlines():
            if line.startswith("job:"):
                yield path, line.split(":", 1)[1].split("#")[0].strip()


@dataclasses.dataclass
class Stopped:
    """A run that was sent a signal."""
    words: list
    moment_s: float
    status: int
    latency_s: float  # from the signal to the exit; 0 of a run that was done before
    worked_s: float  # of that, by the processors: what other programs take is not in it
    complaint: str  # what was wrong with it; "" if nothing
    deaf: bool  # it did not hear the signal and was ended without results


def more_runs():
    """Cases that no published scenario has: (name, words)."""
    yard = str(SOURCE / "scenarios/yard/yard.yaml")
    gallery = str(SOURCE / "scenarios/maps/gallery.map")
    unknown = str(SOURCE / "scenarios/explore/unknown_yard.yaml")
    return [("plan, every planner", ["plan", gallery, "--from", "1,1", "--to", "30,14", "--compare"]),
            ("guard, fine", ["run", yard, "--plan-resolution", "0.04"]),
            ("guard, two robots", ["run", yard, "--robots", "2"]),
            ("guard, proven", ["run", yard, "--plan-prove"]),
            ("guard, in physics", ["run", str(SOURCE / "scenarios/driveby/driveby.yaml"), "--sim", "physics",
                                   "--plan-shoot-on-the-move=false"]),
            ("guard, unknown and fine", ["run", unknown, "--plan-resolution", "0.04"]),
            ("explore, by tours", ["run", str(SOURCE / "scenarios/explore/office.yaml"), "--explore-strategy", "tour"]),
            ("slam, a log", ["run", str(SOURCE / "scenarios/slam/office.yaml")])]


def square(folder, side_m):
    """Writes a polygon map: a square room with pillars."""
    path = pathlib.Path(folder) / f"square{side_m}.txt"
    pillars = [(x, y) for x in range(5, side_m - 5, 10) for y in range(5, side_m - 5, 10)]
    path.write_text(f"(0,0) ({side_m},0) ({side_m},{side_m}) (0,{side_m})\n---\n" + "".join(
        f"({x},{y}) ({x + 2},{y + 1}) ({x + 1},{y + 3})\n" for x, y in pillars))
    return path


def open_map(folder, side, draws):
    """Writes a MovingAI map whose cells are blocked at random, but not at two corners."""
    path = pathlib.Path(folder) / "random.map"
    rows = ["".join("@" if draws.random() < 0.1 and 2 < x + y < 2 * side - 4 else "." for x in range(side))
            for y in range(side)]
    path.write_text(f"type octile\nheight {side}\nwidth {side}\nmap\n" + "\n".join(rows) + "\n")
    return path


def long_chase(folder, side, draws):
    """Writes a pursuit on dear and cheap ground: the target walks to and fro along the far side."""
    path = pathlib.Path(folder) / "chase.txt"
    ways = [f"{side - 2},{2 + second % (side - 4)}" for second in range(4 * side)]
    rows = [",".join(str(draws.randint(1, 40)) for _ in range(side)) for _ in range(side)]
    path.write_text("\n".join(["N", f"{side},{side}", "C", "50", "R", "2,2", "T", *ways, "M", *rows]) + "\n")
    return path


def many_robots(side, count, draws):
    """Starts and goals of robots on an open map of that side, as flags."""
    places = [f"{place % side}.5,{place // side}.5" for place in draws.sample(range(side * side), 2 * count)]
    return ["--starts", " ".join(places[:count]), "--goals", " ".join(places[count:])]


def planning_runs(folder, draws):
    """Each planner of each catalogue on something large, so that most of a run is planning: (name, words)."""
    catalogue = json.loads(subprocess.run([TOOL, "list", "--json"], capture_output=True, text=True, check=True).stdout)
    cells, field, chase = open_map(folder, 1500, draws), square(folder, 400), long_chase(folder, 600, draws)
    hall, robots = pathlib.Path(folder) / "hall.map", many_robots(300, 120, draws)
    hall.write_text("type octile\nheight 300\nwidth 300\nmap\n" + ("." * 300 + "\n") * 300)
    for row in catalogue["path_planners"]:
        polygons = row["models"] in ([], ["corners"])
        where = [str(field), "--from", "1,1", "--to", "399,399"] if polygons else \
                [str(cells), "--from", "0.5,0.5", "--to", "1499.5,1499.5"]
        radius = "0.01" if polygons else "0"
        yield f"plan by {row['name']}", ["plan", *where, "--planner", row["name"], "--radius", radius]
    for row in catalogue["cover_methods"]:
        yield f"cover by {row['name']}", ["cover", str(square(folder, 100)), "--method", row["name"], "--width", "0.2"]
    for row in catalogue["pursuit_planners"]:
        yield f"pursue by {row['name']}", ["pursue", str(chase), "--planner", row["name"]]
    for row in catalogue["fleet_planners"]:
        yield f"fleet by {row['name']}", ["fleet", str(hall), *robots, "--planner", row["name"]]
    yard = str(SOURCE / "scenarios/yard/yard.yaml")
    for row in catalogue["guard_planners"]:
        yield f"guard by {row['name']}", ["run", yard, "--plan-planner", row["name"], "--plan-resolution", "0.05"]


def complaint_of(status, output, errors, folder):
    if status not in (0, 1):
        return f"exit status {status}: {errors.strip()}"
    try:
        answer = json.loads(output)
    except json.JSONDecodeError:
        return f"no JSON on standard output: {output[:200]!r} {errors[:200]!r}"
    if answer["status"] not in ("done", "not_done", "cancelled"):
        return f"status {answer['status']}"
    if (status == 0) != (answer["status"] == "done"):
        return f"exit status {status} with status {answer['status']}"
    named = {pathlib.Path(path).name for path in answer.get("files", {}).values()}
    found = {path.name for path in folder.rglob("*") if path.is_file()}
    if found != named:
        return f"files {sorted(found)} where {sorted(named)} were named"
    for path in folder.rglob("*.json"):
        try:
            json.loads(path.read_text())
        except json.JSONDecodeError as broken:
            return f"{path.name} is not whole: {broken}"
    return ""


def processor_s(pid):
    """Returns the processor time of a process so far, to 10 ms."""
    try:
        fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return 0.0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def hold_back():
    """While a program is loaded nobody listens, and a signal would end it: it waits until somebody does."""
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT, signal.SIGTERM])


def stop_at(words, moment_s, number=signal.SIGINT):
    """Runs the tool in a folder of its own and sends it a signal after so long."""
    with tempfile.TemporaryDirectory(prefix="outrider-cancel-") as home:
        folder = pathlib.Path(home) / "out"
        folder.mkdir()
        with tempfile.TemporaryFile("w+") as output, tempfile.TemporaryFile("w+") as errors:
            process = subprocess.Popen([TOOL, *words, "--json", "--out", str(folder)], stdout=output, stderr=errors,
                                       stdin=subprocess.DEVNULL, preexec_fn=hold_back)
            ended = os.pidfd_open(process.pid)
            latency_s = before_s = 0.0
            if not select.select([ended], [], [], moment_s)[0]:
                before_s = processor_s(process.pid)
                sent_s = time.monotonic()
                os.kill(process.pid, number)  # send_signal() would take away what has just ended
                select.select([ended], [], [], MOST_S)
                latency_s = time.monotonic() - sent_s
            os.close(ended)
            os.kill(process.pid, signal.SIGKILL)  # of no effect on what has ended
            _, code, used = os.wait4(process.pid, 0)
            status = process.returncode = os.waitstatus_to_exitcode(code)
            worked_s = max(0.0, used.ru_utime + used.ru_stime - before_s) if latency_s > 0.0 else 0.0
            output.seek(0)
            errors.seek(0)
            answer = output.read()
            complaint = complaint_of(status, answer, errors.read(), folder)
    return Stopped(words, moment_s, status, latency_s, worked_s, complaint, "cannot be interrupted" in answer)


def usual_s(words, most_s=60.0):
    """How long the run takes when nobody stops it; at most `most_s`."""
    began_s = time.monotonic()
    process = subprocess.Popen([TOOL, *words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               stdin=subprocess.DEVNULL)
    try:
        process.wait(most_s)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
    return time.monotonic() - began_s
