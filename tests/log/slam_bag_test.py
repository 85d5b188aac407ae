"""`outrider slam` and `outrider convert` on bags that rosbag itself writes."""

import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import genpy
import rosbag
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Image, LaserScan
from tf2_msgs.msg import TFMessage

TOOL = os.environ["OUTRIDER"]
START_S = 1600000000
BIG_MB = int(os.environ.get("OUTRIDER_BAG_MB", "100"))
MOST_MEMORY_MB = 200
MEASURE = """
import os, sys
process = os.posix_spawn(sys.argv[1], sys.argv[1:], os.environ, file_actions=[(os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0)])
_, status, usage = os.wait4(process, 0)
print(os.waitstatus_to_exitcode(status), usage.ru_maxrss, usage.ru_utime)
"""
SANITIZED = b"__asan_init" in pathlib.Path(TOOL).read_bytes()  # the address sanitizer holds on to freed memory


def quaternion(message, heading):
    message.z, message.w = math.sin(heading / 2), math.cos(heading / 2)


def scan(x, y, heading, stamp, beams=200):
    """In a room of 8 m by 5 m."""
    step = 4.0 / beams
    message = LaserScan(angle_min=-2.0, angle_max=2.0 - step, angle_increment=step, range_min=0.1, range_max=30.0)
    message.header.frame_id = "laser"
    message.header.stamp = stamp
    for beam in range(beams):
        angle = heading - 2.0 + step * beam + 1e-9  # no beam along a wall
        dx, dy = math.cos(angle), math.sin(angle)
        message.ranges.append(min((8 - x if dx > 0 else -x) / dx, (5 - y if dy > 0 else -y) / dy))
    return message


def odometry(x, y, heading, stamp):
    message = Odometry(child_frame_id="base_link")
    message.header.frame_id = "odom"
    message.header.stamp = stamp
    message.pose.pose.position.x, message.pose.pose.position.y = x, y
    quaternion(message.pose.pose.orientation, heading)
    return message


def transform(parent, child, x, y, heading, stamp):
    message = TransformStamped(child_frame_id=child)
    message.header.frame_id = parent
    message.header.stamp = stamp
    message.transform.translation.x, message.transform.translation.y = x, y
    quaternion(message.transform.rotation, heading)
    return TFMessage(transforms=[message])


def write(path, compression="none", steps=60, with_odometry=True, scans=("/scan",), back_at=None):
    with rosbag.Bag(path, "w", compression=compression, chunk_threshold=20000) as bag:
        x, y, heading = 2.0, 2.0, 0.0
        bag.write("/tf_static", transform("base_link", "laser", 0, 0, 0, genpy.Time(START_S)), genpy.Time(START_S))
        for step in range(steps):
            time = genpy.Time.from_sec(START_S + 0.25 * step)
            stamp = genpy.Time.from_sec(START_S + 0.25 * (0 if step == back_at else step))
            if with_odometry:
                bag.write("/odom", odometry(x, y, heading, time), time)
            bag.write("/tf", transform("odom", "base_link", x, y, heading, time), time)
            for topic in scans:
                bag.write(topic, scan(x, y, heading, stamp), time)
            x, y, heading = x + 0.1 * math.cos(heading), y + 0.1 * math.sin(heading), heading + 0.15  # stays in the room


def write_big(path, size_mb, with_cameras):
    """A robot goes round and round in the room, slowly. Its laser has 1000 beams, with intensities, at 40 Hz; two
    cameras may look on."""
    turn = 1000
    scans = []
    picture = Image(height=480, width=640, encoding="mono8", step=640, data=os.urandom(640 * 480))
    with rosbag.Bag(path, "w") as bag:
        bag.write("/tf_static", transform("base_link", "laser", 0, 0, 0, genpy.Time(START_S)), genpy.Time(START_S))
        step = 0
        while bag.size < size_mb * 1e6:
            time = genpy.Time.from_sec(START_S + 0.025 * step)
            heading = 2 * math.pi * (step % turn) / turn
            x, y = 4 + 2 * math.sin(heading), 2.5 - 2 * math.cos(heading)
            if step < turn:
                scans.append(scan(x, y, heading, time, beams=1000))
                scans[step].intensities = [1.0] * len(scans[step].ranges)
            scans[step % turn].header.stamp = time
            bag.write("/odom", odometry(x, y, heading, time), time)
            bag.write("/scan", scans[step % turn], time)
            for camera in ("/left/image", "/right/image") if with_cameras else ():
                bag.write(camera, picture, time)
            step += 1
    return step


class SlamBagTest(unittest.TestCase):
    def setUp(self):
        home = tempfile.TemporaryDirectory(prefix="outrider-bag-")
        self.addCleanup(home.cleanup)
        self.folder = pathlib.Path(home.name)

    def run_tool(self, *args):
        return subprocess.run([TOOL, *map(str, args)], cwd=self.folder, capture_output=True, text=True, timeout=300,
                              stdin=subprocess.DEVNULL)

    def map_of(self, log, *flags):
        done = self.run_tool("slam", log, *flags, "--out", "out", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return (self.folder / "out" / "map.pgm").read_bytes(), json.loads(done.stdout)

    def refusal(self, *args):
        """The one sentence on standard error; nothing else happens."""
        done = self.run_tool(*args)
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        return done.stderr

    def test_every_compression_gives_the_same_map(self):
        maps = []
        for compression in ("none", "bz2", "lz4"):
            write(self.folder / "run.bag", compression)
            maps.append(self.map_of("run.bag")[0])
        self.assertEqual(maps, maps[:1] * 3)
        self.assertGreater(maps[0].count(b"\x00"), 200, "the walls")
        done = self.run_tool("convert", "run.bag", "run.mcap")
        self.assertEqual((done.returncode, done.stdout), (0, "181 messages to run.mcap\n"), done.stderr)
        self.assertEqual(self.map_of("run.mcap")[0], maps[0])
        # A log that was converted is not converted further.
        self.assertEqual(self.run_tool("convert", "run.mcap", "again.mcap").returncode, 0)
        self.assertEqual((self.folder / "again.mcap").read_bytes(), (self.folder / "run.mcap").read_bytes())

    def mapping_memory(self, size_mb, with_cameras):
        """The memory that it takes to map a bag of this size, MB."""
        steps = write_big(self.folder / "big.bag", size_mb, with_cameras)
        # The memory of a process counts from that of its parent, so its parent is a small one.
        measured = subprocess.run([sys.executable, "-c", MEASURE, TOOL, "slam", "big.bag", "--out", "out"],
                                  cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True, text=True)
        status, memory_kb, time_s = measured.stdout.split()[-3:]
        self.assertEqual(status, "0", measured.stderr)
        result = json.loads((self.folder / "out/run.json").read_text())
        self.assertEqual(result["metrics"]["steps"], steps)
        memory_mb = int(memory_kb) / 1000
        print(f"{size_mb:.0f} MB, {steps} scans, cameras: {with_cameras}: {memory_mb:.0f} MB of memory, "
              f"{float(time_s):.0f} s")
        return memory_mb

    def test_memory_does_not_grow_with_the_pictures(self):
        """A bag of OUTRIDER_BAG_MB that is full of pictures is mapped in 200 MB of memory."""
        memory_mb = self.mapping_memory(BIG_MB, with_cameras=True)
        if not SANITIZED:
            self.assertLess(memory_mb, MOST_MEMORY_MB)

    def test_memory_does_not_grow_with_the_scans(self):
        """A scan of a known place takes the bytes of its pose: 2 GB of scans alone take under 200 MB."""
        half_mb, whole_mb = (self.mapping_memory(size, with_cameras=False) for size in (BIG_MB / 2, BIG_MB))
        if not SANITIZED:
            self.assertLess(whole_mb, MOST_MEMORY_MB)
            self.assertLess(whole_mb - half_mb, 0.07 * BIG_MB / 2 + 2)  # a scan has 9 kB

    def test_odometry_of_the_transforms(self):
        write(self.folder / "run.bag")
        write(self.folder / "tf.bag", with_odometry=False)
        whole, answer = self.map_of("run.bag")
        from_transforms, other = self.map_of("tf.bag")
        self.assertEqual(answer["metrics"]["steps"], other["metrics"]["steps"])
        self.assertEqual(len(from_transforms), len(whole))

    def test_a_bag_without_its_end_is_mapped_and_said_to_be_cut(self):
        write(self.folder / "run.bag")
        whole = (self.folder / "run.bag").read_bytes()
        (self.folder / "cut.bag").write_bytes(whole[:len(whole) // 2])
        done = self.run_tool("slam", "cut.bag", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        warnings = json.loads(done.stdout)["warnings"]
        self.assertEqual(len(warnings), 1)
        self.assertIn("The end of cut.bag is missing", warnings[0])

    def test_trajectories_out_and_in(self):
        write(self.folder / "run.bag")
        for name in ("a.tum", "a.kitti"):
            done = self.run_tool("convert", "run.bag", name)
            self.assertEqual((done.returncode, done.stdout), (0, f"60 poses to {name}\n"), done.stderr)
        lines = (self.folder / "a.tum").read_text().splitlines()
        self.assertEqual(lines[1], "1600000000.000000000 2 2 0 0 0 0 1")
        self.assertEqual(lines[2].split()[0], "1600000000.250000000")
        self.assertEqual(self.run_tool("convert", "a.tum", "a.mcap").returncode, 0)
        self.assertEqual(self.run_tool("convert", "a.mcap", "b.tum").returncode, 0)
        self.assertEqual((self.folder / "b.tum").read_bytes(), (self.folder / "a.tum").read_bytes())
        self.assertEqual(self.run_tool("convert", "a.kitti", "b.kitti").returncode, 0)
        rows = [[float(word) for word in line.split()] for line in (self.folder / "b.kitti").read_text().splitlines()]
        self.assertEqual((len(rows), {len(row) for row in rows}), (60, {12}))
        answer = json.loads(self.run_tool("convert", "run.bag", "a.tum", "--json").stdout)
        self.assertEqual((answer["status"], answer["poses"], answer["files"]), ("done", 60, {"converted": "a.tum"}))

    def test_what_is_wrong_is_said_in_one_sentence(self):
        write(self.folder / "two.bag", scans=("/front", "/rear"), steps=4)
        self.assertIn("--scan: the log has several topics of the type sensor_msgs/msg/LaserScan: /front, /rear",
                      self.refusal("slam", "two.bag"))
        self.assertIn("--scan: the log has no topic '/left'", self.refusal("slam", "two.bag", "--scan", "/left"))
        self.map_of("two.bag", "--scan", "/rear")
        write(self.folder / "back.bag", back_at=30)
        self.assertRegex(self.refusal("slam", "back.bag"), "/scan: the time of the scans goes back from .* cut the log")
        write(self.folder / "none.bag", scans=())
        self.assertIn("it has /tf_static, /odom, /tf", self.refusal("slam", "none.bag"))
        whole = (self.folder / "two.bag").read_bytes()
        (self.folder / "zip.bag").write_bytes(whole.replace(b"compression=none", b"compression=zipp"))
        self.assertIn("compressed as 'zipp'; only none, bz2 and lz4 are known", self.refusal("slam", "zip.bag", "--scan", "/rear"))
        lie = re.sub(b"float32 angle_max", b"float64 angle_max", whole)
        (self.folder / "lie.bag").write_bytes(lie)
        self.assertIn("is 'float64 angle_max', and not 'float32 angle_max'",
                      self.refusal("slam", "lie.bag", "--scan", "/rear"))
        before = sorted(self.folder.iterdir())
        self.assertIn("end it in .mcap, .jsonl, .npz, .tum or .kitti",
                      self.refusal("convert", "two.bag", "run.bagg"))
        self.assertIn("--topic: the log has no topic", self.refusal("convert", "two.bag", "a.tum", "--topic", "/x"))
        self.assertIn("compressed as 'zipp'", self.refusal("convert", "zip.bag", "a.mcap"))
        self.assertIn("neither a log nor a trajectory", self.refusal("convert", __file__, "a.tum"))
        self.assertEqual(sorted(self.folder.iterdir()), before, "nothing half-written is left")


if __name__ == "__main__":
    unittest.main()
