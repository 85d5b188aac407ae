"""Makes recorded logs of an exploration that Outrider has simulated, with the truth in them.

    outrider run scenarios/explore/office.yaml --out out
    outrider convert out out/run.jsonl
    python3 scenarios/slam/record.py out/run.jsonl scenarios/slam

The robot drives the way of the log. From there its sensors are cast anew against the true walls:
  office.log.gz              a laser of 8 m over 180 degrees (CARMEN), off by 1 cm; the poses of FLASER are true
  posts.dat, posts_world.dat 16 posts seen within 3 m (Freiburg), off by 5 cm and 1 degree
Its wheels count 2 % too little and drift to the left. Same log, same bytes.
"""
import gzip
import json
import math
import pathlib
import random
import sys

BEAMS, REACH, NOTHING = 120, 8.0, 32.0
POSTS, SIGHT = 16, 3.0


def edges_of(walls):
    return [(a, b) for wall in walls for a, b in zip(wall, wall[1:] + wall[:1])]


def cast(edges, x, y, angle, most):
    """How far it is to the first edge, at most `most`."""
    dx, dy = math.cos(angle), math.sin(angle)
    for (ax, ay), (bx, by) in edges:
        ex, ey = bx - ax, by - ay
        slant = dx * ey - dy * ex
        if abs(slant) < 1e-12:
            continue
        share = ((ax - x) * dy - (ay - y) * dx) / slant
        away = ((ax - x) * ey - (ay - y) * ex) / slant
        if 0.0 <= share <= 1.0 and 0.0 <= away < most:
            most = away
    return most


def seen_from(frame, pose):
    (fx, fy, fh), (x, y, h) = frame, pose
    c, s = math.cos(fh), math.sin(fh)
    return (c * (x - fx) + s * (y - fy), c * (y - fy) - s * (x - fx), math.remainder(h - fh, 2 * math.pi))


def placed_in(frame, pose):
    (fx, fy, fh), (x, y, h) = frame, pose
    c, s = math.cos(fh), math.sin(fh)
    return (fx + c * x - s * y, fy + s * x + c * y, fh + h)


def counted(motion, chance):
    """What the wheels say of a motion."""
    x, y, turn = motion
    way = math.hypot(x, y)
    scale = 0.98 + chance.gauss(0.0, 0.02)
    drift = 0.012 * way + chance.gauss(0.0, 0.02) * math.sqrt(way) + chance.gauss(0.0, 0.02) * turn
    return (scale * x, scale * y, turn + drift)


def laser_log(rows, edges, chance):
    lines, before = [], None
    for time, *pose in rows:
        x, y, heading = pose
        if before is not None:
            odometry = placed_in(before, counted(seen_from(before, pose), chance))
            lines.append("ODOM {:.4f} {:.4f} {:.5f} 0 0 0".format(*odometry))
        ranges = []
        for i in range(BEAMS):
            away = cast(edges, x, y, heading - math.pi / 2 + i * math.pi / BEAMS, REACH)
            ranges.append("32" if away >= REACH else f"{max(0.03, away + chance.gauss(0.0, 0.01)):.2f}")
        place = f"{x:.4f} {y:.4f} {heading:.5f}"
        lines.append(f"FLASER {BEAMS} {' '.join(ranges)} {place} {place} {time:.2f} simulated {time:.2f}")
        before = pose
    return "# made by record.py\n" + "\n".join(lines) + "\n"


def posts_of(rows, edges, chance):
    """Places beside the way, some decimetres off every wall."""
    posts = []
    while len(posts) < POSTS:
        _, x, y, _ = chance.choice(rows)
        angle, away = chance.uniform(0.0, 2 * math.pi), chance.uniform(0.4, 1.2)
        free = cast(edges, x, y, angle, 2.0) > away + 0.2
        post = (x + away * math.cos(angle), y + away * math.sin(angle))
        if free and all(math.dist(post, other) > 0.8 for other in posts):
            posts.append(post)
    return posts


def landmark_log(rows, edges, posts, chance):
    lines = []
    for (_, *before), (_, *pose) in zip(rows, rows[1:]):
        x, y, turn = counted(seen_from(before, pose), chance)
        first = math.atan2(y, x) if math.hypot(x, y) > 1e-6 else 0.0
        lines.append(f"ODOMETRY {first:.5f} {math.hypot(x, y):.4f} {turn - first:.5f}")
        for number, (px, py) in enumerate(posts, 1):
            away, angle = math.dist(pose[:2], (px, py)), math.atan2(py - pose[1], px - pose[0])
            if away < SIGHT and cast(edges, pose[0], pose[1], angle, away) >= away:
                bearing = math.remainder(angle - pose[2] + chance.gauss(0.0, math.radians(1.0)), 2 * math.pi)
                lines.append(f"SENSOR {number} {max(0.05, away + chance.gauss(0.0, 0.05)):.3f} {bearing:.4f}")
    return "\n".join(lines) + "\n"


def read(path):
    """The outlines of the walls, and the rows (time, x, y, heading) of the way, to the micrometre."""
    walls, rows = [], []
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            logged = json.loads(line)
            if logged["topic"] == "/walls":
                walls = [[(point["x"], point["y"]) for point in wall["points"]] for wall in logged["message"]["outlines"]]
            elif logged["topic"] == "/pose":
                place, turn = (logged["message"]["pose"][part] for part in ("position", "orientation"))
                heading = 2 * math.atan2(turn["z"], turn["w"])
                before = rows[-1][3] if rows else 0.0
                heading = before + math.remainder(heading - before, 2 * math.pi)  # without a jump
                rows.append([round(value, 6) for value in (logged["time_ns"] / 1e9, place["x"], place["y"], heading)])
    return walls, rows


def main(log, folder):
    walls, rows = read(log)
    edges = edges_of(walls)
    folder = pathlib.Path(folder)
    scans = laser_log(rows, edges, random.Random(1)).encode()
    (folder / "office.log.gz").write_bytes(gzip.compress(scans, 9, mtime=0))
    steps = rows[::3]
    chance = random.Random(2)
    posts = posts_of(steps, edges, chance)
    (folder / "posts.dat").write_text(landmark_log(steps, edges, posts, chance))
    (folder / "posts_world.dat").write_text("".join(f"{n} {x:.3f} {y:.3f}\n" for n, (x, y) in enumerate(posts, 1)))


if __name__ == "__main__":
    main(*sys.argv[1:])
