"""Runs of the tool on tiny worlds, with keys and flags at the ends of their ranges and beyond; tells what they do wrong."""
import dataclasses
import functools
import json
import math
import os
import pathlib
import random
import re
import resource
import select
import shlex
import shutil
import signal
import subprocess

from tool import FENCE, FLOOR, TOOL, wall, world

MOST_S, MOST_MIB, MOST_CHARACTERS = 10.0, 1024.0, 400
WALL_S = 600.0  # a run that neither works nor ends
HUGE = 100_000  # characters of a huge text

# Values as a scenario has them. No number is one of BEYOND; texts are anything.
BEYOND = [".nan", ".inf", "1e308", "-1e308", "9" * HUGE, "x" * HUGE, "[1, 2]", "{a: 1}", "text", "true", ""]
TEXTS = ['""', "x" * HUGE, '"0"', '"0,0,0"', '"nan,nan,nan"', '"1e308,-1e308,1e308"', '"a=0,0,0 b=1,1,1"', '"-1,1,0 1,1,0"',
         '"."', '"/dev/null"', "[1, 2]", "3", ""]
WORDS = ["", "0", "-1", "1", "3", "nan", "1e308", "-1e308", "9" * 1000, "x" * 5000, ".", "/dev/null", "a=1"]

FIELD = "type octile\nheight 7\nwidth 8\nmap\n........\n........\n...@....\n...@....\n...@....\n........\n........\n"
POLYGONS = "(0,0) (3,0) (3,2) (0,2)\n---\n(1.2,0.8) (1.8,0.8) (1.8,1.2) (1.2,1.2)\n---\n"
PURSUIT = ("N\n6,4\nC\n9\nR\n1,1\nT\n5,4\n5,3\n5,2\n4,2\n4,2\n4,2\n4,2\nM\n"
           "1,1,1,1\n1,9,1,1\n1,1,1,1\n1,5,5,1\n1,1,1,1\n1,1,1,1\n")
GRAPH = ("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 1.57\nVERTEX_SE2 2 1 1 3.14\nVERTEX_SE2 3 0 1 -1.57\n"
         + "".join(f"EDGE_SE2 {i} {(i + 1) % 4} 1.0{i} 0.02 1.55 400 0 0 400 0 400\n" for i in range(4)))
LANDMARKS = "".join("ODOMETRY 0.1 0.2 0.1\n" + "".join(
    f"SENSOR {post} {math.hypot(2 - 0.2 * step, post):.3f} {math.atan2(post, 2 - 0.2 * step):.4f}\n" for post in (1, 2, 3))
    for step in range(6))


def laser_log():
    """A robot in the middle of a square of 4 m that turns a little and drives on a little."""
    lines = []
    for step in range(8):
        x, heading = 0.1 * step, 0.1 * step
        ways = [heading + math.pi * (i / 60 - 0.5) for i in range(60)]
        ranges = [min((2 - x * math.copysign(1, math.cos(w))) / max(abs(math.cos(w)), 1e-9), 2 / max(abs(math.sin(w)), 1e-9))
                  for w in ways]
        pose = f"{x:.3f} 0 {heading:.3f}"
        lines.append(f"FLASER 60 {' '.join(f'{r:.2f}' for r in ranges)} {pose} {pose} {0.2 * step:.1f} host {0.2 * step:.1f}\n")
    return "".join(lines)


@dataclasses.dataclass
class Base:
    """A scenario that ends soon, and those sections of its job that matter in it; None: those of no other base."""
    job: str
    keys: dict
    sections: tuple = None


@dataclasses.dataclass
class Case:
    """A run of the tool: a base with other values of some keys, or the words of a command."""
    base: str
    values: dict
    words: tuple = ()

    def named(self):
        shown = [f"{key}={text[:20]}{'...' if len(text) > 20 else ''}" for key, text in self.values.items()]
        return f"{self.base} {' '.join(shown)}"


@dataclasses.dataclass
class Result:
    status: int
    processor_s: float
    memory_mib: float
    complaint: str  # "" of a run that did nothing wrong


@functools.cache
def schema(job):
    """{section: {key: what the schema says of it}}; keys at the top have the section ""."""
    told = json.loads(subprocess.run([TOOL, "schema", "--job", job], capture_output=True, text=True, check=True).stdout)
    found = {"": {}}
    for name, one in told["properties"].items():
        if one["type"] == "object":
            found[name] = one["properties"]
        elif name != "job":
            found[""][name] = one
    return found


@functools.cache
def catalogue():
    return json.loads(subprocess.run([TOOL, "list", "--json"], capture_output=True, text=True, check=True).stdout)


def write_worlds(folder):
    """Writes the files that the bases name."""
    rows = ["@" * 24] + ["@" + "." * 22 + "@"] * 9 + ["@" * 12 + "." * 11 + "@"] * 2 + ["@" + "." * 22 + "@"] * 4 + ["@" * 24]
    cells = b"".join(bytes(0 if cell == "@" else 254 for cell in row) for row in rows)
    (folder / "room.pgm").write_bytes(b"P5 24 %d 255\n" % len(rows) + cells)
    yard = world(FLOOR, *FENCE, wall("crate", 1, 1, 0.5, 0.5))
    history = "".join(f"{t},fox,{1.8 if t % 2 else -1.5},{1.9 if t % 2 else 1}\n" for t in range(0, 60, 5))
    for name, text in [
            ("room.yaml", "image: room.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"),
            ("yard.sdf", yard), ("fox.txt", "name=fox size=0.3,0.3,0.3 x=1.8 y=1.9\nname=hen size=0.3,0.3,0.3 x=-1.5 y=1\n"),
            ("history.csv", history), ("field.map", FIELD), ("polygons.txt", POLYGONS), ("pursuit.txt", PURSUIT),
            ("square.txt", "(0,0) (1,0) (1,1) (0,1)\n---\n"), ("graph.g2o", GRAPH), ("posts.dat", LANDMARKS), ("room.log", laser_log())]:
        (folder / name).write_text(text)


@functools.cache
def bases():
    guard = {"world": "yard.sdf", "targets": "fox.txt", "start": '"0,-2,90"',
             "plan": {"resolution": "0.2", "iterations": "50", "refinements": "0"}}
    drive = {"waypoints": '"0,0,0 0.2,0,0"', "tags": '"1=1,0.3,180 2=1,-0.3,180"', "sight": "modelled"}
    found = {
        "guard": Base("guard", guard),
        "guard arrivals": Base("guard", {**guard, "arrivals": {"count": "3", "rate": "0.5", "entrances": '"gate=-2,-2 gap=2,-2"'}}, ("arrivals",)),
        "guard wander": Base("guard", {**guard, "wander": {"speed": "0.3", "history": "history.csv"}}, ("wander",)),
        "guard supplies": Base("guard", {**guard, "supplies": {"tank": "2", "battery": "2", "stations": '"well=-2,-2,both"'}}, ("supplies",)),
        "guard scout": Base("guard", {**guard, "scout": {"unknown": "true"}, "laser": {"beams": "90"}}, ("scout", "laser", "wheels")),
        "guard physics": Base("guard", {**guard, "sim": "physics", "plan": {**guard["plan"], "shoot_on_the_move": "false"}}, ()),
        "guard robots": Base("guard", {**guard, "robots": "2"}, ()),
        "drive": Base("drive", drive),
        "drive rendered": Base("drive", {**drive, "sight": "rendered", "camera": {"rate": "2"}}, ("camera",)),
        "drive goal": Base("drive", {"goal": '"-1,0,0"', "tags": '"1=0,0.3,180 2=0,-0.3,180"', "sight": "modelled", "world": "yard.sdf",
                                     "planner": "theta_star", "start": '"-1.2,0,0"'}, ("route",)),
        "drive open": Base("drive", {**drive, "loop": "open"}, ("link",)),
        "explore": Base("explore", {"world": "room.yaml", "start": '"0.55,0.35,0"', "laser": {"beams": "60"}, "robot": {"speed": "1"}}),
        "explore yard": Base("explore", {"world": "yard.sdf", "start": '"0,-2,90"', "laser": {"most": "8"},
                                         "robot": {"speed": "1"}}, ("occupancy", "explore", "navigator", "live_map", "motion")),
        "cover": Base("cover", {"area": "square.txt", "width": "0.25", "order": {"iterations": "50"}}),
        "cover turning": Base("cover", {"area": "square.txt", "width": "0.1", "turning_radius": "0.05", "uncovered": "0.01"}, ("order",)),
        "cover bar": Base("cover", {"area": "square.txt", "width": "0.2", "uncovered": "0.3", "tool": {"shape": "bar", "width": "0.25"}}, ("tool",)),
        "slam laser": Base("slam", {"log": "room.log"}),
        "slam posts": Base("slam", {"log": "posts.dat"}, ("slam", "noise", "faults")),
        "slam graph": Base("slam", {"log": "graph.g2o"}, ("graph",)),
    }
    for row in catalogue()["path_planners"]:
        ground = {"map": "field.map", "from": '"1.5,1.5"', "to": '"6.5,1.5"'}
        if row["models"] == ["corners"]:
            ground["model"] = "corners"
        if not row["models"]:
            ground = {"map": "polygons.txt", "from": '"0.3,0.3"', "to": '"2.7,1.7"'}
        section = (row["name"],) if row["name"] in schema("plan") else ()
        found[f"plan {row['name']}"] = Base("plan", {**ground, "planner": row["name"]}, section)
    found["plan yard"] = Base("plan", {"map": "yard.sdf", "from": '"0,-2"', "to": '"2,2"', "resolution": "0.2"})
    for job, kind, keys in [("fleet", "fleet_planners", {"map": "field.map", "starts": '"0.5,0.5 7.5,0.5"', "goals": '"7.5,4.5 0.5,4.5"'}),
                            ("pursue", "pursuit_planners", {"map": "pursuit.txt"})]:
        found[job] = Base(job, keys)
        for row in catalogue()[kind]:
            section = (row["name"],) if row["name"] in schema(job) else ()
            found[f"{job} {row['name']}"] = Base(job, {**keys, "planner": row["name"]}, section)
    return found


@functools.cache
def sections_of(base):
    """The sections whose keys are tried with a base."""
    job, own = bases()[base].job, bases()[base].sections
    if own is not None:
        return own
    others = {name for one in bases().values() if one.job == job for name in one.sections or ()}
    return tuple(name for name in schema(job) if name not in others)


def inside(one, draws):
    """A value that the range of a number holds, of any size that it allows."""
    low, high = one["minimum"], one["maximum"]
    least = max(low, 1e-4 * (high - low) if low < 0 else min(1e-3, high))
    value = math.exp(draws.uniform(math.log(max(least, 1e-9)), math.log(max(high, 1e-9))))
    if low < 0 and draws.random() < 0.5:
        value = -value
    value = min(max(value, low), high)
    return str(round(value)) if one["type"] == "integer" else f"{value:.4g}"


def allowed(one, draws):
    """Values that the schema allows: of a number the ends of its range, 0 and some between."""
    if one["type"] == "boolean":
        return ["true", "false"]
    if one["type"] == "string":
        return [f'"{name}"' for name in one.get("enum", [])]
    low, high = one["minimum"], one["maximum"]
    found = {f"{low:.17g}", f"{high:.17g}", *(inside(one, draws) for _ in range(3))} | ({"0"} if low <= 0 <= high else set())
    return sorted(found)


def beyond(one):
    """Values that the schema does not allow, and texts of any kind."""
    if one["type"] == "string":
        return TEXTS
    if one["type"] == "boolean":
        return [text for text in BEYOND if text != "true"]
    low, high = one["minimum"], one["maximum"]
    if one["type"] == "integer":
        return [*BEYOND, str(round(low) - 1), str(round(high) + 1), "0.5"]
    return [*BEYOND, *(f"{math.nextafter(end, way):.17g}" for end, way in [(low, -math.inf), (high, math.inf)])]


def keys_of(base):
    job = bases()[base].job
    return {f"{section}.{key}".lstrip("."): one for section in sections_of(base) for key, one in schema(job)[section].items()}


def flags_of(command):
    """The flags of a command that are no keys of a scenario and take a value."""
    told = subprocess.run([TOOL, *command.split(), "--help"], capture_output=True, text=True, check=True).stdout
    keys = {"--" + f"{section}-{key}".lstrip("-").replace("_", "-")
            for job in catalogue()["jobs"] for section, inner in schema(job["name"]).items() for key in inner}
    return [flag for flag in re.findall(r"^  (?:-\w,)?(--[\w-]+) [A-Za-z]", told, re.MULTILINE) if flag not in keys]


# Commands that end soon whatever flag they are given, with words that they need.
COMMANDS = {"run": "run fleet.yaml", "fleet": "fleet --scenario fleet.yaml", "cover": "cover --scenario fleet.yaml", "plan": "plan field.map",
            "sweep": "sweep fleet.yaml --runs 2 --out swept", "convert": "convert posts.dat out.jsonl", "replay": "replay none",
            "detect": "detect room.pgm", "calibrate": "calibrate history.csv", "list": "list", "schema": "schema",
            "serve": "serve none", "completion": "completion bash", "bench path": "bench path none", "bench guard": "bench guard --yards 0"}


def single_cases(seed):
    """Every key of every base at every value, in an order that is drawn; what is allowed comes first."""
    draws = random.Random(seed)
    good = [Case(base, {key: text}) for base in bases() for key, one in keys_of(base).items() for text in allowed(one, draws)]
    bad = [Case(base, {key: text}) for base in bases() for key, one in keys_of(base).items() for text in beyond(one)]
    for command, words in COMMANDS.items():
        bad += [Case(command, {flag: text}, (*words.split(), f"{flag}={text}")) for flag in flags_of(command) for text in WORDS]
    draws.shuffle(good)
    draws.shuffle(bad)
    return good, bad


def pair_case(draws):
    """A base with two of its keys at values that their ranges allow."""
    while True:
        base = draws.choice(list(bases()))
        keys = {**keys_of(base), **{key: one for key, one in schema(bases()[base].job)[""].items()}}
        usable = {key: values for key, one in keys.items() if (values := allowed(one, draws))}
        if len(usable) > 1:
            return Case(base, {key: draws.choice(usable[key]) for key in draws.sample(sorted(usable), 2)})


def cases(runs, seed):
    """So many cases: half of them single keys, of which three quarters are allowed values, and pairs of keys."""
    good, bad = single_cases(seed)
    draws = random.Random(seed + 1)
    some_bad = bad[:max(runs // 8, runs // 2 - len(good))]
    singles = good[:runs // 2 - min(len(some_bad), runs // 8)] + some_bad
    return singles + [pair_case(draws) for _ in range(runs - len(singles))]


def text_of(case):
    """The scenario of a case."""
    base = bases()[case.base]
    top, inner = {"job": base.job}, {}
    for key, value in base.keys.items():
        if isinstance(value, dict):
            inner[key] = dict(value)
        else:
            top[key] = value
    for key, value in case.values.items():
        section, _, name = key.rpartition(".")
        (inner.setdefault(section, {}) if section else top)[name] = value
    lines = [f"{key}: {value}\n" for key, value in top.items()]
    for section, keys in inner.items():
        lines += [f"{section}:\n", *(f"  {key}: {value}\n" for key, value in keys.items())]
    return "".join(lines)


def limits(most_s):
    signal.signal(signal.SIGXCPU, signal.SIG_DFL)
    resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(most_s), math.ceil(most_s) + 1))
    resource.setrlimit(resource.RLIMIT_AS, (3 << 30, 3 << 30))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def judged(status, processor_s, memory_mib, output, errors, left, most_s):
    """Returns the error of a run; "" if there is none. `left` are the files that it wrote."""
    if processor_s >= most_s or status == -signal.SIGXCPU:
        return f"over {most_s:g} s of processor"
    if status < 0:
        return f"signal {signal.Signals(-status).name}"
    if memory_mib > MOST_MIB:
        return f"{memory_mib:.0f} MiB"
    lines = [line for line in errors.splitlines() if not line.startswith("outrider: warning: ")]
    if status not in (0, 1, 2, 3) or "this is a bug" in errors:
        return f"exit status {status}: {errors.strip()[:200]}"
    if (longest := max((len(line) for line in errors.splitlines()), default=0)) > MOST_CHARACTERS:
        return f"a sentence of {longest} characters"
    if status < 2:
        return "" if not lines or status == 1 else f"exit status 0, but {len(lines)} lines on standard error"
    if len(lines) != 1 or not lines[0].startswith("outrider: "):
        return f"{len(lines)} sentences: {errors.strip()[:200]}"
    return f"refused, but it wrote {left[0]}" if left else ""


def json_complaint(status, output, answer_wanted):
    if not answer_wanted:
        return ""

    def no_constant(name):
        raise ValueError(f"{name} is no JSON")

    try:
        answer = json.loads(output, parse_constant=no_constant)
    except ValueError as broken:
        return f"no JSON: {broken}"
    if (answer["status"] == "done") != (status == 0):
        return f"exit status {status} with status {answer['status']}"
    if len(answer["reason"]) > MOST_CHARACTERS:
        return f"a reason of {len(answer['reason'])} characters"
    return ""


def run(case, folder, most_s=MOST_S):
    """Runs a case in the folder with the worlds."""
    if case.words:
        words = list(case.words)
    else:
        (folder / "case.yaml").write_text(text_of(case))
        words = ["run", "case.yaml", "--json", "--threads", "1", "--out", "out"]
    before = set(folder.rglob("*"))
    with open(folder / "stdout", "w+b") as output, open(folder / "stderr", "w+b") as errors:
        process = subprocess.Popen([TOOL, *words], cwd=folder, stdout=output, stderr=errors, stdin=subprocess.DEVNULL,
                                   preexec_fn=lambda: limits(most_s))
        ended = os.pidfd_open(process.pid)
        if not select.select([ended], [], [], WALL_S)[0]:
            os.kill(process.pid, signal.SIGKILL)
        os.close(ended)
        _, code, used = os.wait4(process.pid, 0)
        status = process.returncode = os.waitstatus_to_exitcode(code)
        output.seek(0)
        errors.seek(0)
        out, err = output.read().decode(errors="replace"), errors.read().decode(errors="replace")
    for name in ("stdout", "stderr"):
        (folder / name).unlink()
    left = sorted(str(path.relative_to(folder)) for path in set(folder.rglob("*")) - before)
    shutil.rmtree(folder / "out", ignore_errors=True)
    processor_s, memory_mib = used.ru_utime + used.ru_stime, used.ru_maxrss / 1024
    complaint = judged(status, processor_s, memory_mib, out, err, left, most_s) or json_complaint(status, out, not case.words)
    return Result(status, processor_s, memory_mib, complaint)


def shortest(case, result, folder, most_s):
    """The key of a pair that does wrong alone, if one does."""
    for key, text in case.values.items() if len(case.values) > 1 else ():
        alone = Case(case.base, {key: text})
        if (found := run(alone, folder, most_s)).complaint:
            return alone, found
    return case, result


def command_of(case, folder, number):
    """The command that repeats a case; its scenario stays in the folder."""
    if case.words:
        return f"cd {folder} && outrider {shlex.join(case.words)[:200]}"
    path = folder / f"{number}.yaml"
    path.write_text(text_of(case))
    return f"outrider run {path}"
