"""Explores buildings of equal rooms with wheels three times as bad as usual: `make loops RUNS=200`.

Equal rooms are what false loops are made of: a robot that is a little lost takes one for the other. Prints the largest
errors of each building. Fails if a run that says `done` ends where it does not believe to be, or with a wrong map.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

TOOL = os.environ["OUTRIDER"]
CELL = 0.05
WALL = 0.2
CORNER = 2.0  # width of the corridor along the left side
BAD_WHEELS = ["--wheels-scale-error", "0.03", "--wheels-noise", "0.01", "--slam-odometry-distance", "0.05",
              "--slam-odometry-turn", "0.05", "--slam-odometry-turn-per-distance", "6"]
MOST_POSE_ERROR, MOST_MAP_ERROR = 0.3, 0.15  # m

# name: rooms along the corridor, their width and depth, width of the corridor, floors
BUILDINGS = {"six": (6, 4.0, 4.0, 2.0, 1), "small": (4, 3.0, 3.0, 1.5, 2), "long": (7, 4.0, 3.5, 2.0, 2),
             "wide": (5, 6.0, 5.0, 2.5, 1), "narrow": (8, 2.5, 3.0, 1.5, 1)}


class Plan:
    """A grid of cells, all wall at first."""

    def __init__(self, width, height):
        self.columns, self.rows = round(width / CELL), round(height / CELL)
        self.cells = [bytearray(self.columns) for _ in range(self.rows)]

    def clear(self, x, y, width, height):
        for row in range(round(y / CELL), round((y + height) / CELL)):
            first, end = round(x / CELL), round((x + width) / CELL)
            self.cells[row][first:end] = b"\xfe" * (end - first)

    def write(self, path):
        path.with_suffix(".pgm").write_bytes(
            b"P5 %d %d 255\n" % (self.columns, self.rows) + b"".join(reversed(self.cells)))
        path.with_suffix(".yaml").write_text(
            f"image: {path.stem}.pgm\nresolution: {CELL}\norigin: [0, 0, 0]\nnegate: 0\n"
            "occupied_thresh: 0.65\nfree_thresh: 0.196\n")


def write_building(path, rooms, width, depth, corridor, floors):
    """Writes a building of equal rooms on both sides of parallel corridors, joined on the left. Returns a start."""
    storey = 2 * (depth + WALL) + corridor + WALL
    plan = Plan(CORNER + rooms * (width + WALL) + 2 * WALL, floors * storey + WALL)
    plan.clear(WALL, WALL, CORNER, floors * storey - WALL)
    for floor in range(floors):
        low = WALL + floor * storey
        middle = low + depth + WALL
        plan.clear(WALL, middle, CORNER + rooms * (width + WALL), corridor)
        for room in range(rooms):
            left = 2 * WALL + CORNER + room * (width + WALL)
            for y, door in ((low, middle - WALL), (middle + corridor + WALL, middle + corridor)):
                plan.clear(left, y, width, depth)
                plan.clear(left + 0.5 * width - 0.5, door, 1.0, WALL)
    plan.write(path)
    return f"1,{0.5 * floors * storey:g},90"


def explore(world, start, seed):
    command = [TOOL, "explore", str(world.with_suffix(".yaml")), "--start=" + start, "--seed", str(seed), "--json"]
    answer = json.loads(subprocess.run(command + BAD_WHEELS, capture_output=True, text=True, check=False).stdout)
    return answer["status"], answer["reason"], answer["metrics"]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=200)
    given = parser.parse_args()
    wrong = []
    print(f"{'building':10} {'runs':>5} {'done':>5} {'loops':>6} {'pose error m':>13} {'map error m':>12}   (largest)")
    with tempfile.TemporaryDirectory() as folder:
        for number, (name, shape) in enumerate(BUILDINGS.items()):
            world = pathlib.Path(folder, name)
            start = write_building(world, *shape)
            done = loops = runs = 0
            pose_error = map_error = 0.0
            for seed in range(1 + number, 1 + given.runs, len(BUILDINGS)):
                status, reason, metrics = explore(world, start, seed)
                runs += 1
                done += status == "done"
                loops += int(metrics["loops"])
                pose_error = max(pose_error, metrics["pose_error_m"])
                map_error = max(map_error, metrics["map_error_m"])
                is_right = metrics["pose_error_m"] <= MOST_POSE_ERROR and metrics["map_error_m"] <= MOST_MAP_ERROR
                if status == "done" and not is_right:
                    wrong.append(f"{name}, seed {seed}: done, but the pose is off by {metrics['pose_error_m']:.2f} m "
                                 f"and the map by {metrics['map_error_m']:.2f} m")
                if status != "done":
                    print(f"{name}, seed {seed}: {status}: {reason}")
            print(f"{name:10} {runs:5} {done:5} {loops:6} {pose_error:13.3f} {map_error:12.3f}", flush=True)
    for line in wrong:
        print(line)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
