"""The log that a program gets while a mission runs: it is that of the run, and telling it changes nothing."""
import json
import os
import subprocess

from building import write_building
from explore_test import ROOM
from mcap_log import McapLog, pose_stamped
from pursue_test import SMALL
from tool import SOURCE, TOOL, ToolTest, main


class Live(ToolTest):
    def start(self, *words, **variables):
        """Starts the tool with a reader: the process, and the end of the pipe to read from."""
        ours, its = os.pipe()
        environment = {**os.environ, **{name: str(its) for name in variables.get("names", ["OUTRIDER_LIVE"])}}
        process = subprocess.Popen([TOOL, *map(str, words)], cwd=self.folder, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL, pass_fds=[its], env=environment)
        os.close(its)
        return process, open(ours, "rb", buffering=0)

    def watched(self, *words):
        """Runs the tool with somebody who reads: its status and what came."""
        process, told = self.start(*words)
        with told:
            log = told.read()
            while more := told.read():
                log += more
        return process.wait(), log

    def check(self, *words):
        """With and without a reader: the same files. The log that the reader got is that of the run."""
        status = self.run_tool(*words, "--out", "alone").returncode
        watched, data = self.watched(*words, "--out", "seen")
        self.assertEqual(watched, status)
        for path in sorted((self.folder / "alone").iterdir()):
            with self.subTest(path.name):
                self.assertEqual(path.read_bytes(), (self.folder / "seen" / path.name).read_bytes())
        log = McapLog(data)
        self.assertTrue(log.complete)
        self.assertEqual(log.attachments["run.json"], (self.folder / "seen/run.json").read_bytes())
        self.assertEqual({(one.encoding, one.schema_encoding) for one in log.channels.values()}, {("cdr", "ros2msg")})
        for channel in log.channels.values():
            times = [message.time_ns for message in log.of(channel.topic)]
            self.assertEqual(times, sorted(times), channel.topic)
        self.write("live.mcap", data)
        told = [json.loads(self.run_tool("replay", path, "--json", "--svg", path.replace("/", "_") + ".svg").stdout)
                for path in ("live.mcap", "seen/run.mcap")]
        for one in told:
            one.pop("files")
        self.assertEqual(*told)
        self.assertEqual((self.folder / "live.mcap.svg").read_bytes(), (self.folder / "seen_run.mcap.svg").read_bytes())
        return log

    def test_guard(self):
        log = self.check(*self.guard())
        places = [pose_stamped(message.data) for message in log.of("/pose")]
        self.assertGreater(len(places), 10)
        self.assertEqual({place[1] for place in places}, {"map"})
        self.assertGreater(len(log.of("/shots")), 0)

    def test_drive(self):
        self.check("run", SOURCE / "scenarios/waypoints/open_loop.yaml")

    def test_slam(self):
        self.check("run", SOURCE / "scenarios/slam/posts.yaml")

    def test_explore(self):
        self.write("room.sdf", ROOM)
        self.check("explore", "room.sdf", "--start=-0.8,-0.5,30")

    def test_pursue(self):
        self.write("small.txt", SMALL)
        self.check("pursue", "small.txt")

    def test_it_comes_while_it_happens(self):
        """A killed mission leaves the messages that it logged until then."""
        self.write("explore.yaml", write_building(self))
        process, told = self.start("run", "explore.yaml")
        with told:
            data = told.read(65536)
            while not McapLog(data).of("/pose"):
                more = told.read(65536)
                self.assertTrue(more, "the mission ended first")
                data += more
            self.assertIsNone(process.poll(), "the mission still runs")
            process.kill()
            process.wait()
            while more := told.read(65536):
                data += more
        log = McapLog(data)
        self.assertFalse(log.complete)
        self.assertIn("/run", {message.topic for message in log.messages})
        self.write("killed.mcap", data)
        self.assertIn("cut short", self.run_tool("replay", "killed.mcap").stdout)

    def test_whoever_reads_may_go(self):
        ours, its = os.pipe()
        os.close(ours)
        process = subprocess.run([TOOL, *map(str, self.guard())], cwd=self.folder, capture_output=True, pass_fds=[its],
                                 env={**os.environ, "OUTRIDER_LIVE": str(its)}, check=False)
        os.close(its)
        self.assertEqual(process.returncode, self.run_tool(*self.guard()).returncode)

    def test_progress_and_log_do_not_mix(self):
        process, told = self.start(*self.guard(), names=["OUTRIDER_LIVE", "OUTRIDER_PROGRESS"])
        with told:
            lines = [json.loads(line) for line in told]
        process.wait()
        self.assertGreater(len(lines), 1)
        self.assertEqual({"step", "steps", "name", "part"}, set(lines[0]))

    def test_a_reader_that_is_not_there(self):
        for word in ("", "x", "2", "-1", "999"):
            result = subprocess.run([TOOL, *self.guard("--json")], cwd=self.folder, capture_output=True, text=True,
                                    env={**os.environ, "OUTRIDER_LIVE": word})
            self.assertIn(result.returncode, (0, 1), word)
            self.assertEqual(len(result.stdout.splitlines()), 1)


if __name__ == "__main__":
    main()
