"""Bags that rosbag itself writes are read as the same bytes, whatever their compression."""

import os
import subprocess
import tempfile
import unittest

import genpy
import rosbag
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

DUMP = os.environ["DUMP_LOG"]
TYPES = {"/scan": LaserScan, "/odom": Odometry, "/tf": TFMessage}


def message_of(topic, number):
    if topic == "/scan":
        return LaserScan(angle_min=-1.5, ranges=[0.01 * number + i for i in range(360)])
    if topic == "/odom":
        odometry = Odometry(child_frame_id="base_link")
        odometry.pose.pose.position.x = 0.1 * number
        return odometry
    transform = TransformStamped(child_frame_id="base_link")
    transform.transform.translation.x = 0.1 * number
    return TFMessage(transforms=[transform] * (number % 3))


def write(path, compression, messages=300):
    with rosbag.Bag(path, "w", compression=compression, chunk_threshold=20000) as bag:
        for number in range(messages):
            topic = list(TYPES)[number * 7 % 3]
            # now and then a message is late
            time = genpy.Time(1600000000 + number // 10, (number * 99999989) % 10**9)
            bag.write(topic, message_of(topic, number), time)


def dump(path):
    done = subprocess.run([DUMP, path], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


def expected(path):
    """All messages by time, which is the reader's order; rosbag returns late ones of a chunk where they lie."""
    with rosbag.Bag(path) as bag:
        messages = [(time.to_nsec(), topic, raw[1]) for topic, raw, time in bag.read_messages(raw=True)]
    assert len({time for time, _, _ in messages}) == len(messages), "the times differ"
    return [f"message {topic} {time} {data.hex()}" for time, topic, data in sorted(messages)]


class RosbagTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = os.path.join(self.folder.name, "run.bag")
        self.addCleanup(self.folder.cleanup)

    def test_every_compression(self):
        for compression in ("none", "bz2", "lz4"):
            with self.subTest(compression):
                write(self.path, compression)
                with rosbag.Bag(self.path) as bag:
                    self.assertEqual(bag.get_compression_info().compression, compression)
                lines = dump(self.path)
                messages = [line for line in lines if line.startswith("message")]
                self.assertEqual(len(messages), 300)
                self.assertEqual(messages, expected(self.path))
                channels = {line.split()[1]: line.split()[2:] for line in lines if line.startswith("channel")}
                for topic, message_class in TYPES.items():
                    package, name = message_class._type.split("/")
                    text = message_class._full_text.encode().hex()
                    self.assertEqual(channels[topic], [f"{package}/msg/{name}", "ros1", text])
                self.assertFalse(any(line.startswith("cut") for line in lines))

    def test_a_bag_without_its_end(self):
        for compression in ("none", "bz2", "lz4"):
            with self.subTest(compression):
                write(self.path, compression)
                whole = dump(self.path)
                size = os.path.getsize(self.path)
                os.truncate(self.path, size * 2 // 3)
                lines = dump(self.path)
                self.assertTrue(lines[-1].startswith("cut The end of "), lines[-1])
                messages = [line for line in lines if line.startswith("message")]
                self.assertGreater(len(messages), 50)
                self.assertLess(set(messages), set(whole))

    def test_a_bag_of_a_killed_recorder(self):
        bag = rosbag.Bag(self.path, "w", chunk_threshold=20000)
        for number in range(100):
            bag.write("/scan", message_of("/scan", number), genpy.Time(number))
        bag.flush()
        with open(self.path, "rb") as file:
            left = file.read()
        bag.close()
        with open(self.path, "wb") as file:
            file.write(left)
        lines = dump(self.path)
        messages = [line for line in lines if line.startswith("message")]
        self.assertGreater(len(messages), 50)
        self.assertTrue(lines[-1].startswith("cut "), lines[-1])

    def test_without_messages(self):
        rosbag.Bag(self.path, "w").close()
        self.assertEqual(dump(self.path), [])


if __name__ == "__main__":
    unittest.main()
