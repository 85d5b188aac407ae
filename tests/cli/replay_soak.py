"""Flies and drives random guard missions again, by code of its own: `make replays MISSIONS=1000`.

Each mission is in a random yard of boxes, with random targets and one of several settings. From its log: every ball is
flown again in steps of a millisecond (with a robot that drives, and in air), and must touch first what the log says;
it must leave from the gun of the robot; the robot keeps its limits and stays clear of the boxes, and robots of each
other; a target that is called reached was hit; the run is `done` only if all are reached or have no shot; and no
mission takes less than its bound. Prints counts by setting. Fails with one line for each thing that is wrong.
"""
import argparse
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from mcap_log import McapLog, xyz

TOOL = os.environ["OUTRIDER"]
SIZES = {1: (0.5, 0.205, 0.372), 2: (0.46, 0.36, 0.178), 3: (0.51, 0.1372, 0.526), 4: (0.2576, 0.164, 0.3712)}
RADIUS, SPEED, TURN_RATE = 0.26, 0.8, 0.8  # of the robot: m, m/s, rad/s
BALL, GUN_LENGTH, GRAVITY = 0.01, 0.27, 9.8
SETTINGS = {"still": [], "from rest": ["--plan-shoot-on-the-move=false"], "two robots": ["--robots", "2"],
            "air": ["--air-drag", "0.02", "--air-wind", "1.5", "--air-wind-towards", "40"],
            "tank": ["--supplies-tank", "3", "--supplies-stations", "well=0,0,water"],
            "large errors": ["--errors-position", "0.15", "--errors-gun", "0.02", "--errors-timing", "0.04"]}
COARSE = ["--plan-resolution", "0.2", "--plan-iterations", "100", "--plan-stops", "100", "--plan-refinements", "0"]


class Box:
    """An upright box: centre of its base, size, heading."""

    def __init__(self, name, base, size, yaw):
        self.name, self.base, self.size, self.yaw = name, np.array(base), np.array(size), yaw
        self.axes = np.array([[math.cos(yaw), math.sin(yaw)], [-math.sin(yaw), math.cos(yaw)]])

    def distance(self, points):
        """Returns the distances of points, one a row, from the box; 0 inside."""
        beside = np.abs((points[:, :2] - self.base[:2]) @ self.axes.T) - self.size[:2] / 2
        above = np.abs(points[:, 2] - self.base[2] - self.size[2] / 2) - self.size[2] / 2
        return np.linalg.norm(np.maximum(np.column_stack([beside, above]), 0.0), axis=1)

    def sdf(self):
        x, y, z = self.base
        return (f"<model name='{self.name}'><static>1</static><pose>{x} {y} {z + self.size[2] / 2} 0 0 {self.yaw}</pose>"
                "<link name='l'><collision name='c'><geometry><box><size>" + " ".join(map(str, self.size))
                + "</size></box></geometry></collision></link></model>\n")


def random_yard(rng):
    """The boxes and the targets of a yard of 10 to 14 m, with room around the start and the middle."""
    half = rng.uniform(5.0, 7.0)
    boxes = [Box(f"wall_{i}", (x * half, y * half, 0.0), (2 * half if y else 0.1, 2 * half if x else 0.1, 1.0), 0.0)
             for i, (x, y) in enumerate([(1, 0), (-1, 0), (0, 1), (0, -1)])]

    def is_free(x, y, room):
        return (math.hypot(x, y) > room + 0.6 and math.hypot(x, y + half - 0.8) > room + 0.6
                and all(box.distance(np.array([[x, y, 0.1]]))[0] > room for box in boxes))

    def free_place(room):
        for _ in range(200):
            x, y = rng.uniform(-half + 0.5, half - 0.5), rng.uniform(-half + 0.5, half - 0.5)
            if is_free(x, y, room):
                return x, y
        return None

    for i in range(rng.randrange(3, 12)):
        place = free_place(1.2)
        if place:
            boxes.append(Box(f"box_{i}", (*place, 0.0), [rng.uniform(0.2, 1.4), rng.uniform(0.2, 1.4),
                                                          rng.uniform(0.2, 2.0)], rng.uniform(-math.pi, math.pi)))
    targets = []
    for i in range(rng.randrange(3, 9)):
        place, kind = free_place(0.35), rng.randrange(1, 5)
        if place:
            targets.append(Box(f"cat_{i}", (*place, 0.0), SIZES[kind], rng.uniform(-math.pi, math.pi)))
    return half, boxes, targets


def write_yard(folder, half, boxes, targets):
    plane = ("<model name='floor'><static>1</static><link name='l'><collision name='c'><geometry><plane><normal>0 0 1"
             "</normal><size>20 20</size></plane></geometry></collision></link></model>\n")
    (folder / "yard.sdf").write_text("<sdf version='1.7'><world name='yard'><gravity>0 0 -9.8</gravity>\n" + plane
                                     + "".join(box.sdf() for box in boxes) + "</world></sdf>\n")
    (folder / "cats.txt").write_text("".join(
        f"name={t.name} size={t.size[0]},{t.size[1]},{t.size[2]} x={t.base[0]!r} y={t.base[1]!r} rz={t.yaw!r}\n"
        for t in targets))
    return ["--world", folder / "yard.sdf", "--targets", folder / "cats.txt", "--start", f"0,{-half + 0.8},90"]


def flight_of(shot, drag, wind):
    """The ball's places every millisecond and at its end, by the fourth-order method of Runge and Kutta."""
    def rate(state):
        through = state[3:] - wind
        return np.concatenate([state[3:], [0, 0, -GRAVITY] - drag * np.linalg.norm(through) * through])

    state = np.array(xyz(shot.muzzle) + xyz(shot.velocity))
    steps = max(1, math.ceil(shot.flight / 1e-3))
    h = shot.flight / steps
    places = [state[:3]]
    for _ in range(steps):
        a = rate(state)
        b = rate(state + 0.5 * h * a)
        c = rate(state + 0.5 * h * b)
        d = rate(state + h * c)
        state = state + h / 6 * (a + 2 * b + 2 * c + d)
        places.append(state[:3])
    return np.array(places)


def check_shot(shot, boxes, targets, drag, wind):
    """Yields the errors of a shot, in words."""
    places = flight_of(shot, drag, wind)
    target = next(t for t in targets if t.name == shot.target)
    gaps = {box.name: box.distance(places) - BALL for box in [*boxes, target]}
    gaps["floor"] = places[:, 2] - BALL
    touched = shot.target if shot.hit else shot.contact
    for name, gap in gaps.items():
        if gap[:-1].min() < -2e-3 and name != touched or gap[:-2].min() < -0.02:
            yield f"the ball at {shot.target} touches {name} before its end"
    if touched in gaps and abs(gaps[touched][-1]) > 1e-3:
        yield f"the ball at {shot.target} ends {gaps[touched][-1]:.4f} m from {touched}"
    if shot.hit and shot.contact != shot.target:
        yield f"the ball hits {shot.target} and touches {shot.contact}"
    if math.dist(xyz(shot.muzzle)[:2], (shot.robot.x, shot.robot.y)) > GUN_LENGTH:
        yield f"the ball at {shot.target} leaves beside the robot"


def check_track(track, boxes):
    """Yields the errors of the way of a robot: rows of time, x, y and heading."""
    for box in boxes:
        if box.distance(np.column_stack([track[:, 1:3], np.full(len(track), 0.05)])).min() < RADIUS - 2e-3:
            yield f"a robot touches {box.name}"
    steps = np.diff(track, axis=0)
    steps = steps[steps[:, 0] > 1e-6]
    if (np.hypot(steps[:, 1], steps[:, 2]) > SPEED * steps[:, 0] * 1.001 + 1e-6).any():
        yield "a robot is faster than its limit"
    turn = np.abs((steps[:, 3] + math.pi) % (2 * math.pi) - math.pi)
    if (turn > TURN_RATE * steps[:, 0] * 1.001 + 0.05).any():  # the heading has an error after each drive
        yield "a robot turns faster than its limit"


def tracks_of(log):
    for topic in ["/pose", "/robot_2/pose"]:
        rows = [(time, p.pose.position.x, p.pose.position.y,
                 2 * math.atan2(p.pose.orientation.z, p.pose.orientation.w)) for time, p in log.read(topic)]
        if rows:
            yield np.array(rows)


def check_apart(tracks):
    if len(tracks) < 2:
        return
    times = np.arange(0.0, max(track[-1, 0] for track in tracks), 0.02)
    one, other = ([np.interp(times, track[:, 0], track[:, k]) for k in (1, 2)] for track in tracks)
    if np.hypot(one[0] - other[0], one[1] - other[1]).min() < 2 * RADIUS - 5e-3:
        yield "two robots touch"


def check_report(answer, log):
    metrics = answer["metrics"]
    hit = {shot.target for _, shot in log.read("/shots") if shot.hit}
    reached = {name for name, state in last_status(log).items() if state == "reached"}
    if reached - hit:
        yield f"called reached and never hit: {sorted(reached - hit)}"
    if len(reached) != metrics["reached"]:
        yield f"{metrics['reached']} reached, and {len(reached)} in the log"
    if (answer["status"] == "done") != (metrics["reached"] + metrics["unreachable"] == metrics["targets"]):
        yield f"status {answer['status']} with {metrics['reached']} of {metrics['targets']}"
    # The bound is of drives that end where they should; errors of the drives may save a little.
    if metrics["reached"] + metrics["unreachable"] == metrics["targets"] and \
            metrics["mission_s"] < metrics["lower_bound_s"] - 0.5:
        yield f"takes {metrics['mission_s']:.2f} s, less than its bound of {metrics['lower_bound_s']:.2f} s"


def last_status(log):
    return {target.name: target.status for _, target in log.read("/targets")}


def mission(number):
    """The setting, the counts and what is wrong with a mission."""
    rng = random.Random(number)
    name = list(SETTINGS)[number % len(SETTINGS)]
    half, boxes, targets = random_yard(rng)
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        command = [TOOL, "guard", *write_yard(folder, half, boxes, targets), *COARSE, *SETTINGS[name], "--seed",
                   str(number), "--threads", "1", "--json", "--out", folder / "out"]
        done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=600)
        if done.returncode not in (0, 1):
            return name, {"refused": 1}, [] if done.returncode == 2 else [f"ends with {done.returncode}: {done.stderr}"]
        answer = json.loads(done.stdout)
        log = McapLog((folder / "out" / "run.mcap").read_bytes())
        shots = [shot for _, shot in log.read("/shots")]
        tracks = list(tracks_of(log))
        drag = 0.02 if name == "air" else 0.0
        wind = 1.5 * np.array([math.cos(math.radians(40)), math.sin(math.radians(40)), 0.0]) if drag else np.zeros(3)
        wrong = [w for shot in shots for w in check_shot(shot, boxes, targets, drag, wind)]
        wrong += [w for track in tracks for w in check_track(track, boxes)]
        wrong += [*check_apart(tracks), *check_report(answer, log)]
        moving = sum(1 for shot in shots if shot.platform_velocity.x or shot.platform_velocity.y)
        return name, {"missions": 1, "done": answer["status"] == "done", "shots": len(shots), "passing": moving,
                      "hits": sum(shot.hit for shot in shots)}, wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--missions", type=int, default=1000)
    parser.add_argument("--first", type=int, default=0)
    given = parser.parse_args()
    counts = {name: dict.fromkeys(["missions", "done", "refused", "shots", "passing", "hits"], 0) for name in SETTINGS}
    wrong = []
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        numbers = range(given.first, given.first + given.missions)
        for number, (name, counted, faults) in zip(numbers, pool.map(mission, numbers)):
            for key, value in counted.items():
                counts[name][key] += int(value)
            for fault in faults:
                wrong.append(f"mission {number} ({name}): {fault}")
                print(wrong[-1], flush=True)
    columns = list(next(iter(counts.values())))
    print(f"{'setting':14}" + "".join(f"{column:>10}" for column in columns))
    for name, row in counts.items():
        print(f"{name:14}" + "".join(f"{row[column]:10}" for column in columns))
    print(f"{len(wrong)} faults")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
