"""Published laser logs, and logs made of them in which something went wrong."""

import gzip
import math


def compose(a, b):
    c, s = math.cos(a[2]), math.sin(a[2])
    return (a[0] + c * b[0] - s * b[1], a[1] + s * b[0] + c * b[1], a[2] + b[2])


def relative(a, b):
    c, s = math.cos(a[2]), math.sin(a[2])
    dx, dy = b[0] - a[0], b[1] - a[1]
    return (c * dx + s * dy, -s * dx + c * dy, math.remainder(b[2] - a[2], 2 * math.pi))


class Step:
    """A scan, its pose on the published map, and the motion since the scan before by odometry."""

    def __init__(self, ranges, pose, motion, time):
        self.ranges, self.pose, self.motion, self.time = ranges, pose, motion, time

    def moved(self, pose=None, motion=None):
        return Step(self.ranges, self.pose if pose is None else pose, self.motion if motion is None else motion, self.time)


def read(path):
    steps, odometry = [], None
    with gzip.open(path, "rt") as lines:
        for line in lines:
            words = line.split()
            if words and words[0] == "ODOM":
                odometry = tuple(map(float, words[1:4]))
            if not words or words[0] != "FLASER":
                continue
            n = int(words[1])
            pose = tuple(map(float, words[n + 2:n + 5]))
            motion = relative(steps[-1].pose, odometry) if steps and odometry else (0.0, 0.0, 0.0)
            steps.append(Step(words[1:n + 2], pose, motion, words[n + 8]))
            odometry = None
    return steps


def text(steps):
    """The log as GMapping writes it: the pose of the map in FLASER, and ODOM lines that start from there."""
    lines, before = [], None
    for step in steps:
        odometry = compose(before, step.motion) if before else step.pose
        lines.append("ODOM {:.9g} {:.9g} {:.9g} 0 0 0 0 host 0".format(*odometry))
        pose = "{:.9g} {:.9g} {:.9g}".format(*step.pose)
        lines.append(f"FLASER {' '.join(step.ranges)} {pose} {pose} {step.time} host {step.time}")
        lines.append(f"ODOM {pose} 0 0 0 0 host 0")
        before = step.pose
    return "\n".join(lines) + "\n"


def without(steps, first, count):
    """Somebody carried the robot: scans are missing, and odometry counted nothing meanwhile."""
    return steps[:first] + steps[first + count:]


def turned_once(steps, at, angle=math.pi / 2):
    """Odometry counts a turn that did not happen."""
    x, y, heading = steps[at].motion
    return steps[:at] + [steps[at].moved(motion=(x, y, heading + angle))] + steps[at + 1:]


def not_counted(steps, first, count):
    """The scans are missing while the robot turned or drove, and odometry says that it stood."""
    after = steps[first + count]
    return steps[:first] + [after.moved(motion=(0.0, 0.0, 0.0))] + steps[first + count + 1:]


def driven_after(steps, first, way_m):
    """The first step by which the robot has driven so far since `first`."""
    at, way = first, 0.0
    while way < way_m:
        at += 1
        way += math.hypot(*steps[at].motion[:2])
    return at


def repeated(steps, first, last):
    """The way from `first` to `last` comes twice, as if a second corridor like it followed."""
    ends = steps[first].pose, steps[last].pose
    back = relative(ends[0], (0.0, 0.0, 0.0))
    shift = compose(ends[1], back)  # what takes the first pose to the last one
    again = [step.moved(pose=compose(shift, step.pose)) for step in steps[first + 1:]]
    return steps[:last + 1] + again
